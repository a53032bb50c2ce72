#include "core/optimum/optimal_bound.h"

#include "core/base/symmetric_eigen.h"
#include "core/base/tolerances.h"
#include "core/goals/level_problem.h"
#include "core/goals/objective.h"
#include "core/optimum/achievable_centres.h"
#include "core/optimum/spinning_bound.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace massprops {
namespace {

/// Of the largest: functions that hardly vary over the region are left out.
constexpr double kLeastSquare = 1e-10;

/// How much of a cell is hollow, and its derivative by t: 0…1.
struct Share {
  double value, slope;
};

/// Smooth everywhere: finds the way from any start.
Share softShare(double t) {
  const double root = 1.0 / std::sqrt(1.0 + t * t);
  return {0.5 * (1.0 + t * root), 0.5 * root * root * root};
}

/// 0 and 1 are reached at |t| = 1: only the cells that the quadric's border cuts are partly hollow.
Share sharpShare(double t) {
  if (t <= -1.0) return {0.0, 0.0};
  if (t >= 1.0) return {1.0, 0.0};
  return {0.5 + t * (0.75 - 0.25 * t * t), 0.75 * (1.0 - t * t)};
}

/// The terms of a quadric (or a plane, without inertia) over the cells, as functions of unit mean
/// square that are orthogonal over the region: of one scale each.
struct Functions {
  RowMatrix means;  ///< c×r, of each function over each cell
  Matrix whitening; ///< terms×r, from a function's coefficients to those of the terms
};

Functions orthonormalFunctions(const AdmissibleCells& cells, Eigen::Index terms) {
  const RowMatrix means = cells.col(0).cwiseInverse().asDiagonal() * cells.leftCols(terms);
  const SymmetricEigen<Matrix> spectrum =
      symmetricEigen(Matrix(means.transpose() * cells.leftCols(terms)));
  const Vector& squares = spectrum.values;
  const Eigen::Index rank = (squares.array() > kLeastSquare * squares.maxCoeff()).count();
  Functions functions;
  functions.whitening = spectrum.vectors.rightCols(rank) *
                        squares.tail(rank).cwiseInverse().cwiseSqrt().asDiagonal() *
                        std::sqrt(cells.col(0).sum());
  functions.means = means * functions.whitening;
  return functions;
}

/// The bodies that are hollow where Σ q_i ψ_i > 0, by q.
class HollowBodies {
public:
  /// `fillings`: without levels of contents.
  HollowBodies(const Goal& goal, const Weights& weights, const Moments& solid, Fillings fillings,
               const AdmissibleCells& cells)
      : goal_(goal), weights_(weights), solid_(solid), fillings_(std::move(fillings)),
        cells_(cells), functions_(orthonormalFunctions(cells, goal.usesInertia() ? 10 : 4)) {}

  /// First with a smooth border of the cavity, then with a sharp one.
  MinimizeResult best() const {
    // Half of every cell, almost nothing, almost everything: for several goals there is more than
    // one minimum.
    const Vector everything = functions_.means.transpose() * cells_.col(0) / cells_.col(0).sum();
    MinimizeResult best;
    best.violation = std::numeric_limits<double>::infinity();
    for (const double level : {0.0, -2.0, 2.0}) {
      MinimizeOptions solver = solverOptions();
      MinimizeResult result = minimize([&](const Vector& q) { return evaluate(q, softShare); },
                                       level * everything, solver);
      solver.range = kRangeOfSharp;
      result = minimize([&](const Vector& q) { return evaluate(q, sharpShare); }, 2.0 * result.x,
                        solver);
      const bool feasible = std::max(result.violation, best.violation) <= kFeasibility;
      if (feasible ? result.objective < best.objective : result.violation < best.violation) {
        best = std::move(result);
      }
    }
    return best;
  }

  /// From a quadric that is positive where a good body is hollow.
  MinimizeResult bestFrom(const Moments& quadric) const {
    MinimizeOptions solver = solverOptions();
    solver.range = kRangeOfSharp;
    solver.comesNearest = true;
    return minimize([&](const Vector& x) { return evaluate(x, sharpShare); },
                    sharpCoefficients(quadric), solver);
  }

  /// Likewise, with the highest level of the goal's conditions.
  Vector highestFrom(const Moments& quadric, const LinearConditions& conditions) const {
    const Vector start = sharpCoefficients(quadric);
    const Eigen::Index count = start.size();
    const LevelProblem problem(conditions, weights_, statesOf(hollow(start, sharpShare)));
    const auto evaluateAt = [&](const Vector& x) {
      const Hollow h = hollow(x.head(count), sharpShare);
      return problem.at(statesOf(h), 1.0 - h.cavity[0] / solid_[0],
                        -h.jacobian.row(0).transpose() / solid_[0], x[count]);
    };
    MinimizeOptions solver = solverOptions();
    solver.range = kRangeOfSharp;
    Vector begin = Vector::Zero(count + 1);
    begin.head(count) = start;
    return minimize(evaluateAt, begin, solver).x.head(count);
  }

  std::vector<Moments> states(const Vector& q) const {
    std::vector<Moments> result;
    for (const BodyState& state : statesOf(hollow(q, sharpShare))) result.push_back(state.mass);
    return result;
  }
  double objective(const Vector& q) const { return evaluate(q, sharpShare).objective; }

  /// Of (1, x, y, z, xx, yy, zz, xy, yz, zx).
  Moments quadric(const Vector& q) const {
    Moments quadric = Moments::Zero();
    quadric.head(functions_.whitening.rows()) = functions_.whitening * q;
    return quadric;
  }

private:
  using ShareOf = Share (*)(double);
  static constexpr double kRangeOfSharp = 200.0;

  static MinimizeOptions solverOptions() {
    MinimizeOptions options;
    options.feasibility = kFeasibility;
    options.maxEvaluations = 100;
    return options;
  }

  /// Only cells that its border cuts are hollow in part.
  Vector sharpCoefficients(const Moments& quadric) const {
    constexpr double kSharpness = 20.0;
    const Matrix& w = functions_.whitening;
    return kSharpness *
           (w.transpose() * w).ldlt().solve(w.transpose() * quadric.head(w.rows())).normalized();
  }

  struct Hollow {
    Moments cavity;
    MomentJacobian jacobian; ///< by q
  };

  Hollow hollow(const Vector& q, ShareOf shareOf) const {
    const RowMatrix& psi = functions_.means;
    Hollow h{Moments::Zero(), MomentJacobian::Zero(10, psi.cols())};
    const Vector t = psi * q;
    for (Eigen::Index c = 0; c < cells_.rows(); ++c) {
      const Share share = shareOf(t[c]);
      if (share.value != 0.0) h.cavity += share.value * cells_.row(c).transpose();
      if (share.slope != 0.0) {
        h.jacobian.noalias() += share.slope * cells_.row(c).transpose() * psi.row(c);
      }
    }
    return h;
  }

  std::vector<BodyState> statesOf(const Hollow& h) const {
    return bodyStates(fillings_, {solid_, MomentJacobian::Zero(10, h.jacobian.cols())},
                      {h.cavity, h.jacobian});
  }

  Evaluation evaluate(const Vector& q, ShareOf shareOf) const {
    const Hollow h = hollow(q, shareOf);
    return evaluateBody(goal_, weights_, statesOf(h), 1.0 - h.cavity[0] / solid_[0],
                        -h.jacobian.row(0).transpose() / solid_[0]);
  }

  const Goal& goal_;
  const Weights& weights_;
  const Moments& solid_;
  Fillings fillings_;
  const AdmissibleCells& cells_;
  Functions functions_;
};

/// Makes it the bound's body, but for what follows from its states, which are returned.
std::vector<Moments> take(const HollowBodies& bodies, const Vector& q, OptimalBound& bound) {
  std::vector<Moments> states = bodies.states(q);
  bound.massMoments = states.front();
  bound.objective = bodies.objective(q);
  bound.worth = {{}, {bodies.quadric(q)}};
  return states;
}

/// A local search. `fillings`: without levels of contents.
std::vector<Moments> findBody(const Goal& goal, const Weights& weights, const Moments& solid,
                              const Fillings& fillings, const AdmissibleCells& cells,
                              OptimalBound& bound) {
  std::vector<Moments> states;
  const auto search = [&](const Goal& pursued) {
    const HollowBodies bodies(pursued, weights, solid, fillings, cells);
    states = take(bodies, bodies.best().x, bound);
  };
  const std::unique_ptr<Goal> relaxed = goal.relaxed();
  if (relaxed) search(*relaxed);
  if (!relaxed || largestViolation(goal, states) > kFeasibility) search(goal);
  return states;
}

/// Hollow above a plane where a mass is all that is wanted: any body of it will do, and a local
/// search may stop where nothing is hollow, or all cells in part. The plane goes through the middle
/// of the cell of which a part is hollow; where the cells are too few all of them are. No states
/// where the solid body comes nearest.
std::vector<Moments> takeBodyOfMass(const Goal& goal, const Weights& weights, const Moments& solid,
                                    const Fillings& fillings, const AdmissibleCells& cells,
                                    OptimalBound& bound) {
  const std::optional<double> mass = goal.wantedMass();
  if (!mass) return {};
  const double volume = (solid[0] - *mass) / (1.0 - fillings.front().density);
  if (!(volume > 0.0) || cells.rows() == 0) return {};
  const auto heightOf = [&](Eigen::Index c) { return cells(c, 3) / cells(c, 0); };
  std::vector<Eigen::Index> fromAbove(static_cast<std::size_t>(cells.rows()));
  std::iota(fromAbove.begin(), fromAbove.end(), Eigen::Index{0});
  std::stable_sort(fromAbove.begin(), fromAbove.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return heightOf(a) > heightOf(b); });
  Moments cavity = Moments::Zero();
  double height = 1.0; // above everything
  for (const Eigen::Index c : fromAbove) {
    const double share = std::min((volume - cavity[0]) / cells(c, 0), 1.0);
    if (share <= 0.0) break;
    cavity += share * cells.row(c).transpose();
    height = heightOf(c);
  }
  std::vector<Moments> states;
  for (const Filling& filling : fillings) {
    states.emplace_back(solid - (1.0 - filling.density) * cavity);
  }
  bound.massMoments = states.front();
  bound.objective = momentObjective(goal, weights, states, 1.0 - cavity[0] / solid[0]);
  const bool isAll = cavity[0] < volume;
  bound.worth = LayeredQuadric::ofOneLayer(
      isAll ? Moments(Moments::Unit(0)) : Moments(Moments::Unit(3) - height * Moments::Unit(0)));
  return states;
}

/// How low the objective can be about an axis; a body that is nearer to that, if there is one.
void findLeastAboutAxis(const Goal& goal, const Weights& weights, const Moments& solid,
                        const Filling& filling, const AdmissibleCells& cells, OptimalBound& bound) {
  const SpinningTask* task = goal.spinningTask();
  const bool isConstrained = weights.constraints > 0.0;
  if (task == nullptr || !isConstrained || bound.violation > kFeasibility) return;
  const std::optional<SpinningBound> least =
      spinningBound(*task, weights.volume, bound.objective, solid, filling.density, cells);
  if (!least) return;
  if (!least->isNear(bound.objective)) {
    const HollowBodies bodies(goal, weights, solid, {filling}, cells);
    const MinimizeResult other =
        bodies.bestFrom((1.0 - filling.density) * least->functional.head<10>().transpose());
    if (other.violation <= kFeasibility && other.objective < bound.objective) {
      bound.violation = largestViolation(goal, take(bodies, other.x, bound));
    }
  }
  bound.objectiveAtLeast = std::min(bound.objective, least->objective);
}

/// The constraints next to a body as conditions: its level is 0 less the largest of them.
LinearConditions constraintsNear(const Goal& goal, const Moments& body) {
  const auto affine = [&](const GoalConstraints& constraints) {
    AffineRows rows(constraints.values.size(), 11);
    if (rows.rows() == 0) return rows;
    rows.leftCols<10>() = constraints.gradients;
    rows.col(10) = constraints.values - constraints.gradients * body;
    return rows;
  };
  return linearConditions(affine(goal.equalities(body)), affine(goal.inequalities(body)),
                          AffineRow::Unit(10));
}

/// Where constraints are out of reach there are many quadrics from which no step leads to a body
/// that is nearer to them. All bodies' moments are a convex set, though, and constraints are nearly
/// linear in them. [docs/math.md "The limit"]
void findNearest(const Goal& goal, const Weights& weights, const Moments& solid,
                 const Fillings& fillings, const AdmissibleCells& cells, OptimalBound& bound) {
  const bool isOne = fillings.size() == 1 && !fillings.front().isPartial();
  if (!isOne || bound.violation <= OptimalBound::kReachable || weights.constraints == 0.0 ||
      goal.insteadOfConstraints())
    return;
  constexpr int kMost = 4;
  constexpr double kLess = 0.999;
  const HollowBodies bodies(goal, weights, solid, fillings, cells);
  for (int i = 0; i < kMost; ++i) {
    const double known = bound.violation;
    const LevelBound level =
        greatestLevel(constraintsNear(goal, bound.massMoments), solid, fillings, cells);
    const double violation = largestViolation(goal, level.states);
    if (violation < bound.violation) {
      bound.massMoments = level.states.front();
      const double hollow = (solid[0] - bound.massMoments[0]) / (1.0 - fillings.front().density);
      bound.objective = momentObjective(goal, weights, level.states, 1.0 - hollow / solid[0]);
      bound.violation = violation;
      bound.worth = level.worth;
    }
    const MinimizeResult found = bodies.bestFrom(level.worth.quadrics.front());
    if (found.violation < bound.violation)
      bound.violation = largestViolation(goal, take(bodies, found.x, bound));
    if (bound.violation > kLess * known) break;
  }
}

/// Numbers of the states without a level of contents, and of those that the proof, if any, rests
/// on.
std::vector<std::size_t> bindingStates(const Fillings& fillings, const LevelBound* proof) {
  constexpr double kLeastShare = 1e-3;
  std::vector<std::size_t> binding;
  for (std::size_t s = 0; s < fillings.size(); ++s) {
    const auto column = static_cast<Eigen::Index>(s);
    const bool binds = proof != nullptr && proof->multipliers.col(column).sum() > kLeastShare;
    if (!fillings[s].isPartial() || binds) binding.push_back(s);
  }
  return binding;
}

template <class T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::size_t>& numbers) {
  std::vector<T> result;
  result.reserve(numbers.size());
  for (const std::size_t i : numbers) result.push_back(all[i]);
  return result;
}

/// Those without a level of contents.
Fillings wholeOf(const Fillings& fillings) {
  return chosen(fillings, bindingStates(fillings, nullptr));
}

std::vector<LevelBound> levelsOf(const Goal& goal, const Moments& solid, const Fillings& fillings,
                                 const AdmissibleCells& cells) {
  std::vector<LevelBound> levels;
  for (const LinearConditions& conditions : goal.conditions()) {
    levels.push_back(greatestLevel(conditions, solid, fillings, cells));
  }
  return levels;
}

/// Whole cells are too coarse for a level that several conditions hold down: here those at the
/// border are hollow in part. Makes the plane or quadric the bound's, and the body the level's
/// where it is better.
void refine(const Goal& goal, const Weights& weights, const Moments& solid,
            const Fillings& fillings, const AdmissibleCells& cells, OptimalBound& bound) {
  const std::optional<LinearConditions> conditions = conditionsOfMeasure(goal, solid);
  const bool isWhole = std::none_of(fillings.begin(), fillings.end(),
                                    [](const Filling& filling) { return filling.isPartial(); });
  if (!conditions || !isWhole || conditions->atZero.rows() == 1) return;
  const HollowBodies bodies(goal, weights, solid, fillings, cells);
  const Vector q = bodies.highestFrom(bound.worth.quadrics.front(), *conditions);
  bound.worth = LayeredQuadric::ofOneLayer(bodies.quadric(q));
  std::vector<Moments> states = bodies.states(q);
  double reached = std::numeric_limits<double>::infinity();
  for (const Moments& state : states) reached = std::min(reached, levelReached(*conditions, state));
  LevelBound& level = bound.levels.front(); // there is only one
  if (reached <= level.reached) return;
  level.reached = std::min(reached, level.level);
  level.states = std::move(states);
}

/// The best body within the cells and, where the goal has a measure, its levels. The states of the
/// body.
std::vector<Moments> findBest(const Goal& goal, const Weights& weights, const Moments& solid,
                              const Fillings& fillings, const AdmissibleCells& cells,
                              OptimalBound& bound) {
  if (goal.measure(solid)) bound.levels = levelsOf(goal, solid, fillings, cells);
  const std::vector<std::size_t> binding = bindingStates(fillings, bound.bestLevel());
  bound.binding = chosen(fillings, binding);
  std::vector<Moments> states;
  if (!bound.levels.empty() && weights.volume == 0.0) {
    const LevelBound& best = *bound.bestLevel();
    bound.worth = best.worth;
    refine(goal, weights, solid, fillings, cells, bound);
    states = best.states;
    bound.massMoments = states.front();
    Weights unconstrained = weights;
    unconstrained.constraints = 0.0;
    bound.objective = momentObjective(goal, unconstrained, chosen(states, binding), 1.0);
  } else {
    const Fillings whole = wholeOf(fillings);
    if (weights.constraints > 0.0)
      states = takeBodyOfMass(goal, weights, solid, whole, cells, bound);
    if (states.empty()) states = findBody(goal, weights, solid, whole, cells, bound);
    const std::unique_ptr<Goal> instead = goal.insteadOfConstraints();
    if (instead && weights.constraints > 0.0 && largestViolation(goal, states) > kFeasibility) {
      OptimalBound other;
      std::vector<Moments> nearer =
          findBest(*instead, insteadOfConstraints(weights), solid, whole, cells, other);
      if (largestViolation(goal, nearer) < largestViolation(goal, states)) {
        states = std::move(nearer);
        bound.worth = std::move(other.worth);
        bound.massMoments = other.massMoments;
        const double hollow =
            (solid[0] - states.front()[0]) / (1.0 - whole.front().density) / solid[0];
        bound.objective = momentObjective(goal, weights, states, 1.0 - hollow);
      }
    }
  }
  if (weights.volume == 0.0) bound.measure = measure(goal, states);
  bound.violation = largestViolation(goal, states);
  return states;
}

} // namespace

bool OptimalBound::isReachable() const {
  const LevelBound* best = bestLevel();
  return best != nullptr ? best->reached >= wantedLevel - kReachable : violationInAll <= kReachable;
}

const LevelBound* OptimalBound::bestLevel() const {
  const auto best =
      std::max_element(levels.begin(), levels.end(), [](const LevelBound& a, const LevelBound& b) {
        return a.reached < b.reached;
      });
  return best != levels.end() ? &*best : nullptr;
}

OptimalBound optimalBound(const Goal& goal, const Weights& weights, const Moments& solid,
                          const Fillings& fillings, const AdmissibleCells& cells) {
  OptimalBound bound;
  bound.wantedLevel = goal.wantedLevel();
  findBest(goal, weights, solid, fillings, cells, bound);
  findLeastAboutAxis(goal, weights, solid, fillings.front(), cells, bound);
  const bool isMeasured = goal.measure(solid).has_value();
  if (!isMeasured && bound.violation > OptimalBound::kReachable) {
    bound.levels = levelsOf(goal, solid, fillings, cells);
    findNearest(goal, weights, solid, fillings, cells, bound);
    if (bound.violation <= OptimalBound::kReachable) bound.levels.clear();
  }
  bound.massMomentsInAll = bound.massMoments;
  bound.violationInAll = bound.violation;
  bound.outOfReach = goal.noneCan(
      bound.massMoments, [&] { return achievableCentres(solid, fillings.front().density, cells); });
  return bound;
}

OptimalBound withBodyWithin(const AdmissibleCells& opened, OptimalBound bound, const Goal& goal,
                            const Weights& weights, const Moments& solid,
                            const Fillings& fillings) {
  OptimalBound other;
  if (opened.rows() > 0) {
    findBest(goal, weights, solid, fillings, opened, other);
    other.levels = std::move(bound.levels);
    if (!other.measure) findNearest(goal, weights, solid, fillings, opened, other);
  } else {
    other = bound;
    const std::vector<Moments> states(fillings.size(), solid);
    other.massMoments = solid;
    other.objective = momentObjective(goal, weights, states, 1.0);
    if (other.measure) other.measure = measure(goal, states);
    other.violation = largestViolation(goal, states);
  }
  other.objectiveAtLeast = bound.objectiveAtLeast;
  other.massMomentsInAll = bound.massMomentsInAll;
  other.violationInAll = bound.violationInAll;
  other.wantedLevel = bound.wantedLevel;
  other.outOfReach = std::move(bound.outOfReach);
  return other;
}

} // namespace massprops
