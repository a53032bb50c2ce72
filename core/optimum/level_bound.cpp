#include "core/optimum/level_bound.h"

#include "core/base/minimize.h"
#include "core/optimum/extreme_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace massprops {
namespace {

/// Levels that differ by less are the same.
constexpr double kSameLevel = 1e-6;
/// Share of a condition that has just been found to be broken.
constexpr double kFirstShare = 0.05;

Eigen::Matrix<double, 11, 1> extended(const Moments& massMoments) {
  Eigen::Matrix<double, 11, 1> m;
  m << massMoments, 1.0;
  return m;
}

/// The bodies that meet a positive combination of the conditions best.
class Relaxations {
public:
  Relaxations(const LinearConditions& conditions, const Moments& solid, double fillDensity,
              const AdmissibleCells& cells)
      : conditions_(conditions), solid_(solid), bodies_(solid, fillDensity, cells) {
    best_.reached = -std::numeric_limits<double>::infinity();
    best_.level = std::numeric_limits<double>::infinity();
    remember(solid);
  }

  struct Solution {
    Moments body;
    double level;
    Vector slopes; ///< of the level by the multipliers
  };

  Solution solve(const Vector& multipliers) {
    const AffineRow atZero = multipliers.transpose() * conditions_.atZero;
    const AffineRow slopes = multipliers.transpose() * conditions_.slopes;
    Solution s{bodies_.withLeastRatio(atZero, slopes, solid_), 0.0, {}};
    const auto m = extended(s.body);
    s.level = -atZero.dot(m) / slopes.dot(m);
    s.slopes = -(conditions_.atZero * m + s.level * conditions_.slopes * m) / slopes.dot(m);
    remember(s.body);
    if (s.level < best_.level) {
      best_.level = s.level;
      best_.multipliers = multipliers;
      best_.functional = (atZero + s.level * slopes).transpose();
    }
    return s;
  }

  const LevelBound& best() const { return best_; }

private:
  void remember(const Moments& body) {
    const double reached = levelReached(conditions_, body);
    if (reached <= best_.reached) return;
    best_.reached = reached;
    best_.body = body;
  }

  const LinearConditions& conditions_;
  const Moments& solid_;
  ExtremeBodies bodies_;
  LevelBound best_;
};

/// λ = x²/|x|² over some of the conditions, 0 for the others.
class Mixture {
public:
  Mixture(Eigen::Index conditions, Eigen::Index first) : count_(conditions), active_{first} {
    x_ = Vector::Ones(1);
  }

  void add(Eigen::Index condition) {
    active_.push_back(condition);
    x_ /= x_.norm();
    x_.conservativeResize(x_.size() + 1);
    x_[x_.size() - 1] = std::sqrt(kFirstShare);
  }

  void leaveOut(Vector& levels) const {
    for (const Eigen::Index i : active_) levels[i] = std::numeric_limits<double>::infinity();
  }

  /// Turns the shares to where the relaxation's level is least.
  void optimize(Relaxations& relaxations) {
    if (active_.size() == 1) return;
    MinimizeOptions solver;
    solver.objectiveTolerance = 1e-9;
    solver.range = 2.0;
    const auto problem = [&](const Vector& x) {
      const double squared = x.squaredNorm();
      const Relaxations::Solution s = relaxations.solve(multipliers(x));
      Vector slopes(x.size());
      for (Eigen::Index j = 0; j < x.size(); ++j) {
        slopes[j] = s.slopes[active_[static_cast<std::size_t>(j)]];
      }
      Evaluation e;
      e.objective = s.level;
      const double mean = x.cwiseAbs2().dot(slopes) / squared;
      e.objectiveGradient = 2.0 / squared * x.cwiseProduct((slopes.array() - mean).matrix());
      return e;
    };
    x_ = minimize(problem, x_, solver).x;
  }

  Vector multipliers() const { return multipliers(x_); }

private:
  Vector multipliers(const Vector& x) const {
    Vector lambda = Vector::Zero(count_);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      lambda[active_[static_cast<std::size_t>(j)]] = x[j] * x[j] / x.squaredNorm();
    }
    return lambda;
  }

  Eigen::Index count_;
  std::vector<Eigen::Index> active_;
  Vector x_;
};

/// The levels at which the conditions hold.
Vector levels(const LinearConditions& conditions, const Moments& body) {
  const auto m = extended(body);
  return -(conditions.atZero * m).cwiseQuotient(conditions.slopes * m);
}

} // namespace

LevelBound greatestLevel(const LinearConditions& conditions, const Moments& solid,
                         double fillDensity, const AdmissibleCells& cells) {
  constexpr int kMostConditions = 16;
  Relaxations relaxations(conditions, solid, fillDensity, cells);
  Eigen::Index weakest = 0;
  levels(conditions, solid).minCoeff(&weakest);
  Mixture mixture(conditions.atZero.rows(), weakest);
  for (int count = 1; count <= kMostConditions; ++count) {
    mixture.optimize(relaxations);
    const Relaxations::Solution s = relaxations.solve(mixture.multipliers());
    const LevelBound& best = relaxations.best();
    if (best.level - best.reached <= kSameLevel * std::max(1.0, std::abs(best.level))) break;
    Vector others = levels(conditions, s.body);
    mixture.leaveOut(others);
    if (others.minCoeff(&weakest) >= s.level) break;
    mixture.add(weakest);
  }
  return relaxations.best();
}

} // namespace massprops
