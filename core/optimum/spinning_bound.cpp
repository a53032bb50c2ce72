#include "core/optimum/spinning_bound.h"

#include "core/optimum/ratio_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace massprops {
namespace {

/// One to five milliseconds each.
constexpr int kMostProblems = 80;

/// (M, 1) about a point instead of the origin.
using Translation = Eigen::Matrix<double, 11, 11, Eigen::RowMajor>;

Translation momentsAbout(const Vec3& p) {
  Translation t = Translation::Identity();
  constexpr int first[6] = {0, 1, 2, 0, 1, 2};
  constexpr int second[6] = {0, 1, 2, 1, 2, 0};
  for (int i = 0; i < 3; ++i) t(1 + i, 0) = -p[i];
  for (int k = 0; k < 6; ++k) {
    const int i = first[k];
    const int j = second[k];
    t(4 + k, 0) = p[i] * p[j];
    t(4 + k, 1 + i) -= p[j];
    t(4 + k, 1 + j) -= p[i];
  }
  return t;
}

/// What the moment about the axis is among the three. Any: a relaxation.
enum class Axial { Any, Greatest, Least };

struct Interval {
  double low, high;
  double middle() const { return 0.5 * (low + high); }
  double width() const { return high - low; }
};

/// Bodies with the centre of mass between these heights above the point, and with this linear part
/// of the objective.
struct Box {
  Interval height, linear;
  double bound = -std::numeric_limits<double>::infinity(); ///< of the objective
  RatioBound ratio = {};
  double gainByHeight = 0.0, gainByLinear = 0.0; ///< of the bound, if halved: about
};

/// The least s + weight max(0, r)² over an interval of s, r going from one value to another.
struct LeastSum {
  double t; ///< where, 0…1
  double ratio, sum;
};

LeastSum leastSum(const Interval& s, double atLow, double atHigh, double weight) {
  const double slope = atHigh - atLow;
  const auto at = [&](double t) {
    const double r = std::max(0.0, atLow + t * slope);
    return LeastSum{t, r, s.low + t * s.width() + weight * r * r};
  };
  LeastSum least = at(0.0);
  const auto consider = [&](const LeastSum& other) {
    if (other.sum < least.sum) least = other;
  };
  consider(at(1.0));
  if (weight * slope < 0.0) {
    const double r = -s.width() / (2.0 * weight * slope);
    consider(at(std::clamp((r - atLow) / slope, 0.0, 1.0)));
  }
  return least;
}

class BranchAndBound {
public:
  BranchAndBound(const SpinningTask& task, double volumeWeight, const Moments& solid,
                 double fillDensity, const AdmissibleCells& cells)
      : task_(task), solid_(solid), bodies_(solid, fillDensity, cells),
        about_(momentsAbout(task.point)), axis_(axisEqualities(task)),
        linear_(task.staticWeight / task.solidMass * about_.row(3)) {
    // The material's share of the solid's volume is 1 − (m − m_solid)/((ρ_f − 1) m_solid).
    const double perMass = volumeWeight / ((fillDensity - 1.0) * solid[0]);
    linear_[0] -= perMass;
    linear_[10] += volumeWeight + perMass * solid[0];
  }

  SpinningBound least(double known, Axial axial) const {
    return task_.inertiaWeight > 0.0 ? byBoxes(known, axial) : linear(axial);
  }

private:
  SpinningBound byBoxes(double known, Axial axial) const {
    std::vector<Box> boxes{bounded(root(known), axial)};
    int problems = 1;
    while (true) {
      const auto lowest = std::min_element(
          boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.bound < b.bound; });
      const bool mayGain = std::max(lowest->gainByHeight, lowest->gainByLinear) > 0.0;
      SpinningBound bound{std::min(known, lowest->bound), functionalOf(*lowest), problems};
      if (bound.isNear(known) || problems >= kMostProblems || !mayGain) return bound;
      const Box box = *lowest;
      boxes.erase(lowest);
      const auto side = box.gainByHeight > box.gainByLinear ? &Box::height : &Box::linear;
      for (const bool isUpper : {false, true}) {
        Box half = box;
        (isUpper ? (half.*side).low : (half.*side).high) = (box.*side).middle();
        boxes.push_back(bounded(half, axial));
        ++problems;
      }
    }
  }

  /// The objective being linear.
  SpinningBound linear(Axial axial) const {
    RatioProblem problem{linear_, AffineRow::Unit(10)};
    problem.equal = axis_;
    problem.cone = coneOf(axial);
    const auto worth = [](double low, double /*high*/) { return Worth{low, 1.0, 0.0}; };
    const RatioBound bound = ratioBound(problem, worth, bodies_, {}, solid_);
    return {bound.value, bound.dividend, 1};
  }

  AffineRow q(int k) const { return about_.row(k); }
  AffineRow divisor() const { return (q(4) + q(5)) / task_.solidInertia; }

  /// All bodies whose objective may be lower.
  Box root(double known) const {
    const auto least = [&](const AffineRow& dividend, const AffineRow& by) {
      const Moments body = bodies_.withLeastRatio(dividend, by, solid_);
      return valueOf(dividend, body) / valueOf(by, body);
    };
    Box box{{0.0, 0.0}, {0.0, 0.0}};
    if (!task_.isCentred) box.height = {std::max(0.0, least(q(3), q(0))), -least(-q(3), q(0))};
    if (!linear_.isZero(0.0)) box.linear = {least(linear_, AffineRow::Unit(10)), known};
    box.ratio.body = solid_;
    return box;
  }

  /// I_xx − I_zz, I_yy − I_zz and I_xy about the point, or their opposites.
  AffineRows coneOf(Axial axial) const {
    AffineRows cone(axial == Axial::Any ? 0 : 3, 11);
    if (axial == Axial::Any) return cone;
    cone << q(6) - q(4), q(6) - q(5), -q(7);
    return (axial == Axial::Greatest ? 1.0 : -1.0) / task_.solidInertia * cone;
  }

  RatioProblem problemOf(const Box& box, Axial axial) const {
    // S_z²/m lies below its chord over the heights, so that I_xx and I_yy about the centre of mass
    // are no less than these.
    const Interval& h = box.height;
    const AffineRow chord = (h.low + h.high) * q(3) - h.low * h.high * q(0);
    RatioProblem problem{AffineRows(3, 11), divisor()};
    problem.across << q(5) + q(6) - chord, q(4) + q(6) - chord, -std::sqrt(2.0) * q(7);
    problem.across /= task_.solidInertia;
    const bool isLinearOpen = box.linear.width() > 0.0;
    problem.equal.resize(axis_.rows() + (isLinearOpen ? 1 : 0), 11);
    problem.equal.topRows(axis_.rows()) = axis_;
    if (isLinearOpen) {
      problem.equal.bottomRows<1>() = linear_;
      problem.equal(axis_.rows(), 10) -= box.linear.middle();
      problem.open = 0.5 * box.linear.width();
    }
    if (h.width() > 0.0) {
      problem.less.resize(2, 11);
      problem.less << h.low * q(0) - q(3), q(3) - h.high * q(0);
      problem.less /= task_.solidMass;
    }
    problem.cone = coneOf(axial);
    return problem;
  }

  /// For any multipliers the ratio is a concave function of the linear part s: it is the least of
  /// functions that are linear in s, a body each.
  Box bounded(Box box, Axial axial) const {
    const RatioProblem problem = problemOf(box, axial);
    const double weight = task_.inertiaWeight;
    const auto worth = [&](double low, double high) {
      const LeastSum least = leastSum(box.linear, low, high, weight);
      const double slope = 2.0 * weight * least.ratio;
      return Worth{least.sum, (1.0 - least.t) * slope, least.t * slope};
    };
    box.ratio = ratioBound(problem, worth, bodies_, box.ratio.roots, box.ratio.body);
    box.bound = std::max(box.bound, box.ratio.value);
    // What the chord gives away: (Δh/2)² m of I_xx and I_yy at most.
    const LeastSum least = leastSum(box.linear, box.ratio.low, box.ratio.high, weight);
    const double divisor = valueOf(problem.divisor, box.ratio.body) * task_.solidInertia;
    box.gainByHeight = 0.5 * weight * least.ratio * box.ratio.unit.head<2>().sum() *
                       box.height.width() * box.height.width() * box.ratio.body[0] / divisor;
    box.gainByLinear = lostBetween(box, least);
    return box;
  }

  /// By how much the ratio is higher than between its values at the ends, in the objective.
  double lostBetween(const Box& box, const LeastSum& least) const {
    if (box.linear.width() == 0.0) return 0.0;
    AffineRow dividend = box.ratio.dividend;
    const Eigen::Index last = 3 + axis_.rows();
    dividend[10] += box.ratio.roots[last] * (0.5 - least.t) * box.linear.width();
    const Moments body = bodies_.withLeastRatio(dividend, divisor(), box.ratio.body);
    const double ratio = valueOf(dividend, body) / valueOf(divisor(), body);
    return task_.inertiaWeight * (ratio * ratio - least.ratio * least.ratio);
  }

  /// Hollow where filling would raise this.
  AffineRow functionalOf(const Box& box) const {
    return box.ratio.dividend - 0.5 * (box.ratio.low + box.ratio.high) * divisor();
  }

  const SpinningTask& task_;
  const Moments& solid_;
  ExtremeBodies bodies_;
  Translation about_;
  AffineRows axis_;
  AffineRow linear_; ///< terms 1 and 2 of the objective
};

} // namespace

std::optional<SpinningBound> spinningBound(const SpinningTask& task, double volumeWeight,
                                           double known, const Moments& solid, double fillDensity,
                                           const AdmissibleCells& cells) {
  if (fillDensity == 1.0) return std::nullopt;
  const BranchAndBound search(task, volumeWeight, solid, fillDensity, cells);
  SpinningBound any = search.least(known, Axial::Any);
  if (any.isNear(known)) return any;
  // The relaxation's best body may have the middle moment about the axis.
  const SpinningBound greatest = search.least(known, Axial::Greatest);
  const SpinningBound least = search.least(known, Axial::Least);
  const SpinningBound& better = greatest.objective < least.objective ? greatest : least;
  any.problems += greatest.problems + least.problems;
  if (better.objective <= any.objective) return any;
  return SpinningBound{better.objective, better.functional, any.problems};
}

} // namespace massprops
