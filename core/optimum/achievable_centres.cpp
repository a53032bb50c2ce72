#include "core/optimum/achievable_centres.h"

#include "core/base/angles.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

constexpr Eigen::Index kDirections = 200;
/// The border of what may be hollow is taken as a plane in each cell, in diagonals.
constexpr double kSlack = 1e-3;

/// Evenly on the sphere, along a spiral, and the axes.
Points directions() {
  Points result(kDirections, 3);
  const double turn = kPi * (3.0 - std::sqrt(5.0));
  for (Eigen::Index i = 0; i < kDirections - 6; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / (kDirections - 6.0);
    const double angle = turn * static_cast<double>(i);
    const double radius = std::sqrt(1.0 - z * z);
    result.row(i) << radius * std::cos(angle), radius * std::sin(angle), z;
  }
  result.bottomRows<6>() << Mat3::Identity(), -Mat3::Identity();
  return result;
}

/// What all cavities can make of u·S − t m, S the first moments.
class Reach {
public:
  Reach(const Moments& solid, double fillDensity, const AdmissibleCells& cells)
      : solid_(solid), filling_(fillDensity - 1.0), cells_(cells),
        leastMass_(solid[0] + std::min(filling_, 0.0) * cells.col(0).sum()) {}

  /// No less than u·c of any body. Dinkelbach's iteration, then what cells that the best cavity
  /// cuts may add; d/dt of the greatest u·S − t m is at most −(the least mass).
  double limit(const Vec3& u) const {
    constexpr int kMostSteps = 20;
    double level = u.dot(solid_.segment<3>(1)) / solid_[0];
    for (int step = 0; step < kMostSteps; ++step) {
      const Moments body = bestBody(u, level);
      const double next = u.dot(body.segment<3>(1)) / body[0];
      if (!(next > level)) break;
      level = next;
    }
    return level + greatest(u, level) / leastMass_;
  }

private:
  Moments bestBody(const Vec3& u, double level) const {
    Moments body = solid_;
    for (Eigen::Index c = 0; c < cells_.rows(); ++c) {
      const double g = u.dot(cells_.row(c).segment<3>(1)) - level * cells_(c, 0);
      if (filling_ * g > 0.0) body += filling_ * cells_.row(c).transpose();
    }
    return body;
  }

  /// ∫ max(0, g) = ½ ∫ (g + |g|) over a cell, and (∫ |g|)² ≤ ∫ 1 · ∫ g².
  double greatest(const Vec3& u, double level) const {
    double sum = u.dot(solid_.segment<3>(1)) - level * solid_[0];
    for (Eigen::Index c = 0; c < cells_.rows(); ++c) {
      const Moments cell = cells_.row(c).transpose();
      const double along = u.dot(cell.segment<3>(1));
      const double g = filling_ * (along - level * cell[0]);
      const double squares =
          u.dot(secondMoment(cell) * u) - level * (2.0 * along - level * cell[0]);
      sum += 0.5 * (g + std::abs(filling_) * std::sqrt(cell[0] * std::max(squares, 0.0)));
    }
    return std::max(sum, 0.0);
  }

  const Moments& solid_;
  double filling_; ///< density of the filling less that of the material
  const AdmissibleCells& cells_;
  double leastMass_;
};

} // namespace

HalfSpaces achievableCentres(const Moments& solid, double fillDensity,
                             const AdmissibleCells& cells) {
  const Reach reach(solid, fillDensity, cells);
  HalfSpaces centres{directions(), Vector(kDirections)};
  for (Eigen::Index i = 0; i < kDirections; ++i) {
    centres.limits[i] = reach.limit(centres.normals.row(i).transpose()) + kSlack;
  }
  return centres;
}

} // namespace massprops
