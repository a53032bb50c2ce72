#include "core/offset_problem.h"

#include "core/moments.h"
#include "core/open_surface.h"

#include <utility>

namespace massprops {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Hα at the vertices.
Vector fieldOf(const OffsetModel& model, const Eigen::Ref<const Vector>& coefficients) {
  const Vector atBasis = model.basis.functions * coefficients;
  return model.interpolation != nullptr ? *model.interpolation * atBasis : atBasis;
}

/// Derivatives by the coefficients of what changes by row i of `rates` per unit of (Hα)_i; k
/// columns.
Matrix byCoefficients(const OffsetModel& model, const RowMatrix& rates) {
  if (model.interpolation == nullptr) return rates.transpose() * model.basis.functions;
  return model.interpolation->transposeTimes(rates).transpose() * model.basis.functions;
}

/// d(moments)/d(coefficients) of a surface whose vertex i moves by sign·φ'_i per unit of (Hα)_i.
MomentJacobian jacobian(const OffsetModel& model, const MomentRates& rates, const Vector& slopes,
                        double sign, bool usesInertia) {
  const Eigen::Index columns = usesInertia ? 10 : 4;
  const RowMatrix weighted = (sign * slopes).asDiagonal() * rates.leftCols(columns);
  MomentJacobian result = MomentJacobian::Zero(10, model.basis.functions.cols());
  result.topRows(columns) = byCoefficients(model, weighted);
  return result;
}

CavityMoments momentsOf(const OffsetModel& model, const OffsetSurfaces& surfaces,
                        bool usesInertia) {
  if (model.isOpen) {
    // The strips and lids have corners on the outer surface, which rest.
    const Eigen::Index n = model.vertices.rows();
    const Points both = stacked(surfaces.inner, model.vertices);
    const MomentRates rates =
        momentRates(both, model.innerFaces, stacked(model.directions, Points::Zero(n, 3)));
    return {moments(both, model.innerFaces),
            jacobian(model, rates.topRows(n), surfaces.innerSlopes, -1.0, usesInertia)};
  }
  return {moments(surfaces.inner, model.innerFaces),
          jacobian(model, momentRates(surfaces.inner, model.innerFaces, model.directions),
                   surfaces.innerSlopes, -1.0, usesInertia)};
}

/// Terms 1–3 and 5, while the outer surface stays.
Evaluation evaluateMoments(const OffsetModel& model, const Goal& goal, const Weights& weights,
                           const CavityMoments& cavity) {
  const double solidVolume = model.solidMoments[0];
  return evaluateBody(
      goal, weights, shellMoments(model.solidMoments, cavity.value, 1.0, model.fillDensity),
      (model.fillDensity - 1.0) * cavity.jacobian, (solidVolume - cavity.value[0]) / solidVolume,
      -cavity.jacobian.row(0).transpose() / solidVolume);
}

} // namespace

OffsetSurfaces offsetSurfaces(const OffsetModel& model, const Vector& coefficients) {
  const Eigen::Index k = model.basis.functions.cols();
  OffsetSurfaces surfaces;
  BoundedOffsets inner = boundMap(model.inner, fieldOf(model, coefficients.head(k)));
  surfaces.innerOffsets = std::move(inner.offsets);
  surfaces.innerSlopes = std::move(inner.slopes);
  surfaces.inner = model.vertices - surfaces.innerOffsets.asDiagonal() * model.directions;
  if (model.outer) {
    BoundedOffsets outer = boundMap(*model.outer, fieldOf(model, coefficients.tail(k)));
    surfaces.outerOffsets = std::move(outer.offsets);
    surfaces.outerSlopes = std::move(outer.slopes);
    surfaces.outer = model.vertices + surfaces.outerOffsets.asDiagonal() * model.directions;
  }
  return surfaces;
}

CavityMoments cavityMoments(const OffsetModel& model, const Vector& coefficients,
                            bool usesInertia) {
  return momentsOf(model, offsetSurfaces(model, coefficients), usesInertia);
}

Evaluation evaluate(const OffsetModel& model, const Goal& goal, const Weights& weights,
                    const Vector& coefficients) {
  const Eigen::Index k = model.basis.functions.cols();
  const OffsetSurfaces surfaces = offsetSurfaces(model, coefficients);
  const CavityMoments inner = momentsOf(model, surfaces, goal.usesInertia());
  Evaluation e;
  if (model.outer) {
    const double solidVolume = model.solidMoments[0];
    const Moments outer = moments(surfaces.outer, model.faces);
    const MomentJacobian outerJacobian =
        jacobian(model, momentRates(surfaces.outer, model.faces, model.directions),
                 surfaces.outerSlopes, 1.0, goal.usesInertia());
    MomentJacobian massJacobian(10, 2 * k);
    massJacobian << (model.fillDensity - 1.0) * inner.jacobian, outerJacobian;
    Vector volumeGradient(2 * k);
    volumeGradient << -inner.jacobian.row(0).transpose(), outerJacobian.row(0).transpose();
    e = evaluateBody(goal, weights, shellMoments(outer, inner.value, 1.0, model.fillDensity),
                     massJacobian, (outer[0] - inner.value[0]) / solidVolume,
                     volumeGradient / solidVolume);
  } else {
    e = evaluateMoments(model, goal, weights, inner);
  }

  // Term 4: Dirichlet energy δᵀLδ of the inner offsets.
  if (weights.smoothness != 0.0) {
    const Vector gradient = model.L * surfaces.innerOffsets;
    e.objective += weights.smoothness * surfaces.innerOffsets.dot(gradient);
    const Vector rate = 2.0 * weights.smoothness * gradient.cwiseProduct(surfaces.innerSlopes);
    e.objectiveGradient.head(k) += byCoefficients(model, rate).transpose();
  }

  // Term 6: mean squared displacement of the outer surface, Σ M_i ε_i² with ΣM_i = 1.
  if (model.outer && weights.outer != 0.0) {
    const Vector weighted = model.mass.cwiseProduct(surfaces.outerOffsets);
    e.objective += weights.outer * weighted.dot(surfaces.outerOffsets);
    const Vector rate = 2.0 * weights.outer * weighted.cwiseProduct(surfaces.outerSlopes);
    e.objectiveGradient.tail(k) += byCoefficients(model, rate).transpose();
  }
  return e;
}

double objectiveValue(const Goal& goal, const Weights& weights, const Moments& massMoments,
                      double volumeShare, const SparseMatrix& L, const Vector& innerOffsets,
                      const Vector& mass, const Vector& outerOffsets) {
  double value = momentObjective(goal, weights, massMoments, volumeShare);
  if (innerOffsets.size() > 0 && weights.smoothness != 0.0) {
    value += weights.smoothness * innerOffsets.dot(L * innerOffsets);
  }
  if (outerOffsets.size() > 0) {
    value += weights.outer * mass.dot(outerOffsets.cwiseAbs2());
  }
  return value;
}

Vector coefficientsFor(const OffsetModel& model, const Vector& inner, const Vector& outer) {
  // HᵀMH = 1, so the M-orthogonal projection is HᵀM; on a proxy M is what it stands for.
  const Eigen::Index k = model.basis.functions.cols();
  Vector coefficients(model.outer ? 2 * k : k);
  const auto project = [&](const Vector& field) {
    const Vector weighted = model.mass.cwiseProduct(field);
    return Vector(byCoefficients(model, weighted).transpose());
  };
  coefficients.head(k) = project(inner);
  if (model.outer) coefficients.tail(k) = project(outer);
  return coefficients;
}

} // namespace massprops
