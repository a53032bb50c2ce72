#include "core/base/minimize.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace massprops {
namespace {

/// SLSQP's line search starts with a step as long as the gradient: about ten times the unit of the
/// variables' useful range was seen to need the fewest evaluations.
constexpr double kGradientNorm = 10.0;

double violationOf(const Evaluation& e) {
  double violation = 0.0;
  if (e.equalities.size() > 0) violation = e.equalities.cwiseAbs().maxCoeff();
  if (e.inequalities.size() > 0) violation = std::max(violation, e.inequalities.maxCoeff());
  return violation;
}

/// SLSQP may propose points that are no numbers.
bool isFinite(const Evaluation& e) {
  return std::isfinite(e.objective) && e.equalities.allFinite() && e.inequalities.allFinite();
}

double scaleFor(double gradientNorm, double wanted) {
  return gradientNorm > 0.0 && std::isfinite(gradientNorm) ? wanted / gradientNorm : 1.0;
}

/// NLopt asks for objective and constraints one after the other at the same point.
class ScaledProblem {
public:
  ScaledProblem(const Problem& problem, const Vector& start, const MinimizeOptions& options)
      : problem_(problem), options_(options) {
    best_.objective = std::numeric_limits<double>::infinity();
    best_.violation = std::numeric_limits<double>::infinity();
    best_.x = start;
    const Evaluation& e = at(start);
    objectiveScale_ =
        options.objectiveScale.value_or(scaleFor(e.objectiveGradient.norm(), kGradientNorm));
    equalityScales_.resize(e.equalities.size());
    for (Eigen::Index i = 0; i < e.equalities.size(); ++i) {
      equalityScales_[i] = scaleFor(e.equalityJacobian.row(i).norm(), 1.0);
    }
    inequalityScales_.resize(e.inequalities.size());
    for (Eigen::Index i = 0; i < e.inequalities.size(); ++i) {
      inequalityScales_[i] = scaleFor(e.inequalityJacobian.row(i).norm(), 1.0);
    }
  }

  const Evaluation& at(const Vector& x) {
    return at(std::vector<double>(x.data(), x.data() + x.size()));
  }

  const Evaluation& at(const std::vector<double>& x) {
    if (x != point_) {
      point_ = x;
      const Vector v = Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
      evaluation_ = problem_(v);
      ++best_.evaluations;
      if (!v.allFinite() || !isFinite(evaluation_)) return evaluation_;
      const double violation = std::max(0.0, violationOf(evaluation_) - options_.feasibility);
      if (violation < best_.violation ||
          (violation == best_.violation && evaluation_.objective < best_.objective)) {
        best_.x = v;
        best_.violation = violation;
        best_.objective = evaluation_.objective;
        bestEvaluationViolation_ = std::max(0.0, violationOf(evaluation_));
      }
    }
    return evaluation_;
  }

  MinimizeResult best() const {
    MinimizeResult result = best_;
    result.violation = bestEvaluationViolation_;
    result.objectiveScale = objectiveScale_;
    return result;
  }

  static double objective(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    auto& p = *static_cast<ScaledProblem*>(self);
    const Evaluation& e = p.at(x);
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      gradient[i] = p.objectiveScale_ * e.objectiveGradient[static_cast<Eigen::Index>(i)];
    }
    return p.objectiveScale_ * e.objective;
  }

  static void equalities(unsigned /*m*/, double* result, unsigned n, const double* x,
                         double* gradient, void* self) {
    auto& p = *static_cast<ScaledProblem*>(self);
    const Evaluation& e = p.at(std::vector<double>(x, x + n));
    constraints(e.equalities, e.equalityJacobian, p.equalityScales_, result, gradient);
  }

  static void inequalities(unsigned /*m*/, double* result, unsigned n, const double* x,
                           double* gradient, void* self) {
    auto& p = *static_cast<ScaledProblem*>(self);
    const Evaluation& e = p.at(std::vector<double>(x, x + n));
    constraints(e.inequalities, e.inequalityJacobian, p.inequalityScales_, result, gradient);
  }

  Eigen::Index equalityCount() const { return equalityScales_.size(); }
  Eigen::Index inequalityCount() const { return inequalityScales_.size(); }
  std::vector<double> tolerances(const Vector& scales) const {
    std::vector<double> result;
    for (const double s : scales) result.push_back(s * options_.feasibility);
    return result;
  }
  const Vector& equalityScales() const { return equalityScales_; }
  const Vector& inequalityScales() const { return inequalityScales_; }

private:
  static void constraints(const Vector& values, const Matrix& jacobian, const Vector& scales,
                          double* result, double* gradient) {
    Eigen::Map<Vector>(result, values.size()) = scales.cwiseProduct(values);
    if (gradient == nullptr) return;
    Eigen::Map<RowMatrix>(gradient, jacobian.rows(), jacobian.cols()) =
        scales.asDiagonal() * jacobian;
  }

  const Problem& problem_;
  MinimizeOptions options_;
  std::vector<double> point_;
  Evaluation evaluation_;
  MinimizeResult best_;
  double bestEvaluationViolation_ = std::numeric_limits<double>::infinity();
  double objectiveScale_ = 1.0;
  Vector equalityScales_;
  Vector inequalityScales_;
};

/// Equalities and violated inequalities with their derivatives, the residual of the restoration.
struct Residual {
  Vector values;
  Matrix jacobian;
};

Residual violatedConstraints(const Evaluation& e) {
  Residual residual{Vector(e.equalities.size() + e.inequalities.size()), {}};
  residual.jacobian = Matrix::Zero(residual.values.size(), e.objectiveGradient.size());
  residual.values << e.equalities, e.inequalities.cwiseMax(0.0);
  if (e.equalities.size() > 0) residual.jacobian.topRows(e.equalities.size()) = e.equalityJacobian;
  for (Eigen::Index i = 0; i < e.inequalities.size(); ++i) {
    if (e.inequalities[i] > 0.0) {
      residual.jacobian.row(e.equalities.size() + i) = e.inequalityJacobian.row(i);
    }
  }
  return residual;
}

/// Levenberg–Marquardt on the violated constraints, from the best point so far.
void restoreFeasibility(ScaledProblem& scaled, const MinimizeOptions& options) {
  constexpr int kMostSteps = 30;
  Vector x = scaled.best().x;
  Residual residual = violatedConstraints(scaled.at(x));
  double damping = 1e-6;
  for (int step = 0; step < kMostSteps; ++step) {
    if (scaled.best().violation <= options.feasibility) return;
    // (JJᵀ + damping) λ = r, Δx = −Jᵀλ: the shortest step, for there are fewer residuals than x.
    Matrix normal = residual.jacobian * residual.jacobian.transpose();
    normal.diagonal().array() += damping * std::max(normal.trace(), 1e-30);
    const Vector next = (x - residual.jacobian.transpose() * normal.ldlt().solve(residual.values))
                            .cwiseMax(-options.range)
                            .cwiseMin(options.range);
    const Residual reached = violatedConstraints(scaled.at(next));
    if (reached.values.squaredNorm() < residual.values.squaredNorm()) {
      const bool stalled =
          reached.values.squaredNorm() > (1.0 - 1e-4) * residual.values.squaredNorm();
      x = next;
      residual = reached;
      damping = std::max(1e-9, 0.2 * damping);
      if (stalled) return;
    } else {
      damping *= 10.0;
    }
  }
}

/// The largest violation v as one more variable, the last, counted from the start in units that
/// change it as much as the others do: h ≤ v, −h ≤ v, g ≤ v.
class LargestViolation {
public:
  LargestViolation(ScaledProblem& scaled, const Vector& start)
      : scaled_(scaled), count_(start.size()) {
    const Evaluation& e = scaled.at(start);
    start_ = violationOf(e);
    const auto steepen = [&](const Matrix& jacobian) {
      if (jacobian.rows() > 0) unit_ = std::max(unit_, jacobian.rowwise().norm().maxCoeff());
    };
    steepen(e.equalityJacobian);
    steepen(e.inequalityJacobian);
  }

  bool isConstant() const { return unit_ == 0.0; }
  std::size_t rows() const {
    return static_cast<std::size_t>(2 * scaled_.equalityCount() + scaled_.inequalityCount());
  }
  /// What a change by this share of the violation at the start is in the last variable.
  double change(double share) const { return share * start_ / unit_; }

  static double objective(const std::vector<double>& x, std::vector<double>& gradient, void*) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    if (!gradient.empty()) gradient.back() = 1.0;
    return x.back();
  }

  static void constraints(unsigned m, double* result, unsigned n, const double* x, double* gradient,
                          void* self) {
    auto& p = *static_cast<LargestViolation*>(self);
    const Evaluation& e = p.scaled_.at(std::vector<double>(x, x + n - 1));
    const Eigen::Index h = e.equalities.size();
    const Eigen::Index g = e.inequalities.size();
    Eigen::Map<Vector> values(result, m);
    values << e.equalities, -e.equalities, e.inequalities;
    values = (values.array() - p.start_) / p.unit_ - x[n - 1];
    if (gradient == nullptr) return;
    Eigen::Map<RowMatrix> rows(gradient, m, n);
    rows.rightCols<1>().setConstant(-1.0);
    auto jacobian = rows.leftCols(p.count_);
    if (h > 0) {
      jacobian.topRows(h) = e.equalityJacobian / p.unit_;
      jacobian.middleRows(h, h) = -e.equalityJacobian / p.unit_;
    }
    if (g > 0) jacobian.bottomRows(g) = e.inequalityJacobian / p.unit_;
  }

private:
  ScaledProblem& scaled_;
  Eigen::Index count_;
  double start_;
  double unit_ = 0.0;
};

/// From the best point so far, whatever the objective becomes.
void lowerLargestViolation(ScaledProblem& scaled, const MinimizeOptions& options) {
  constexpr double kLittle = 1e-8; // of the violation
  const Vector start = scaled.best().x;
  LargestViolation problem(scaled, start);
  if (problem.isConstant()) return;
  const auto count = static_cast<std::size_t>(start.size());
  nlopt::opt solver(nlopt::LD_SLSQP, static_cast<unsigned>(count + 1));
  solver.set_min_objective(LargestViolation::objective, &problem);
  const double exact = problem.change(kLittle);
  solver.add_inequality_mconstraint(LargestViolation::constraints, &problem,
                                    std::vector<double>(problem.rows(), exact));
  std::vector<double> most(count + 1, options.range);
  most.back() = std::numeric_limits<double>::infinity();
  solver.set_upper_bounds(most);
  for (double& bound : most) bound = -bound;
  solver.set_lower_bounds(most);
  solver.set_ftol_abs(exact);
  solver.set_maxeval(options.maxEvaluations);
  std::vector<double> x(start.data(), start.data() + start.size());
  x.push_back(0.0);
  double objective = 0.0;
  try {
    solver.optimize(x, objective);
  } catch (const std::runtime_error&) {
    // As in minimize(): the best point seen stands.
  }
}

std::string describe(nlopt::result result) {
  switch (result) {
  case nlopt::FTOL_REACHED:
    return "objective converged";
  case nlopt::XTOL_REACHED:
    return "coefficients converged";
  case nlopt::MAXEVAL_REACHED:
    return "evaluation limit";
  default:
    return "converged";
  }
}

} // namespace

MinimizeResult minimize(const Problem& problem, const Vector& start,
                        const MinimizeOptions& options) {
  ScaledProblem scaled(problem, start, options);
  const auto isAnywhereFinite = [&] { return std::isfinite(scaled.best().violation); };
  nlopt::opt solver(nlopt::LD_SLSQP, static_cast<unsigned>(start.size()));
  solver.set_min_objective(ScaledProblem::objective, &scaled);
  // More equalities than variables: there is nothing to minimise, only a way to the least
  // violation.
  const bool isOverdetermined = scaled.equalityCount() > start.size();
  if (scaled.equalityCount() > 0 && !isOverdetermined) {
    solver.add_equality_mconstraint(ScaledProblem::equalities, &scaled,
                                    scaled.tolerances(scaled.equalityScales()));
  }
  if (scaled.inequalityCount() > 0) {
    solver.add_inequality_mconstraint(ScaledProblem::inequalities, &scaled,
                                      scaled.tolerances(scaled.inequalityScales()));
  }
  solver.set_lower_bounds(-options.range);
  solver.set_upper_bounds(options.range);
  solver.set_ftol_abs(options.objectiveTolerance);
  solver.set_maxeval(options.maxEvaluations);
  // SLSQP may run out of evaluations on its way to the constraints: it goes on from the best point
  // while that comes nearer to them.
  constexpr int kMostPasses = 4;
  constexpr double kNearer = 0.7;
  std::string stopReason;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const double violationBefore = scaled.best().violation;
    const Vector from = pass == 0 ? start : scaled.best().x;
    std::vector<double> x(from.data(), from.data() + from.size());
    for (double& value : x) value = std::clamp(value, -options.range, options.range);
    double objective = 0.0;
    try {
      stopReason = isOverdetermined ? "more equalities than variables"
                                    : describe(solver.optimize(x, objective));
    } catch (const nlopt::roundoff_limited&) {
      stopReason = "converged to rounding";
    } catch (const std::runtime_error&) {
      // SLSQP gives up on a search direction it cannot improve along, which also happens at an
      // optimum; the best point seen stands, and its constraints are checked by the caller.
      stopReason = "no further descent";
    }
    if (!isAnywhereFinite()) break;
    restoreFeasibility(scaled, options);
    const double violation = scaled.best().violation;
    if (violation <= options.feasibility || (pass > 0 && violation > kNearer * violationBefore)) {
      break;
    }
  }
  if (options.comesNearest && isAnywhereFinite() && scaled.best().violation > options.feasibility) {
    lowerLargestViolation(scaled, options);
  }
  MinimizeResult result = scaled.best();
  result.stopReason = isAnywhereFinite() ? stopReason : "no evaluation was finite";
  return result;
}

} // namespace massprops
