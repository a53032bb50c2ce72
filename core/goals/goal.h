// What the hollowed body is to do, as mathematics: objective and constraints by mass moments.
#pragma once

#include "core/base/types.h"
#include "core/physics/half_spaces.h"
#include "core/physics/mass_properties.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace massprops {

/// Row vectors of derivatives by the ten mass moments.
using MomentGradients = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;

struct GoalValue {
  double value = 0.0;
  Eigen::Matrix<double, 1, 10> gradient = Eigen::Matrix<double, 1, 10>::Zero();
};

/// r constraint values and their derivatives, r×10.
struct GoalConstraints {
  Vector values;
  MomentGradients gradients;
};

/// Rows of a functional that is affine in the ten mass moments: the last column is the constant.
using AffineRows = Eigen::Matrix<double, Eigen::Dynamic, 11, Eigen::RowMajor>;
using AffineRow = Eigen::Matrix<double, 1, 11>;

double valueOf(const AffineRow& functional, const Moments& massMoments);

/// (atZero + t slopes)·(M, 1) ≤ 0, r rows: whether the body with the moments M reaches the level t,
/// the greater the better. The slopes are positive at every body.
struct LinearConditions {
  AffineRows atZero, slopes;
};

/// Rows that are to be 0 and rows that are to be ≤ 0 as conditions, the former with both signs.
/// `perLevel`: the slope of each.
LinearConditions linearConditions(const AffineRows& equalities, const AffineRows& inequalities,
                                  const AffineRow& perLevel);

/// The level that a body reaches.
double levelReached(const LinearConditions& conditions, const Moments& massMoments);

struct SpinningTask;

/// A goal sees a body through its ten mass moments M in the working frame, the material's density
/// being 1: M = outer − (1 − f) inner with f the filling's density, so that any function of M is
/// one of the cavity's moments with dM/d(inner) = f − 1. Where there is more than one filling
/// (`fillingsSeenBy`) the body is to serve the goal in each of these states. Everything is
/// dimensionless; objective and constraints are smooth, but for the kinks of a contact polygon with
/// very many corners (stand.h).
class Goal {
public:
  virtual ~Goal() = default;

  virtual GoalValue objective(const Moments& massMoments) const = 0;
  /// Each must be 0. Scaled so that 1 is a violation as large as the body itself.
  virtual GoalConstraints equalities(const Moments& massMoments) const = 0;
  /// Each must be ≤ 0; scaled likewise.
  virtual GoalConstraints inequalities(const Moments& massMoments) const = 0;
  /// Whether second moments matter; if not, their derivatives are 0 and need not be computed.
  virtual bool usesInertia() const = 0;
  /// What the goal asks for, where that is linear in the moments: it is met by a body that reaches
  /// `wantedLevel` of one of these. Empty: it is not linear.
  virtual std::vector<LinearConditions> conditions() const { return {}; }
  virtual double wantedLevel() const { return 0.0; }
  /// The verdict as one number in a unit that people know, the greater the better; empty: it is
  /// more than one, or as good as the objective.
  virtual std::optional<double> measure(const Moments& massMoments) const;
  /// The mass that is all that the goal wants, the material's density being 1; empty: it wants
  /// more, or something else.
  virtual std::optional<double> wantedMass() const { return std::nullopt; }
  /// What to pursue where the constraints cannot be kept; null: their least violation.
  virtual std::unique_ptr<Goal> insteadOfConstraints() const { return nullptr; }
  /// The same without constraints that part the bodies in two sets, which the best body often keeps
  /// by itself: a search begins with it. Null: there are none.
  virtual std::unique_ptr<Goal> relaxed() const { return nullptr; }
  /// What it minimises about which axis, where that is a matter of spinning; else null.
  virtual const SpinningTask* spinningTask() const { return nullptr; }
  /// Those of some half-spaces that hold all centres of mass that bodies can have, for which it is
  /// certain that none does what is asked for; empty: not certain. `best`: a body that there is;
  /// `centres` gives the half-spaces, which are asked for only where they count.
  virtual std::optional<HalfSpaces> noneCan(const Moments& best,
                                            const std::function<HalfSpaces()>& centres) const;
};

/// Largest |equality| or positive inequality.
double largestViolation(const Goal& goal, const Moments& massMoments);

} // namespace massprops
