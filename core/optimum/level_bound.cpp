#include "core/optimum/level_bound.h"

#include "core/base/minimize.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Levels that differ by less are the same.
constexpr double kSameLevel = 1e-6;
/// Share of a condition that has just been found to be broken.
constexpr double kFirstShare = 0.05;

using Functionals = Eigen::Matrix<double, 11, Eigen::Dynamic>;

/// Columns (M, 1) of some of the states.
Functionals extended(const std::vector<Moments>& states, const std::vector<Eigen::Index>& numbers) {
  Functionals m(11, static_cast<Eigen::Index>(numbers.size()));
  Eigen::Index column = 0;
  for (const Eigen::Index s : numbers) {
    m.col(column++) << states[static_cast<std::size_t>(s)], 1.0;
  }
  return m;
}

/// The finite levels of contents, each once, ascending.
std::vector<double> heightsOf(const Fillings& fillings) {
  std::vector<double> heights;
  for (const Filling& filling : fillings) {
    if (filling.isPartial()) heights.push_back(filling.level);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

/// A condition in a state.
struct ConditionInState {
  Eigen::Index condition = 0, state = 0;
};

/// How many of the layers between the heights hold contents.
std::size_t filledLayers(const Filling& filling, const std::vector<double>& heights) {
  if (!filling.isPartial()) return heights.size() + 1;
  return static_cast<std::size_t>(std::upper_bound(heights.begin(), heights.end(), filling.level) -
                                  heights.begin());
}

/// The levels at which the conditions hold, a row a condition, a column a state.
Matrix levelsOf(const LinearConditions& conditions, const std::vector<Moments>& states) {
  std::vector<Eigen::Index> all(states.size());
  std::iota(all.begin(), all.end(), 0);
  const Functionals m = extended(states, all);
  return -(conditions.atZero * m).cwiseQuotient(conditions.slopes * m);
}

/// The bodies that meet a positive combination of the conditions best.
class Relaxations {
public:
  Relaxations(const LinearConditions& conditions, const Moments& solid, const Fillings& fillings,
              const AdmissibleCells& cells)
      : conditions_(conditions), solid_(solid), fillings_(fillings), cells_(cells),
        heights_(heightsOf(fillings)), usesInertia_(!conditions.atZero.middleCols(4, 6).isZero() ||
                                                    !conditions.slopes.middleCols(4, 6).isZero()) {
    const LayeredQuadric layers{heights_, {}};
    for (Eigen::Index c = 0; c < cells.rows(); ++c) {
      layerOf_.push_back(layers.layerAt(cells(c, 3) / cells(c, 0)));
    }
    best_.level = std::numeric_limits<double>::infinity();
    best_.states = solidStates();
    best_.reached = levelsOf(conditions_, best_.states).minCoeff();
  }

  struct Solution {
    std::vector<Moments> states;
    double level;
    Matrix slopes; ///< of the level by the multipliers, in states where one is not 0
  };

  /// Dinkelbach's iteration: the level only grows, and fast.
  Solution solve(const Matrix& multipliers) {
    constexpr int kMostSteps = 30;
    const Active active = activeStates(multipliers);
    const Matrix shares = multipliers(Eigen::all, active.numbers);
    const Functionals atZero = conditions_.atZero.transpose() * shares;
    const Functionals slopes = conditions_.slopes.transpose() * shares;
    Solution s{solidStates(), -std::numeric_limits<double>::infinity(), {}};
    LayeredQuadric worth; // of hollowing those; none for the solid body
    for (int step = 0; step < kMostSteps; ++step) {
      LayeredQuadric next;
      if (step > 0) next = worthOfHollowing(atZero + s.level * slopes, active.fillings);
      std::vector<Moments> states = step > 0 ? statesFor(next) : solidStates();
      const Functionals m = extended(states, active.numbers);
      const double level = -atZero.cwiseProduct(m).sum() / slopes.cwiseProduct(m).sum();
      if (!(level > s.level)) break;
      s.level = level;
      s.states = std::move(states);
      worth = std::move(next);
    }
    const Functionals m = extended(s.states, active.numbers);
    s.slopes = Matrix::Zero(multipliers.rows(), multipliers.cols());
    s.slopes(Eigen::all, active.numbers) =
        -(conditions_.atZero * m + s.level * conditions_.slopes * m) / slopes.cwiseProduct(m).sum();
    remember(s.states, worth);
    if (s.level < best_.level) {
      best_.level = s.level;
      best_.multipliers = multipliers;
      if (!isHollow_) best_.worth = worthOfHollowing(atZero + s.level * slopes, active.fillings);
    }
    return s;
  }

  const LevelBound& best() const { return best_; }
  std::vector<Moments> solidStates() const { return {fillings_.size(), solid_}; }

private:
  /// States whose multipliers are not all 0.
  struct Active {
    std::vector<Eigen::Index> numbers;
    Fillings fillings;
  };

  Active activeStates(const Matrix& multipliers) const {
    Active active;
    for (Eigen::Index s = 0; s < multipliers.cols(); ++s) {
      if (multipliers.col(s).isZero(0.0)) continue;
      active.numbers.push_back(s);
      active.fillings.push_back(fillings_[static_cast<std::size_t>(s)]);
    }
    return active;
  }

  void remember(const std::vector<Moments>& states, const LayeredQuadric& worth) {
    const double reached = levelsOf(conditions_, states).minCoeff();
    if (reached <= best_.reached) return;
    best_.reached = reached;
    best_.states = states;
    best_.worth = worth;
    isHollow_ = true;
  }

  /// What of each layer is hollow where that is worth it, by that many terms of the quadric.
  template <int Terms>
  std::vector<Moments> hollowParts(const LayeredQuadric& worth) const {
    std::vector<Moments> hollow(heights_.size() + 1, Moments::Zero());
    // The worth has no more heights than the cells have layers.
    std::vector<const Moments*> quadrics{&worth.quadrics.front()};
    for (const double height : heights_) quadrics.push_back(&worth.quadrics[worth.layerAt(height)]);
    for (Eigen::Index c = 0; c < cells_.rows(); ++c) {
      const std::size_t layer = layerOf_[static_cast<std::size_t>(c)];
      const double gain = quadrics[layer]->head<Terms>().dot(cells_.row(c).head<Terms>());
      if (gain > 0.0) hollow[layer] += cells_.row(c).transpose();
    }
    return hollow;
  }

  std::vector<Moments> statesFor(const LayeredQuadric& worth) const {
    std::vector<Moments> hollow = usesInertia_ ? hollowParts<10>(worth) : hollowParts<4>(worth);
    for (std::size_t layer = 1; layer < hollow.size(); ++layer) hollow[layer] += hollow[layer - 1];
    std::vector<Moments> states;
    for (const Filling& filling : fillings_) {
      const std::size_t filled = filledLayers(filling, heights_);
      states.emplace_back(solid_ - hollow.back() + filling.density * hollow[filled - 1]);
    }
    return states;
  }

  const LinearConditions& conditions_;
  const Moments& solid_;
  const Fillings& fillings_;
  const AdmissibleCells& cells_;
  std::vector<double> heights_;
  std::vector<std::size_t> layerOf_; ///< of each cell
  bool usesInertia_;
  LevelBound best_;
  bool isHollow_ = false; ///< its body
};

/// λ = x²/|x|² over some of the conditions, in some of the states, 0 for the others.
class Mixture {
public:
  Mixture(Eigen::Index conditions, Eigen::Index states)
      : conditions_(conditions), states_(states) {}

  void add(const ConditionInState& place) {
    places_.push_back(place);
    if (places_.size() > 1) x_ /= x_.norm();
    x_.conservativeResize(x_.size() + 1);
    x_[x_.size() - 1] = places_.size() > 1 ? std::sqrt(kFirstShare) : 1.0;
  }

  void leaveOut(Matrix& levels) const {
    for (const ConditionInState& p : places_) {
      levels(p.condition, p.state) = std::numeric_limits<double>::infinity();
    }
  }

  /// Turns the shares to where the relaxation's level is least.
  void optimize(Relaxations& relaxations) {
    if (places_.size() == 1) return;
    MinimizeOptions solver;
    solver.objectiveTolerance = 1e-9;
    solver.range = 2.0;
    const auto problem = [&](const Vector& x) {
      const double squared = x.squaredNorm();
      const Relaxations::Solution s = relaxations.solve(multipliers(x));
      Vector slopes(x.size());
      for (Eigen::Index j = 0; j < x.size(); ++j) {
        const ConditionInState& p = places_[static_cast<std::size_t>(j)];
        slopes[j] = s.slopes(p.condition, p.state);
      }
      Evaluation e;
      e.objective = s.level;
      const double mean = x.cwiseAbs2().dot(slopes) / squared;
      e.objectiveGradient = 2.0 / squared * x.cwiseProduct((slopes.array() - mean).matrix());
      return e;
    };
    x_ = minimize(problem, x_, solver).x;
  }

  Matrix multipliers() const { return multipliers(x_); }

private:
  Matrix multipliers(const Vector& x) const {
    Matrix lambda = Matrix::Zero(conditions_, states_);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const ConditionInState& p = places_[static_cast<std::size_t>(j)];
      lambda(p.condition, p.state) = x[j] * x[j] / x.squaredNorm();
    }
    return lambda;
  }

  Eigen::Index conditions_, states_;
  std::vector<ConditionInState> places_;
  Vector x_;
};

} // namespace

LayeredQuadric worthOfHollowing(const Eigen::Matrix<double, 11, Eigen::Dynamic>& functionals,
                                const Fillings& fillings) {
  LayeredQuadric worth{heightsOf(fillings), {}};
  worth.quadrics.assign(worth.heights.size() + 1, Moments::Zero());
  for (std::size_t s = 0; s < fillings.size(); ++s) {
    const Moments w = functionals.col(static_cast<Eigen::Index>(s)).head<10>();
    const std::size_t filled = filledLayers(fillings[s], worth.heights);
    for (std::size_t layer = 0; layer < worth.quadrics.size(); ++layer) {
      worth.quadrics[layer] += (layer < filled ? 1.0 - fillings[s].density : 1.0) * w;
    }
  }
  return worth;
}

LevelBound greatestLevel(const LinearConditions& conditions, const Moments& solid,
                         const Fillings& fillings, const AdmissibleCells& cells) {
  constexpr int kMostConditions = 16;
  Relaxations relaxations(conditions, solid, fillings, cells);
  Mixture mixture(conditions.atZero.rows(), static_cast<Eigen::Index>(fillings.size()));
  ConditionInState weakest;
  levelsOf(conditions, relaxations.solidStates()).minCoeff(&weakest.condition, &weakest.state);
  for (int count = 1; count <= kMostConditions; ++count) {
    mixture.add(weakest);
    mixture.optimize(relaxations);
    const Relaxations::Solution s = relaxations.solve(mixture.multipliers());
    const LevelBound& best = relaxations.best();
    if (best.level - best.reached <= kSameLevel * std::max(1.0, std::abs(best.level))) break;
    Matrix others = levelsOf(conditions, s.states);
    mixture.leaveOut(others);
    if (others.minCoeff(&weakest.condition, &weakest.state) >= s.level) break;
  }
  return relaxations.best();
}

} // namespace massprops
