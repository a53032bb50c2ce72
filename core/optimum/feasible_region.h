// Where a cavity may be: the points behind the walls that a ball reaches, sampled once.
#pragma once

#include "core/optimum/place_numbers.h"
#include "core/query/grid_function.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace massprops {

/// What the region is measured by; lengths in the surface's unit.
struct FeasibleSet {
  const TriangleTree& surface; ///< closed, outward
  double wall;                 ///< least depth behind the surface
  double ball;                 ///< diameter of the ball that must fit nearby; 0: none

  /// Depth at which the ball's middle may be: what facets take off a room as wide is left out.
  double fits() const;
  /// From the ball's middle on all within this belongs to the region: past √3 radii, so that the
  /// corner of a right-angled room does.
  double reach() const { return 1.8 * 0.5 * ball; }
};

/// A corner: the region is where all that is known there is positive.
struct RegionCorner {
  std::array<std::int16_t, 3> place{};
  bool isOpenKnown = false; ///< else the ball certainly reaches it
  bool isReached = true;    ///< else no place of the ball was found
  float wall = 0.0F;        ///< depth behind the surface less the wall
  float open = 0.0F;        ///< reach of the ball less the distance from its nearest place
  /// Unit vectors in which these grow.
  Eigen::Vector3f wallSlope = Eigen::Vector3f::UnitZ(), openSlope = Eigen::Vector3f::UnitZ();

  /// What tells the region. Where no place was found the border is taken to lie half an edge away.
  Sample least(double edge) const {
    if (!isReached) return {std::min(double{wall}, -0.5 * edge), wallSlope.cast<double>()};
    if (isOpenKnown && open < wall) return {open, openSlope.cast<double>()};
    return {wall, wallSlope.cast<double>()};
  }
};

/// A cube of 2^level edges all of which belongs to the region.
struct WholeCube {
  Place place;
  int level;
};

/// The region in equal cubes: those on its border by their corners, the others by the largest cubes
/// of the octree that they make up.
struct FeasibleRegion {
  Vec3 origin = Vec3::Zero(), extent = Vec3::Zero(); ///< of the surface's bounding box
  double edge = 0.0;
  std::vector<RegionCorner> corners;
  std::vector<std::array<int, 8>> border; ///< indices of corners, in the order of `cornerStep`
  std::vector<WholeCube> whole;

  PlaceNumbers cornerNumbers;

  int cornerAt(const Place& place) const { ///< −1: there is none
    return cornerNumbers.find(place, [&](int i) { return placeOf(i); });
  }
  bool isEmpty() const { return border.empty() && whole.empty(); }
  Vec3 positionOf(const Place& place) const { return origin + edge * place.cast<double>(); }
  Place placeOf(int corner) const {
    const auto& p = corners[static_cast<std::size_t>(corner)].place;
    return {p[0], p[1], p[2]};
  }
};

/// Signed distances at points one after the other; quick where they are near each other.
class RegionProbe {
public:
  explicit RegionProbe(const FeasibleSet& set);

  /// Depth behind the surface, negative outside, and the unit direction in which it grows; at most
  /// 5 % too large where it exceeds `exact`. `isInside`: known to be inside, which is quicker.
  Sample depthAt(const Vec3& x, double exact, bool isInside = false);

  bool isBehindWall(const Vec3& x) { return depthAt(x, set_.fits()).value > set_.wall; }

  /// The least of what tells the region at x: depth less the wall, and the ball's reach less the
  /// distance of its nearest place. At least −`horizon`, which it is where no place is found.
  double insetAt(const Vec3& x, double horizon);

  /// A place of the ball's middle near x, where the depth is the given one: by climbing along its
  /// slope to where it fits. Empty: none is found within reach.
  std::optional<Vec3> placeNear(const Vec3& x, const Sample& depth);
  /// The same for any depth to fit at and reach.
  std::optional<Vec3> placeNear(const Vec3& x, Sample depth, double fits, double reach);

private:
  FeasibleSet set_;
  PointInMesh inside_;
  TriangleTree::Hit nearest_;
};

/// Cubes of this edge, found by halving larger ones that the border may pass through: depths change
/// by no more than one moves. The surface must have fewer than 32,000 edges across.
/// \throw std::invalid_argument when it has more
FeasibleRegion feasibleRegion(const FeasibleSet& set, double edge);

/// The edge with which a cavity's surface leaves about a per cent of what is possible: such
/// that so many cubes lie on the border, and a node of them well inside of each room as wide as the
/// ball.
double edgeFor(const FeasibleSet& set);

/// The wall up to which there is room for a ball as wide as the wall behind it, where the surface
/// has room for one of this radius.
double wallWithRoomFor(double radius);

/// What of the region the function, positive inside, leaves.
FeasibleRegion within(const GridFunction& function, const FeasibleRegion& region);

} // namespace massprops
