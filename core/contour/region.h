// The points that may be hollow, as the positive side of a function.
#pragma once

#include "core/contour/opening.h"
#include "core/optimum/layered_quadric.h"
#include "core/query/grid_function.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <optional>

namespace massprops {

/// Points at least a wall behind the surface, next to where a ball fits, on the positive side of
/// the quadric, where nothing is filled. Working frame.
struct Region {
  const TriangleTree& surface; ///< closed, outward
  double wall;
  std::optional<Opening> opening = {};        ///< empty: they need not be
  std::optional<LayeredQuadric> quadric = {}; ///< empty: on both sides
  /// How far above and below a height between layers one quadric passes into the other, so that a
  /// step there is no jump.
  double transition = 0.0;
  const GridFunction* fill = nullptr; ///< null, or positive where nothing carries a ceiling
};

/// Of a quadric, in lengths. `transition`: see `Region`.
Sample cutAt(const LayeredQuadric& layered, double transition, const Vec3& x);

/// The same of the region's. \pre it has one
Sample cutAt(const Region& region, const Vec3& x);

/// The sign of the quadric within `radius` of x; Both where it may vanish there.
enum class Side { Positive, Negative, Both };
Side sideOfCut(const Region& region, const Vec3& x, double radius);

/// Samples what the walls leave, quadric apart, at points one after the other; it is quick where
/// they are near each other.
class InsetProbe {
public:
  /// `slack`: the share of the distance from the surface by which this may be found too large.
  explicit InsetProbe(const Region& region, double slack = 0.0);

  /// Exact, slack apart, between −`horizon` and `horizon`; beyond it too far from 0 by a twentieth
  /// at most, or ±`horizon`. `isInside`: x is known to lie inside of the surface, which makes it
  /// quicker.
  Sample at(const Vec3& x, double horizon, bool isInside = false);

  /// At the middle of a large cube, whose half diagonal is the horizon, as good as `at`, and
  /// quicker: what the walls alone leave, at most 0 where the ball does not fit.
  Sample roughlyAt(const Vec3& x, double horizon, bool isInside);

  /// Whether the last one is the distance from the surface alone: from where it is positive the way
  /// against its slope, as long as the value, ends on the border.
  bool isOfSurface() const { return isOfSurface_; }

  /// Whether the last one is −horizon for want of a place of the ball, which may yet be there where
  /// the horizon is wide.
  bool isInDoubt() const { return isInDoubt_; }

private:
  Sample behindWalls(const Vec3& x, double horizon, bool isInside);
  Sample opened(const Vec3& x, const Sample& inset, double horizon);
  Sample filled(const Vec3& x, const Sample& inset, double horizon);

  const Region& region_;
  double slack_;
  PointInMesh inside_;
  std::optional<OpeningProbe> opening_;
  TriangleTree::Hit nearest_;
  bool isOfSurface_ = true;
  bool isInDoubt_ = false;
  /// Around the last point; the surface does not come into it, so that all of it is on one side.
  struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
    bool isInside = false;
  } last_;
};

} // namespace massprops
