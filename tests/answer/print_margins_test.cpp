// How far a print may be off: bodies with these errors, calculated anew from the delivered meshes.
#include "core/base/angles.h"
#include "core/model/contact.h"
#include "core/model/solid.h"
#include "core/physics/moments.h"
#include "core/pipeline.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"
#include "judge/checks.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace massprops::testing {
namespace {

/// Of the diagonal: thick enough for errors of the walls to matter.
constexpr double kWall = 0.02;

struct Stood {
  TriangleMesh outer, inner; ///< the latter outward
  GroundContact contact;
  double density, infill, wallError, residue, wall;
  Moments body;

  explicit Stood(const std::string& sample) : outer(sampleMesh(sample)) {
    Options options;
    options.innerLowerBound = kWall * makeSolid(outer).diagonal();
    const Result result = optimizeMassProperties(outer, options);
    inner = reversed(result.inner);
    contact = groundContact(outer.vertices, {});
    density = options.density / 1000.0;
    body = density * (quadratureMoments(outer) - quadratureMoments(inner));
    const auto number = [&](const char* key) { return std::get<double>(result.report.at(key)); };
    infill = number("infill_at_least");
    wallError = number("wall_error_at_most");
    residue = number("residue_at_most");
    wall = number("min_wall");
  }

  /// Of a body's mass and first moments, in grams.
  bool stands(const Moments& print) const {
    const Vec3 c = print.segment<3>(1) / print[0] - contact.centre;
    return tippingAngle(contact.area, c) > 0.0;
  }
};

class PrintMargins : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Samples, PrintMargins,
                         ::testing::Values("box_on_corner", "toy_dinosaur", "leaning_ring"));

TEST_P(PrintMargins, AreWhereTheVerdictTurns) {
  const Stood print(GetParam());
  ASSERT_TRUE(print.stands(print.body));

  // A lump at each vertex of the cavity: the worst place is among them.
  const auto standsWithLump = [&](double grams) {
    for (Eigen::Index v = 0; v < print.inner.vertices.rows(); ++v) {
      Moments lump = Moments::Zero();
      lump[0] = grams;
      lump.segment<3>(1) = grams * print.inner.vertices.row(v).transpose();
      if (!print.stands(print.body + lump)) return false;
    }
    return true;
  };
  // The reported one is the worst of 26 places.
  EXPECT_TRUE(standsWithLump(0.97 * print.residue)) << print.residue;
  EXPECT_FALSE(standsWithLump(1.02 * print.residue)) << print.residue;

  // What is deeper than 0.9 in the material, counted in voxels.
  TriangleMesh material = joined(print.outer, reversed(print.inner));
  const TriangleTree surface(material.vertices, material.faces);
  const PointInMesh inside(surface);
  const Vec3 low = print.outer.vertices.colwise().minCoeff();
  const Vec3 high = print.outer.vertices.colwise().maxCoeff();
  const double edge = std::cbrt((high - low).prod() / 200000);
  Moments deep = Moments::Zero();
  for (double x = low.x() + edge / 2; x < high.x(); x += edge) {
    for (double y = low.y() + edge / 2; y < high.y(); y += edge) {
      for (double z = low.z() + edge / 2; z < high.z(); z += edge) {
        const Vec3 p(x, y, z);
        if (surface.nearest(p).squaredDistance < 0.81 || !inside.contains(p)) continue;
        const double grams = print.density * edge * edge * edge;
        deep[0] += grams;
        deep.segment<3>(1) += grams * p;
      }
    }
  }
  const auto standsAtInfill = [&](double share) {
    return print.stands(print.body - (1.0 - share) * deep);
  };
  EXPECT_TRUE(standsAtInfill(std::min(1.0, print.infill + 0.03))) << print.infill;
  ASSERT_GT(print.infill, 0.03);
  EXPECT_FALSE(standsAtInfill(print.infill - 0.03));

  // All walls too thick or too thin by as much: the cavity, moved along its vertices' normals.
  const auto standsDisplacedBy = [&](double error) {
    TriangleMesh displaced = print.inner;
    Points normals = Points::Zero(displaced.vertices.rows(), 3);
    for (Eigen::Index f = 0; f < displaced.faces.rows(); ++f) {
      const auto at = [&](int k) {
        return Vec3(print.inner.vertices.row(displaced.faces(f, k)).transpose());
      };
      const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
      for (const int v : displaced.faces.row(f)) normals.row(v) += normal.transpose();
    }
    displaced.vertices += error * normals.rowwise().normalized();
    return print.stands(print.density *
                        (quadratureMoments(print.outer) - quadratureMoments(displaced)));
  };
  ASSERT_GT(print.wallError, 0.0);
  for (const double share : {0.5, 0.99}) {
    EXPECT_TRUE(standsDisplacedBy(share * print.wallError));
    EXPECT_TRUE(standsDisplacedBy(-share * print.wallError));
  }
  if (print.wallError < 0.99 * print.wall) {
    EXPECT_FALSE(standsDisplacedBy(1.02 * print.wallError) &&
                 standsDisplacedBy(-1.02 * print.wallError));
  }
}

} // namespace
} // namespace massprops::testing
