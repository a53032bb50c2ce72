// The optimisation problem: from basis coefficients to objective and constraints, with derivatives.
#pragma once

#include "core/goals/objective.h"
#include "core/mesh/interpolation.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/offset_bounds.h"

#include <optional>

namespace massprops {

/// All that does not change while the coefficients do. Working frame throughout.
struct OffsetModel {
  const Points& vertices;     ///< n×3, of the input surface
  const Faces& faces;         ///< of the outer surface
  const Points& directions;   ///< n×3, unit, outwards
  const HarmonicBasis& basis; ///< n×k, or p×k on a proxy
  const SparseMatrix& L;      ///< n×n cotangent Laplacian; needed where smoothness has a weight
  const Vector& mass;         ///< n lumped masses of total 1
  OffsetBounds inner;
  std::optional<OffsetBounds> outer; ///< empty: the outer surface stays
  /// Of the cavity, outward, over the same vertices; of an open surface over 2n positions
  /// (open_surface.h).
  Faces innerFaces;
  double fillDensity = 0.0; ///< as a multiple of the material's density
  Moments solidMoments;     ///< of the input surface
  /// From the proxy that the basis lives on to the vertices; null where it lives on these.
  const Interpolation* interpolation = nullptr;
  bool isOpen = false; ///< whether `innerFaces` are those of an open surface
};

/// The two surfaces that a set of coefficients stands for.
struct OffsetSurfaces {
  Points inner, outer;              ///< n×3; the latter empty when the outer surface stays
  Vector innerOffsets, innerSlopes; ///< δ = φ(Hα) and φ'
  Vector outerOffsets, outerSlopes; ///< ε = φ(Hβ) and φ'; empty when the outer surface stays
};

/// `coefficients`: α (k), followed by β (k) when the outer surface moves.
OffsetSurfaces offsetSurfaces(const OffsetModel& model, const Vector& coefficients);

/// The cavity's moments and their derivatives by α.
struct CavityMoments {
  Moments value;
  MomentJacobian jacobian;
};
/// `usesInertia`: if not, the second moments and their derivatives are 0.
CavityMoments cavityMoments(const OffsetModel& model, const Vector& coefficients, bool usesInertia);

/// Objective terms 1–3 and 5 and the goal's constraints, while the outer surface stays.
Evaluation evaluateCavity(const OffsetModel& model, const Goal& goal, const Weights& weights,
                          const CavityMoments& cavity);

/// Objective terms 1–6 and the goal's constraints at `coefficients`; docs/math.md "Objective".
Evaluation evaluate(const OffsetModel& model, const Goal& goal, const Weights& weights,
                    const Vector& coefficients);

/// The same objective of bodies that are given by their moments and offsets, for reports.
/// `volumeShare`: material over volume of the solid; `innerOffsets`, `outerOffsets`: n entries, or
/// empty where that surface does not move.
double objectiveValue(const Goal& goal, const Weights& weights, const Moments& massMoments,
                      double volumeShare, const SparseMatrix& L, const Vector& innerOffsets,
                      const Vector& mass, const Vector& outerOffsets);

/// Coefficients whose fields come nearest, in the mean square, to the wanted ones Hα ≈ inner and
/// Hβ ≈ outer.
Vector coefficientsFor(const OffsetModel& model, const Vector& inner, const Vector& outer);

} // namespace massprops
