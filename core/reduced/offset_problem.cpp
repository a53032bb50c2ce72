#include "core/reduced/offset_problem.h"

#include "core/base/parallel.h"
#include "core/model/open_surface.h"
#include "core/physics/moments.h"

#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr Eigen::Index kChunk = 1024;

/// Hα at the vertices.
Vector fieldOf(const OffsetModel& model, const Eigen::Ref<const Vector>& coefficients) {
  const auto& functions = model.surface->basis.functions;
  Vector atBasis(functions.rows());
  forChunks(atBasis.size(), kChunk, [&](const Chunk& chunk) {
    const Eigen::Index size = chunk.end - chunk.begin;
    atBasis.segment(chunk.begin, size) = functions.middleRows(chunk.begin, size) * coefficients;
  });
  return model.surface->interpolation * atBasis;
}

/// Derivatives by the coefficients of what changes by row i of `rates` per unit of (Hα)_i; k
/// columns.
Matrix byCoefficients(const OffsetModel& model, const RowMatrix& rates) {
  const auto& functions = model.surface->basis.functions;
  const RowMatrix atBasis = model.surface->interpolation.transposeTimes(rates);
  std::vector<Matrix> parts(static_cast<std::size_t>(chunkCount(atBasis.rows(), kChunk)));
  forChunks(atBasis.rows(), kChunk, [&](const Chunk& chunk) {
    const Eigen::Index size = chunk.end - chunk.begin;
    parts[static_cast<std::size_t>(chunk.number)].noalias() =
        atBasis.middleRows(chunk.begin, size).transpose() * functions.middleRows(chunk.begin, size);
  });
  Matrix sum = Matrix::Zero(rates.cols(), functions.cols());
  for (const Matrix& part : parts) sum += part;
  return sum;
}

/// d(moments)/d(coefficients) of a surface whose vertex i moves by sign·φ'_i per unit of (Hα)_i.
MomentJacobian jacobian(const OffsetModel& model, MomentRates rates, const Vector& slopes,
                        double sign) {
  forChunks(rates.rows(), kChunk, [&](const Chunk& chunk) {
    const Eigen::Index size = chunk.end - chunk.begin;
    rates.middleRows(chunk.begin, size).array().colwise() *=
        sign * slopes.segment(chunk.begin, size).array();
  });
  MomentJacobian result = MomentJacobian::Zero(10, model.surface->basis.functions.cols());
  result.topRows(rates.cols()) = byCoefficients(model, rates);
  return result;
}

/// x_i + sign·offset_i·d_i
Points displaced(const OffsetModel& model, const Vector& offsets, double sign) {
  Points result(offsets.size(), 3);
  forChunks(offsets.size(), kChunk, [&](const Chunk& chunk) {
    const Eigen::Index size = chunk.end - chunk.begin;
    const auto lengths = sign * offsets.segment(chunk.begin, size);
    result.middleRows(chunk.begin, size) =
        model.surface->vertices.middleRows(chunk.begin, size) +
        lengths.asDiagonal() * model.field.directions.middleRows(chunk.begin, size);
  });
  return result;
}

/// The cavity's moments and their derivatives by α.
struct CavityMoments {
  Moments value;
  MomentJacobian jacobian;
};

/// `usesInertia`: if not, the second moments and their derivatives are 0.
CavityMoments momentsOf(const OffsetModel& model, const OffsetSurfaces& surfaces,
                        bool usesInertia) {
  if (model.isOpen) {
    // The strips and lids have corners on the outer surface, which rest.
    const Eigen::Index n = model.surface->vertices.rows();
    const MomentsWithRates both =
        momentsWithRates(stacked(surfaces.inner, model.surface->vertices), model.innerFaces,
                         stacked(model.field.directions, Points::Zero(n, 3)), usesInertia);
    return {both.moments, jacobian(model, both.rates.topRows(n), surfaces.innerSlopes, -1.0)};
  }
  MomentsWithRates inner =
      momentsWithRates(surfaces.inner, model.innerFaces, model.field.directions, usesInertia);
  return {inner.moments, jacobian(model, std::move(inner.rates), surfaces.innerSlopes, -1.0)};
}

/// Terms 1–3 and 5 and the constraints, while the outer surface stays.
Evaluation evaluateCavity(const OffsetModel& model, const Goal& goal, const Weights& weights,
                          const CavityMoments& cavity) {
  const double solidVolume = model.solidMoments[0];
  return evaluateBody(
      goal, weights, shellMoments(model.solidMoments, cavity.value, 1.0, model.fillDensity),
      (model.fillDensity - 1.0) * cavity.jacobian, (solidVolume - cavity.value[0]) / solidVolume,
      -cavity.jacobian.row(0).transpose() / solidVolume);
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
  const CavityMoments inner = momentsOf(model, surfaces, goal.usesInertia());
  Evaluation e;
  if (model.outer) {
    const double solidVolume = model.solidMoments[0];
    MomentsWithRates moved = momentsWithRates(surfaces.outer, model.surface->faces,
                                              model.field.directions, goal.usesInertia());
    const Moments& outer = moved.moments;
    const MomentJacobian outerJacobian =
        jacobian(model, std::move(moved.rates), surfaces.outerSlopes, 1.0);
    MomentJacobian massJacobian(10, 2 * k);
    massJacobian << (model.fillDensity - 1.0) * inner.jacobian, outerJacobian;
    Vector volumeGradient(2 * k);
    volumeGradient << -inner.jacobian.row(0).transpose(), outerJacobian.row(0).transpose();
    e = evaluateBody(goal, weights, shellMoments(outer, inner.value, 1.0, model.fillDensity),
                     massJacobian, (outer[0] - inner.value[0]) / solidVolume,
                     volumeGradient / solidVolume);
  } else {
    e = evaluateCavity(model, goal, weights, inner);
  }

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
