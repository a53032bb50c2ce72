// Small cubes along the border of a region.
#pragma once

#include "core/contour/region.h"

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

namespace massprops {

using Place = Eigen::Vector3i;

struct PlaceHash {
  std::size_t operator()(const Place& place) const;
};
/// Numbers of places.
using PlaceNumbers = std::unordered_map<Place, int, PlaceHash>;

/// A corner of cubes.
struct Corner {
  Place place;
  /// Not where the value is negative, and not everywhere else, see `borderLattice`.
  bool isInside = false;
  /// By `takeOut`: the border shall keep away from it.
  bool isTakenOut = false;
  /// Empty: so far inside that it does not matter.
  std::optional<Sample> inset, cut;
  /// Where inset and cut come together at an acute angle: what cuts the edge between them off.
  std::optional<Sample> chamfer;

  /// Of the region, about a signed distance; large where both are empty.
  double value() const;
};

/// The cubes of one size that the border of the region passes through. In each the corners that
/// are inside are connected along its edges, and so are those that are not: the border cuts it in
/// one piece that has the shape of a disc.
struct BorderLattice {
  Vec3 origin = Vec3::Zero();
  double edge = 0.0;
  std::deque<Corner> corners; ///< many: a vector that grows would hold them twice
  /// Corner i of a cube is the one at its place plus (i & 1, i >> 1 & 1, i >> 2).
  std::vector<std::array<int, 8>> cubes;
  PlaceNumbers cubeAt, cornerAt;

  Vec3 positionOf(int corner) const {
    return origin + edge * corners[static_cast<std::size_t>(corner)].place.cast<double>();
  }
  /// A bit for each corner of a cube that is inside.
  unsigned cornersInside(int cube) const;
};

/// Cubes of the given edge. Where inset and cut are nearer to each other than a share of it, and
/// wherever too little is inside for cubes of that size, something is taken out of the region;
/// never put into it.
BorderLattice borderLattice(const Region& region, double edge);

/// Takes the corners of the cubes around these points out of the region, too.
void takeOut(const std::vector<Vec3>& points, BorderLattice& lattice);

} // namespace massprops
