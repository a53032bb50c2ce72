// Where a ball fits behind the surface, and what is near such places.
#pragma once

#include "core/query/grid_function.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace massprops {

/// Places of the ball's middle next to nodes of a grid, by the nodes' numbers, that were asked for
/// lately, by any thread.
class PlacesAtNodes {
public:
  /// Empty: it is not known; of an empty place: that there is none.
  std::optional<std::optional<Vec3>> find(std::int64_t node) const;
  void add(std::int64_t node, const std::optional<Vec3>& place);

private:
  struct Part {
    mutable std::mutex access;
    std::unordered_map<std::int64_t, std::optional<Vec3>> places;
  };
  static constexpr std::size_t kParts = 64;  // so that threads seldom wait
  static constexpr std::size_t kMost = 1500; // in each: 6 MB in all
  static std::size_t partOf(std::int64_t node);

  std::array<Part, kParts> parts_;
};

/// Lengths.
struct Opening {
  double fits;  ///< least depth behind the surface at which the ball's middle may be
  double reach; ///< what is farther than that from every such place is too narrow
  /// What probes of it know together.
  std::shared_ptr<PlacesAtNodes> known = std::make_shared<PlacesAtNodes>();
};

/// Looks for the nearest place that the ball's middle may be at, of points one after the other; it
/// is quick where they are near each other.
class OpeningProbe {
public:
  /// `slack`: the share of the distance from the surface by which this may be found too large.
  OpeningProbe(const TriangleTree& surface, const Opening& opening, double slack = 0.0);

  /// The opening's reach less the distance from the nearest place. `depth`: behind the surface at
  /// x. Infinity where that is at least `enough`, or the ball's middle may be at x itself; empty
  /// where no place is found within the reach and `horizon`.
  ///
  /// By cutting planes [Kel60]: where depth bends down, as in a room between walls, that is the
  /// nearest one. Elsewhere, as where plates meet, it may be passed over: where the place found is
  /// not near enough those next to the nodes of a grid count, too.
  std::optional<Sample> at(const Vec3& x, const Sample& depth, double enough, double horizon);

  /// Whether `at` is known to be as much at least.
  bool isSurely(const Vec3& x, double enough) const {
    return known_ && opening_.reach - (x - *known_).norm() >= enough;
  }

  /// Behind the surface, exact where the ball does not fit. `isInside`: x is known to lie inside.
  Sample depthAt(const Vec3& x, bool isInside);

private:
  std::optional<Vec3> placeNear(const Vec3& x, const Sample& depth, double farthest);
  std::optional<Vec3> placeAround(const Vec3& x, const Vec3& onSurface, double farthest);
  std::optional<Vec3> placeAtNode(const Eigen::Array3i& node);

  const TriangleTree& surface_;
  Opening opening_;
  double slack_;
  PointInMesh inside_;
  int nearestFace_ = -1;
  std::optional<Vec3> known_; ///< the last place
  double spacing_;            ///< of nodes
  double nodeReach_;          ///< how far a node's place may be from it: half a cube's diagonal
};

} // namespace massprops
