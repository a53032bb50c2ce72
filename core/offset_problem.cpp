#include "core/offset_problem.h"

#include "core/moments.h"

namespace massprops {
namespace {

/// d(moments)/d(coefficients) of a surface whose vertex i moves by sign·φ'_i per unit of (Hα)_i.
MomentJacobian jacobian(const OffsetModel& model, const MomentRates& rates, const Vector& slopes,
                        double sign, bool usesInertia) {
  const Eigen::Index columns = usesInertia ? 10 : 4;
  const Matrix weighted = (sign * slopes).asDiagonal() * rates.leftCols(columns);
  MomentJacobian result = MomentJacobian::Zero(10, model.basis.functions.cols());
  result.topRows(columns).noalias() = weighted.transpose() * model.basis.functions;
  return result;
}

} // namespace

OffsetSurfaces offsetSurfaces(const OffsetModel& model, const Vector& coefficients) {
  const Eigen::Index k = model.basis.functions.cols();
  OffsetSurfaces surfaces;
  BoundedOffsets inner = boundMap(model.inner, model.basis.functions * coefficients.head(k));
  surfaces.innerOffsets = std::move(inner.offsets);
  surfaces.innerSlopes = std::move(inner.slopes);
  surfaces.inner = model.vertices - surfaces.innerOffsets.asDiagonal() * model.directions;
  surfaces.outer = model.vertices;
  if (model.outer) {
    BoundedOffsets outer = boundMap(*model.outer, model.basis.functions * coefficients.tail(k));
    surfaces.outerOffsets = std::move(outer.offsets);
    surfaces.outerSlopes = std::move(outer.slopes);
    surfaces.outer += surfaces.outerOffsets.asDiagonal() * model.directions;
  }
  return surfaces;
}

Evaluation evaluate(const OffsetModel& model, const Goal& goal, const Weights& weights,
                    const Vector& coefficients) {
  const Eigen::Index k = model.basis.functions.cols();
  const OffsetSurfaces surfaces = offsetSurfaces(model, coefficients);

  // The ten mass moments and their derivatives by all coefficients.
  const Moments inner = moments(surfaces.inner, model.innerFaces);
  const Moments outer = model.outer ? moments(surfaces.outer, model.faces) : model.solidMoments;
  const double solidVolume = model.solidMoments[0];
  const Moments mass = shellMoments(outer, inner, 1.0, model.fillDensity);
  MomentJacobian massJacobian(10, coefficients.size());
  const MomentJacobian innerJacobian =
      jacobian(model, momentRates(surfaces.inner, model.innerFaces, model.directions),
               surfaces.innerSlopes, -1.0, goal.usesInertia());
  massJacobian.leftCols(k) = (model.fillDensity - 1.0) * innerJacobian;
  Vector volumeGradient = Vector::Zero(coefficients.size());
  volumeGradient.head(k) = -innerJacobian.row(0).transpose();
  if (model.outer) {
    massJacobian.rightCols(k) =
        jacobian(model, momentRates(surfaces.outer, model.faces, model.directions),
                 surfaces.outerSlopes, 1.0, goal.usesInertia());
    volumeGradient.tail(k) = massJacobian.rightCols(k).row(0).transpose();
  }

  Evaluation e = evaluateMoments(goal, weights, mass, massJacobian,
                                 (outer[0] - inner[0]) / solidVolume, volumeGradient / solidVolume);

  // Term 4: Dirichlet energy δᵀLδ of the inner offsets.
  if (weights.smoothness != 0.0) {
    const Vector gradient = model.L * surfaces.innerOffsets;
    e.objective += weights.smoothness * surfaces.innerOffsets.dot(gradient);
    e.objectiveGradient.head(k) +=
        model.basis.functions.transpose() *
        (2.0 * weights.smoothness * gradient.cwiseProduct(surfaces.innerSlopes));
  }

  // Term 6: mean squared displacement of the outer surface, Σ M_i ε_i² with ΣM_i = 1.
  if (model.outer && weights.outer != 0.0) {
    const Vector weighted = model.mass.cwiseProduct(surfaces.outerOffsets);
    e.objective += weights.outer * weighted.dot(surfaces.outerOffsets);
    e.objectiveGradient.tail(k) +=
        model.basis.functions.transpose() *
        (2.0 * weights.outer * weighted.cwiseProduct(surfaces.outerSlopes));
  }
  return e;
}

double objectiveValue(const Goal& goal, const Weights& weights, const Moments& massMoments,
                      double volumeShare, const SparseMatrix& L, const Vector& innerOffsets,
                      const Vector& mass, const Vector& outerOffsets) {
  double value = momentObjective(goal, weights, massMoments, volumeShare);
  if (innerOffsets.size() > 0) {
    value += weights.smoothness * innerOffsets.dot(L * innerOffsets);
  }
  if (outerOffsets.size() > 0) {
    value += weights.outer * mass.dot(outerOffsets.cwiseAbs2());
  }
  return value;
}

Vector coefficientsFor(const OffsetModel& model, const Vector& inner, const Vector& outer) {
  // HᵀMH = 1, so the M-orthogonal projection is HᵀM.
  const Eigen::Index k = model.basis.functions.cols();
  Vector coefficients(model.outer ? 2 * k : k);
  coefficients.head(k) = model.basis.functions.transpose() * model.mass.cwiseProduct(inner);
  if (model.outer) {
    coefficients.tail(k) = model.basis.functions.transpose() * model.mass.cwiseProduct(outer);
  }
  return coefficients;
}

} // namespace massprops
