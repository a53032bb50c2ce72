#include "core/reduced/offset_problem.h"

#include "core/model/open_surface.h"
#include "core/physics/moments.h"

#include <utility>

namespace massprops {
namespace {

/// Hα at the vertices.
Vector fieldOf(const OffsetModel& model, const Eigen::Ref<const Vector>& coefficients) {
  return model.surface->interpolation * Vector(model.surface->basis.functions * coefficients);
}

/// Derivatives by the coefficients of what changes by row i of `rates` per unit of (Hα)_i; k
/// columns.
Matrix byCoefficients(const OffsetModel& model, const RowMatrix& rates) {
  return model.surface->interpolation.transposeTimes(rates).transpose() *
         model.surface->basis.functions;
}

/// d(moments)/d(coefficients) of a surface whose vertex i moves by sign·φ'_i per unit of (Hα)_i.
MomentJacobian jacobian(const OffsetModel& model, MomentRates rates, const Vector& slopes,
                        double sign) {
  rates.array().colwise() *= sign * slopes.array();
  MomentJacobian result = MomentJacobian::Zero(10, model.surface->basis.functions.cols());
  result.topRows(rates.cols()) = byCoefficients(model, rates);
  return result;
}

/// x_i + sign·offset_i·d_i
Points displaced(const OffsetModel& model, const Vector& offsets, double sign) {
  return model.surface->vertices + (sign * offsets).asDiagonal() * model.field.directions;
}

/// The cavity's moments and their derivatives by α.
class CavityMoments {
public:
  CavityMoments(const OffsetModel& model, const OffsetSurfaces& surfaces)
      : model_(model), slopes_(surfaces.innerSlopes), rows_(surfaces.inner.rows()),
        positions_(surfaces.inner), directions_(model.field.directions) {
    if (!model.isOpen) return;
    // The strips and lids have corners on the outer surface, which rest.
    positions_ = stacked(positions_, model.surface->vertices);
    directions_ = stacked(directions_, Points::Zero(rows_, 3));
  }

  /// `usesInertia`: if not, the second moments and their derivatives are 0.
  BodyState all(bool usesInertia) const {
    return withJacobian(momentsWithRates(positions_, model_.innerFaces, directions_, usesInertia));
  }

  BodyState below(double level) const {
    return withJacobian(momentsBelowWithRates(positions_, model_.innerFaces, directions_, level));
  }

private:
  BodyState withJacobian(MomentsWithRates both) const {
    if (both.rates.rows() > rows_) both.rates = both.rates.topRows(rows_).eval();
    return {both.moments, jacobian(model_, std::move(both.rates), slopes_, -1.0)};
  }

  const OffsetModel& model_;
  const Vector& slopes_;
  Eigen::Index rows_; ///< that move
  Points positions_, directions_;
};

/// Of the outer surface, by α and, if it moves, β.
BodyState outerState(const OffsetModel& model, const OffsetSurfaces& surfaces, bool usesInertia) {
  const Eigen::Index k = model.surface->basis.functions.cols();
  if (!model.outer) return {model.solidMoments + model.attached, MomentJacobian::Zero(10, k)};
  MomentsWithRates moved =
      momentsWithRates(surfaces.outer, model.surface->faces, model.field.directions, usesInertia);
  BodyState outer{moved.moments + model.attached, MomentJacobian::Zero(10, 2 * k)};
  outer.jacobian.rightCols(k) = jacobian(model, std::move(moved.rates), surfaces.outerSlopes, 1.0);
  return outer;
}

} // namespace

OffsetSurfaces offsetSurfaces(const OffsetModel& model, const Vector& coefficients) {
  const Eigen::Index k = model.surface->basis.functions.cols();
  OffsetSurfaces surfaces;
  BoundedOffsets inner = boundMap(model.inner, fieldOf(model, coefficients.head(k)));
  surfaces.innerOffsets = std::move(inner.offsets);
  surfaces.innerSlopes = std::move(inner.slopes);
  surfaces.inner = displaced(model, surfaces.innerOffsets, -1.0);
  if (model.outer) {
    BoundedOffsets outer = boundMap(*model.outer, fieldOf(model, coefficients.tail(k)));
    surfaces.outerOffsets = std::move(outer.offsets);
    surfaces.outerSlopes = std::move(outer.slopes);
    surfaces.outer = displaced(model, surfaces.outerOffsets, 1.0);
  }
  return surfaces;
}

Evaluation evaluate(const OffsetModel& model, const Goal& goal, const Weights& weights,
                    const Vector& coefficients) {
  const Eigen::Index k = model.surface->basis.functions.cols();
  const OffsetSurfaces surfaces = offsetSurfaces(model, coefficients);
  const CavityMoments cavityMoments(model, surfaces);
  const BodyState cavity = cavityMoments.all(goal.usesInertia());
  const BodyState outer = outerState(model, surfaces, goal.usesInertia());
  const double solidVolume = model.solidMoments[0];
  Vector volumeGradient = outer.jacobian.row(0).transpose();
  volumeGradient.head(k) -= cavity.jacobian.row(0).transpose();
  Evaluation e =
      evaluateBody(goal, weights,
                   bodyStates(model.fillings, outer, cavity,
                              [&](double level) { return cavityMoments.below(level); }),
                   (outer.mass[0] - cavity.mass[0]) / solidVolume, volumeGradient / solidVolume);

  // Term 4: Dirichlet energy δᵀLδ of the inner offsets.
  if (weights.smoothness != 0.0) {
    const Vector gradient = model.surface->laplacian * surfaces.innerOffsets;
    e.objective += weights.smoothness * surfaces.innerOffsets.dot(gradient);
    const Vector rate = 2.0 * weights.smoothness * gradient.cwiseProduct(surfaces.innerSlopes);
    e.objectiveGradient.head(k) += byCoefficients(model, rate).transpose();
  }

  // Term 6: mean squared displacement of the outer surface, Σ M_i ε_i² with ΣM_i = 1.
  if (model.outer && weights.outer != 0.0) {
    const Vector weighted = model.surface->mass.cwiseProduct(surfaces.outerOffsets);
    e.objective += weights.outer * weighted.dot(surfaces.outerOffsets);
    const Vector rate = 2.0 * weights.outer * weighted.cwiseProduct(surfaces.outerSlopes);
    e.objectiveGradient.tail(k) += byCoefficients(model, rate).transpose();
  }
  return e;
}

double offsetObjective(const MovingSurface& surface, const Weights& weights,
                       const Vector& innerOffsets, const Vector& outerOffsets) {
  double value = 0.0;
  if (innerOffsets.size() > 0 && weights.smoothness != 0.0) {
    value += weights.smoothness * innerOffsets.dot(surface.laplacian * innerOffsets);
  }
  if (outerOffsets.size() > 0) {
    value += weights.outer * surface.mass.dot(outerOffsets.cwiseAbs2());
  }
  return value;
}

Vector coefficientsFor(const OffsetModel& model, const Vector& inner, const Vector& outer) {
  // HᵀMH = 1, so the M-orthogonal projection is HᵀM; on a carrier M is what it stands for.
  const Eigen::Index k = model.surface->basis.functions.cols();
  Vector coefficients(model.outer ? 2 * k : k);
  const auto project = [&](const Vector& field) {
    const Vector weighted = model.surface->mass.cwiseProduct(field);
    return Vector(byCoefficients(model, weighted).transpose());
  };
  coefficients.head(k) = project(inner);
  if (model.outer) coefficients.tail(k) = project(outer);
  return coefficients;
}

} // namespace massprops
