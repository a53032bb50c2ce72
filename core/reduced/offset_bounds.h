// How far every vertex may move, and the map that keeps it there.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/offset_field.h"

#include <vector>

namespace massprops {

/// Bounds l_i ≤ u_i on the offsets, n each, working lengths.
struct OffsetBounds {
  Vector lower, upper;
};

/// Bounds aim at so many walls: what ends a little short of them, by the host's rounding or because
/// a correction did not quite do, still keeps the wall.
constexpr double kBeyondWall = 1.0015;

/// Inner surface: l_i = kBeyondWall·wall / clearance_i, so that the displaced faces are more than
/// `wall` behind their originals, measured perpendicular to them; u_i = factor·r_i. Where the body
/// is too thin, l_i > u_i. docs/math.md "Wall thickness".
OffsetBounds innerBounds(const OffsetField& field, double wall, double factor);

/// The same for a coarse copy, whose faces are turned against the surface's own, with the cosine
/// between d_i and the mean normal at vertex i for clearance_i. `keepingWall` sees to the rest.
OffsetBounds innerBoundsOfCopy(const OffsetField& field, double wall, double factor);

/// The same bounds with the lower ones raised until every vertex x_i − l_i d_i is at least `wall`
/// away from the whole surface, not only from the faces around it; past u_i where that cannot be.
OffsetBounds keepingWall(const Points& vertices, const TriangleTree& surface,
                         const OffsetField& field, OffsetBounds bounds, double wall);

/// Vertices without room between their bounds, or without a direction that moves all their faces
/// inwards: 1, else 0.
std::vector<char> tooThin(const OffsetField& field, const OffsetBounds& bounds);

/// Outer surface: displacements in [lower, upper] along d_i; the ground contacts at z = 0 stay
/// where they are, and no other vertex loses more than half of its height, so that none joins them.
OffsetBounds outerBounds(const Points& vertices, const OffsetField& field, double lower,
                         double upper);

/// Offsets φ_i(t_i) in (l_i, u_i) and the derivatives φ'_i(t_i) in (0, 1], n each.
struct BoundedOffsets {
  Vector offsets, slopes;
};

/// φ(t) = c + w/2 · τ/√(1+τ²) with τ = 2(t−c)/w, c = (u+l)/2, w = u−l: smooth, monotone, slope 1 at
/// the middle, scale-free. docs/math.md "Bounds inside the objective".
BoundedOffsets boundMap(const OffsetBounds& bounds, const Vector& t);

} // namespace massprops
