// Along which line and how far every point of the surface may move inwards.
#pragma once

#include "core/base/types.h"
#include "core/reduced/laplacian.h"

namespace massprops {

struct OffsetField {
  /// n×3 unit outward directions d_i: the inner surface is x_i − δ_i d_i, the outer x_i + ε_i d_i.
  Points directions;
  /// n lengths r_i > 0: the farthest sensible inward offset, at the skeleton or half-way through
  /// the body along d_i, whichever is nearer.
  Vector reach;
  /// n entries in (−1, 1]: least n_f·d_i over the faces f at vertex i. Not positive: no direction
  /// moves all faces at that vertex inwards.
  Vector clearance;
  /// n entries, not below the former: n·d_i with the unit mean normal n at vertex i, weighted by
  /// area.
  Vector meanClearance;
};

/// Makes the raw skeleton correspondence fit for offsetting (docs/math.md "Offset directions"):
/// 1. The skeleton points are smoothed over the surface, (M + t²L) s' = M s.
/// 2. Directions outside of the cone of the faces around their vertex are turned into it.
/// 3. The reach ends half-way through the body and varies no faster than the surface does.
/// `skeleton`: n×3. `diffusionLength` t: same unit as the vertices, > 0.
OffsetField offsetField(const Points& vertices, const Faces& faces, const Points& skeleton,
                        const SparseMatrix& L, const Vector& mass, double diffusionLength);

/// A direction counts as inside of its vertex's cone when n_f·d is at least this much for all its
/// faces. Slanted ones keep near to the skeleton; steep ones hollow bumps and the ends of limbs
/// out, where slanted offsets leave walls that are too thick.
constexpr double kSlantedClearance = 0.3;
constexpr double kSteepClearance = 0.6;

/// Steps 2 and 3, with skeleton points that are smooth already.
OffsetField offsetField(const Points& vertices, const Faces& faces, const Points& axis,
                        double wantedClearance = kSlantedClearance);

/// Step 1. `values`: n×3.
Points smoothedOverSurface(const Points& values, const SparseMatrix& L, const Vector& mass,
                           double length);

} // namespace massprops
