// The cubes along the border of a cavity.
#pragma once

#include "core/contour/quadric_cut.h"
#include "core/optimum/feasible_region.h"

#include <array>
#include <optional>
#include <vector>

namespace massprops {

/// What the cavity is like at a corner: where all that is known there is positive.
struct CornerSamples {
  std::optional<Sample> wall; ///< depth behind the wall; empty: well behind it
  std::optional<Sample> open; ///< by the ball; empty: certainly reached, or nothing found
  std::optional<Sample> cut;  ///< the quadric; empty: there is none
  bool isReached = true;      ///< else no place of the ball was found

  double value() const;
};

struct LatticeCorner {
  std::array<std::int16_t, 3> place;
  bool isInside;
  bool isTakenOut = false; ///< the border shall keep away from it
  int sample;              ///< of the region's corners; −1: well behind the walls
};

/// The cubes that the border of the cavity passes through. In each the corners that are inside are
/// connected along its edges, and so are those that are not: the border cuts it in one piece that
/// has the shape of a disc.
class BorderLattice {
public:
  /// Refers to all of them. `cut`: none: all of the region.
  BorderLattice(const FeasibleSet& set, const FeasibleRegion& region,
                const std::optional<QuadricCut>& cut);

  /// Takes the corners of the cubes around these points out of the cavity.
  void takeOut(const std::vector<Vec3>& points);

  double edge() const { return region_.edge; }
  /// Corner i of a cube is the one at its place plus `cornerStep`(i).
  const std::vector<std::array<int, 8>>& cubes() const { return cubes_; }
  const LatticeCorner& corner(int c) const { return corners_[static_cast<std::size_t>(c)]; }
  Place placeOf(int c) const {
    const auto& p = corner(c).place;
    return {p[0], p[1], p[2]};
  }
  Vec3 positionOf(int c) const { return region_.positionOf(placeOf(c)); }
  int cubeAt(const Place& place) const; ///< −1: there is none
  /// A bit for each corner of a cube that is inside.
  unsigned cornersInside(int cube) const;
  CornerSamples samplesAt(int c) const;

private:
  /// Whether a corner that the region has no sample of lies well behind the walls, or may lie
  /// anywhere.
  enum class Unknown { Inside, Asked };
  int addCube(const Place& place, Unknown unknown);
  int addCorner(const Place& place, Unknown unknown);
  void addCutCubes(const WholeCube& cube);
  void addMissing();
  void tame(std::vector<int> wild);
  bool isCutInside(const Vec3& x) const;

  const FeasibleRegion& region_;
  const std::optional<QuadricCut>& cut_;
  std::vector<LatticeCorner> corners_;
  std::vector<std::array<int, 8>> cubes_;
  PlaceNumbers cornerNumbers_, cubeNumbers_;
  RegionProbe probe_;
};

} // namespace massprops
