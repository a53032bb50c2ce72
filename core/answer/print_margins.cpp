#include "core/answer/print_margins.h"

#include "core/base/angles.h"
#include "core/base/bisection.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/optimum/admissible_cells.h"
#include "core/physics/moments.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace massprops {
namespace {

/// The greatest deviation 0…most that holds.
double greatestDeviation(double most, const std::function<bool(double)>& holds) {
  return holds(most) ? most : lastThatHolds(0.0, most, kFeasibility * most, holds);
}

/// Moments of what a slicer prints as infill: the material farther than the perimeters from its
/// surfaces. Of the body that far behind the outer surface, what the cavity is that much larger;
/// by less where the wall is not as thick as both perimeters, for nothing in it is infill then.
Moments deepMaterial(const CavityTask& task, const CavityResult& cavity, double perimeters) {
  // A tree of the model costs as much as all else here.
  const TriangleTree& given = task.surface;
  std::optional<TriangleTree> own;
  if (given.keepsOut() || cavity.outer != given.vertices())
    own.emplace(cavity.outer, given.faces(), TriangleTree::Order::Spatial);
  const TriangleTree& outer = own ? *own : given;
  const double edge = std::cbrt((outer.upper() - outer.lower()).prod() / kCells);
  const FeasibleRegion region = feasibleRegion({outer, perimeters, 0.0}, edge);
  if (region.isEmpty()) return Moments::Zero();
  Moments deep =
      admissibleCells(region, Admissible::BehindWalls, kCells).colwise().sum().transpose();
  if (const Faces& faces = cavity.cavity.faces; faces.rows() > 0) {
    const double larger = std::min(perimeters, cavity.inspection.leastWall - perimeters);
    deep -= moments(cavity.inner + larger * vertexNormals(cavity.inner, faces), faces);
  }
  return deep[0] > 0.0 ? deep : Moments::Zero();
}

/// Moments of a surface whose vertices go by t along their directions, −most ≤ t ≤ most: in t
/// polynomials of degree 5 at most, so that six surfaces tell those of all.
class DisplacedMoments {
public:
  DisplacedMoments(const Points& vertices, const Faces& faces, const Points& directions,
                   double most)
      : most_(most) {
    Eigen::Matrix<double, kTerms, kTerms> powers;
    Eigen::Matrix<double, kTerms, 10> values;
    for (int i = 0; i < kTerms; ++i) {
      const double t = std::cos(kPi * (i + 0.5) / kTerms); // Chebyshev's
      powers.row(i) = powersOf(t);
      values.row(i) = moments(vertices + most * t * directions, faces).transpose();
    }
    coefficients_ = powers.partialPivLu().solve(values);
  }

  Moments at(double displacement) const {
    return (powersOf(displacement / most_) * coefficients_).transpose();
  }

private:
  static constexpr int kTerms = 6;

  static Eigen::Matrix<double, 1, kTerms> powersOf(double t) {
    Eigen::Matrix<double, 1, kTerms> powers;
    powers[0] = 1.0;
    for (int i = 1; i < kTerms; ++i) powers[i] = t * powers[i - 1];
    return powers;
  }

  double most_;
  Eigen::Matrix<double, kTerms, 10> coefficients_;
};

/// Vertices of the cavity that lie farthest in directions all round: linear functionals, and with
/// them the harm that a lump does, are greatest at one of these, up to the directions between.
std::vector<Vec3> extremePoints(const CavityResult& cavity) {
  const Points corners = submesh(cavity.inner, cavity.cavity.faces).mesh.vertices;
  std::vector<Vec3> points;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        Eigen::Index farthest = 0;
        (corners * Vec3(i, j, k)).maxCoeff(&farthest);
        points.emplace_back(corners.row(farthest).transpose());
      }
    }
  }
  return points;
}

/// Of a lump of mass 1.
Moments lumpAt(const Vec3& p) {
  Moments m;
  m << 1.0, p, p.cwiseAbs2(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return m;
}

} // namespace

PrintMargins printMargins(const CavityTask& task, const CavityResult& cavity,
                          const Verdict& verdict, double perimeters) {
  const Moments body = hollowBody(task, cavity).mass;
  const Faces& faces = cavity.cavity.faces;
  PrintMargins margins;
  const Moments deep = deepMaterial(task, cavity, perimeters);
  margins.infill = 1.0 - greatestDeviation(1.0, [&](double missing) {
                     return deep[0] == 0.0 || verdict.isReached(body - missing * deep);
                   });
  if (faces.rows() == 0) return margins;

  const Moments inner = moments(cavity.inner, faces);
  const double filled = 1.0 - task.model.fillings.front().density;
  const DisplacedMoments displaced(cavity.inner, faces, vertexNormals(cavity.inner, faces),
                                   task.wall);
  margins.wall = greatestDeviation(task.wall, [&](double error) {
    const auto holds = [&](double displacement) {
      return verdict.isReached(body - filled * (displaced.at(displacement) - inner));
    };
    return holds(error) && holds(-error);
  });
  margins.residue = inner[0];
  for (const Vec3& place : extremePoints(cavity)) {
    const auto holds = [&](double mass) {
      return verdict.isReached(body + filled * mass * lumpAt(place));
    };
    if (!holds(margins.residue)) margins.residue = greatestDeviation(margins.residue, holds);
  }
  return margins;
}

} // namespace massprops
