// The optimisation problem: from basis coefficients to objective and constraints, with derivatives.
#pragma once

#include "core/goals/objective.h"
#include "core/physics/filling.h"
#include "core/reduced/moving_surface.h"
#include "core/reduced/offset_bounds.h"

#include <memory>
#include <optional>

namespace massprops {

/// Which surface moves along which lines, how far, and over what. Working frame throughout.
struct OffsetModel {
  std::shared_ptr<const MovingSurface> surface; ///< n vertices, k functions
  OffsetField field;                            ///< of which the directions count here
  OffsetBounds inner;
  std::optional<OffsetBounds> outer; ///< empty: the outer surface stays
  /// Of the cavity, outward, over the same vertices; of an open surface over 2n positions
  /// (open_surface.h).
  Faces innerFaces;
  Fillings fillings{{}}; ///< in which the body is to serve the goal
  Moments solidMoments;  ///< of the input surface
  /// Of what the body has besides: negative where holes are drilled.
  Moments attached = Moments::Zero();
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

/// Objective terms 1–6 and the goal's constraints at `coefficients`; docs/math.md "Objective".
Evaluation evaluate(const OffsetModel& model, const Goal& goal, const Weights& weights,
                    const Vector& coefficients);

/// Terms 4 and 6, which depend on the offsets: n entries each, or empty where that surface does not
/// move.
double offsetObjective(const MovingSurface& surface, const Weights& weights,
                       const Vector& innerOffsets, const Vector& outerOffsets);

/// Coefficients whose fields come nearest, in the mean square, to the wanted ones Hα ≈ inner and
/// Hβ ≈ outer.
Vector coefficientsFor(const OffsetModel& model, const Vector& inner, const Vector& outer);

} // namespace massprops
