// The sample meshes: what each is there to show, and that its cavity can be printed.
#include "core/pipeline.h"

#include "checks.h"

#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <string>

namespace massprops::testing {
namespace {

struct Sample {
  std::string name;
  GoalKind goal;
  bool reachable;
};

void PrintTo(const Sample& sample, std::ostream* os) {
  *os << sample.name;
}

TriangleMesh read(const std::string& name) {
  using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  Mesh mesh;
  CGAL::IO::read_PLY(std::string(MASSPROPS_SAMPLE_DIR) + "/" + name + ".ply", mesh,
                     CGAL::parameters::use_binary_mode(true));
  TriangleMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  result.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.vertices.row(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      result.faces(static_cast<Eigen::Index>(f.idx()), corner++) = static_cast<int>(v.idx());
  }
  return result;
}

struct Run {
  TriangleMesh model;
  Result result;
};

const Run& runOf(const Sample& sample) {
  static std::map<std::string, Run> runs;
  const auto known = runs.find(sample.name);
  if (known != runs.end()) return known->second;
  Run run;
  run.model = read(sample.name);
  Options options;
  options.goal = sample.goal;
  // As in MeshLab: what is delivered fits into floats.
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  run.result = optimizeMassProperties(run.model, options);
  return runs.emplace(sample.name, std::move(run)).first->second;
}

class EverySample : public ::testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(Samples, EverySample,
                         ::testing::Values(Sample{"box_on_corner", GoalKind::Stand, true},
                                           Sample{"tilted_ellipsoid_top", GoalKind::Spin, true},
                                           Sample{"toy_dinosaur", GoalKind::Stand, true},
                                           Sample{"leaning_ring", GoalKind::Stand, true},
                                           Sample{"leaning_egg", GoalKind::Stand, false}),
                         [](const auto& test) { return test.param.name; });

TEST_P(EverySample, FailsAsASolidAndSucceedsHollowWhereItCan) {
  const Sample& sample = GetParam();
  const Result& result = runOf(sample).result;
  const std::string verdict = sample.goal == GoalKind::Stand ? "stands_" : "spins_";
  EXPECT_FALSE(std::get<bool>(result.report.at(verdict + "before")));
  EXPECT_EQ(std::get<bool>(result.report.at(verdict + "after")), sample.reachable);
  EXPECT_EQ(std::get<bool>(result.report.at("solved")), sample.reachable)
      << std::get<std::string>(result.report.at("message"));
}

TEST_P(EverySample, HasAPrintableCavity) {
  const auto& [model, result] = runOf(GetParam());
  ASSERT_GT(result.inner.faces.rows(), 0);
  EXPECT_TRUE(isClosedAndOriented(result.inner));
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_EQ(intersectingPairs(result.inner, model), 0U);
  // Without crossings one vertex would do for each component; a hundred are all over the cavity.
  const Eigen::Index step = std::max<Eigen::Index>(1, result.inner.vertices.rows() / 100);
  for (Eigen::Index v = 0; v < result.inner.vertices.rows(); v += step)
    EXPECT_NEAR(windingNumber(model, result.inner.vertices.row(v).transpose()), 1.0, 1e-6);
}

TEST_P(EverySample, KeepsTheDefaultWallOfOnePercent) {
  const auto& [model, result] = runOf(GetParam());
  const double diagonal =
      (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
  const double wall = leastDistance(result.inner, model);
  EXPECT_GE(wall, 0.99 * 0.01 * diagonal);
  EXPECT_NEAR(std::get<double>(result.report.at("min_wall")), wall, 1e-9 * diagonal);
}

} // namespace
} // namespace massprops::testing
