#include "core/optimum/ratio_bound.h"

#include "core/base/minimize.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// What becomes a multiplier that is not negative by squaring starts here at least, for the square
/// of 0 has no slope.
constexpr double kLeastRoot = 0.05;

/// Multipliers of all rows, as functions of variables of any value: a unit vector across with the
/// direction (x₀², x₁², x₂), the x themselves, squares, B Bᵀ with B = ((b₀, 0), (b₂, b₁)).
class Multipliers {
public:
  explicit Multipliers(const RatioProblem& problem)
      : across_(problem.across.rows()), less_(across_ + problem.equal.rows()),
        cone_(less_ + problem.less.rows()), all_(cone_ + problem.cone.rows()) {}

  Vector start(const Vector& roots) const {
    Vector x = roots;
    if (x.size() != all_) {
      x = Vector::Zero(all_);
      x.head(std::min<Eigen::Index>(across_, 2)).setOnes();
    }
    for (Eigen::Index i = less_; i < all_; ++i) {
      if (i != cone_ + 2) x[i] = std::max(std::abs(x[i]), kLeastRoot);
    }
    return x;
  }

  Vector at(const Vector& x) const {
    Vector lambda = x;
    lambda.head(across_) = across(x);
    lambda.head(across_) /= lambda.head(across_).norm();
    lambda.tail(all_ - less_) = x.tail(all_ - less_).cwiseAbs2();
    if (cone_ == all_) return lambda;
    const Vec3 b = x.tail<3>();
    lambda.tail<3>() << b[0] * b[0], b[1] * b[1] + b[2] * b[2], 2.0 * b[0] * b[2];
    return lambda;
  }

  /// d(λ(x)·values)/dx.
  Vector pulledBack(const Vector& x, const Vector& values) const {
    Vector slopes = values;
    const Vector u = across(x);
    const Vector v = values.head(across_);
    slopes.head(across_) = (v - u.dot(v) / u.squaredNorm() * u) / u.norm();
    if (across_ == 3) slopes.head<2>().array() *= 2.0 * x.head<2>().array();
    slopes.tail(all_ - less_).array() *= 2.0 * x.tail(all_ - less_).array();
    if (cone_ == all_) return slopes;
    const Vec3 b = x.tail<3>();
    const Vec3 c = values.tail<3>();
    slopes.tail<3>() << 2.0 * (b[0] * c[0] + b[2] * c[2]), 2.0 * b[1] * c[1],
        2.0 * (b[2] * c[1] + b[0] * c[2]);
    return slopes;
  }

private:
  Vector across(const Vector& x) const {
    if (across_ == 1) return Vector::Ones(1);
    return Vec3(x[0] * x[0], x[1] * x[1], x[2]);
  }

  Eigen::Index across_, less_, cone_, all_; ///< ends of the parts
};

/// One end of what is open.
class End {
public:
  End(const RatioProblem& problem, double open, Moments start)
      : rows_(problem.across.rows() + problem.equal.rows() + problem.less.rows() +
                  problem.cone.rows(),
              11),
        divisor_(problem.divisor), body_(std::move(start)) {
    rows_ << problem.across, problem.equal, problem.less, problem.cone;
    if (open != 0.0) rows_(problem.across.rows() + problem.equal.rows() - 1, 10) -= open;
  }

  void solve(const Vector& multipliers, const ExtremeBodies& bodies) {
    const AffineRow dividend = multipliers.transpose() * rows_;
    body_ = bodies.withLeastRatio(dividend, divisor_, body_);
    slopes_ = (rows_.leftCols<10>() * body_ + rows_.col(10)) / valueOf(divisor_, body_);
    ratio_ = multipliers.dot(slopes_);
  }

  const AffineRows& rows() const { return rows_; }
  const Moments& body() const { return body_; }
  double ratio() const { return ratio_; }
  const Vector& slopes() const { return slopes_; } ///< of the ratio by the multipliers

private:
  AffineRows rows_;
  const AffineRow& divisor_;
  Moments body_;
  double ratio_ = 0.0;
  Vector slopes_;
};

} // namespace

RatioBound ratioBound(const RatioProblem& problem,
                      const std::function<Worth(double low, double high)>& worth,
                      const ExtremeBodies& bodies, const Vector& roots, const Moments& start) {
  const Multipliers multipliers(problem);
  End low(problem, -problem.open, start);
  End high(problem, problem.open, start);
  const auto solve = [&](const Vector& lambda) {
    low.solve(lambda, bodies);
    if (problem.open != 0.0) high.solve(lambda, bodies);
    return worth(low.ratio(), (problem.open != 0.0 ? high : low).ratio());
  };
  const auto negative = [&](const Vector& x) {
    const Worth w = solve(multipliers.at(x));
    Vector slopes = w.byLow * low.slopes();
    if (problem.open != 0.0) slopes += w.byHigh * high.slopes();
    Evaluation e;
    e.objective = -w.value;
    e.objectiveGradient = -multipliers.pulledBack(x, slopes);
    return e;
  };
  MinimizeOptions solver;
  solver.objectiveScale = 10.0;
  solver.maxEvaluations = 100;
  solver.range = 200.0; // multipliers are large where hardly any body meets the conditions
  RatioBound bound;
  bound.roots = minimize(negative, multipliers.start(roots), solver).x;
  const Vector lambda = multipliers.at(bound.roots);
  bound.value = solve(lambda).value;
  bound.low = low.ratio();
  bound.high = problem.open != 0.0 ? high.ratio() : bound.low;
  bound.dividend = 0.5 * lambda.transpose() * (low.rows() + high.rows());
  if (problem.across.rows() == 3) bound.unit = lambda.head<3>();
  bound.body = low.body();
  return bound;
}

} // namespace massprops
