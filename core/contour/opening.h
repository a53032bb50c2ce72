// Where a ball fits behind the surface, and what is near such places.
#pragma once

#include "core/query/grid_function.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

namespace massprops {

/// Places of the ball's middle next to a block of 4×4×4 nodes of a grid.
struct NodePlaces {
  std::bitset<64> known;    ///< nodes that were asked for, x first
  std::bitset<64> found;    ///< those with a place
  std::vector<Vec3> places; ///< of those, by number

  /// In rising order.
  void add(std::size_t node, const std::optional<Vec3>& place) {
    known.set(node);
    if (!place) return;
    found.set(node);
    places.push_back(*place);
  }

  /// \pre the node has one
  const Vec3& of(std::size_t node) const { return places[(found << (64 - node)).count()]; }
};

/// What is known of blocks by their numbers, as far as they were asked for lately, by any thread.
class KnownPlaces {
public:
  /// Null: nothing is known of it.
  std::shared_ptr<const NodePlaces> find(std::int64_t block) const;
  /// To what is known of it already.
  void add(std::int64_t block, const NodePlaces& places);

private:
  struct Part {
    mutable std::mutex access;
    std::unordered_map<std::int64_t, std::shared_ptr<const NodePlaces>> blocks;
    std::size_t held = 0; ///< places, and a few for each block
  };
  static constexpr std::size_t kParts = 64;  // so that threads seldom wait
  static constexpr std::size_t kMost = 4000; // in each: 6 MB in all
  static std::size_t partOf(std::int64_t block);

  std::array<Part, kParts> parts_;
};

/// Lengths.
struct Opening {
  double fits;  ///< least depth behind the surface at which the ball's middle may be
  double reach; ///< what is farther than that from every such place is too narrow
  /// What probes of it know together.
  std::shared_ptr<KnownPlaces> known = std::make_shared<KnownPlaces>();
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
  std::optional<Vec3> placeInBlock(const Eigen::Array3i& block, const Vec3& x,
                                   const Vec3& onSurface, double least);
  std::optional<Vec3> placeAtNode(const Vec3& node);

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
