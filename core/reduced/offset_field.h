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

/// A direction counts as inside of its vertex's cone when n_f·d is at least this much for all its
/// faces. Slanted ones keep near to the skeleton; steep ones hollow bumps and the ends of limbs
/// out, where slanted offsets leave walls that are too thick.
constexpr double kWantedClearance = 0.4;

/// Makes a skeleton's correspondence that is smooth over the surface fit for offsetting
/// (docs/math.md "Offset directions"): directions outside of the cone of the faces around their
/// vertex are turned into it, and the reach ends half-way through the body and varies no faster
/// than the surface does. `axis`: n×3, see `smoothedOverSurface`.
OffsetField offsetField(const Points& vertices, const Faces& faces, const Points& axis);

/// The values spread over the surface, (M + t²L) s' = M s. `values`: n×3; `length` t > 0: same unit
/// as the vertices.
/// \throw std::runtime_error when the system cannot be solved
Points smoothedOverSurface(const Points& values, const SparseMatrix& L, const Vector& mass,
                           double length);

} // namespace massprops
