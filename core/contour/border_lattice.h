// Small cubes along the border of a region.
#pragma once

#include "core/contour/region.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {

using Place = Eigen::Vector3i;

/// Finds what is at a place by its number. A map of the standard library takes 50 bytes for each of
/// them, all corners and cubes half as much as everything else of a cavity: here it is eight, for
/// those whose places are asked for keep these themselves.
class PlaceNumbers {
public:
  /// The number at a place, −1 where there is none. `placeOf`(number): of those that were added.
  template <class PlaceOf>
  int find(const Place& place, const PlaceOf& placeOf) const {
    if (slots_.empty()) return -1;
    std::size_t slot = hash(place) & (slots_.size() - 1);
    while (slots_[slot] >= 0 && placeOf(slots_[slot]) != place)
      slot = (slot + 1) & (slots_.size() - 1);
    return slots_[slot];
  }

  /// Adds the next number, 0, 1 …, at a place that is not there yet. `placeOf`: of those before it.
  template <class PlaceOf>
  void add(const Place& place, const PlaceOf& placeOf) {
    constexpr std::size_t kFewest = 1024;
    if (3 * static_cast<std::size_t>(count_) >= 2 * slots_.size()) {
      slots_.assign(std::max(kFewest, 2 * slots_.size()), -1);
      for (int i = 0; i < count_; ++i) put(placeOf(i), i);
    }
    put(place, count_++);
  }

private:
  static std::size_t hash(const Place& place);
  void put(const Place& place, int number) {
    std::size_t slot = hash(place) & (slots_.size() - 1);
    while (slots_[slot] >= 0) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = number;
  }

  std::vector<int> slots_; ///< a power of two, a third of them free; −1: free
  int count_ = 0;
};

/// A corner of cubes. There are very many: the quadric is evaluated again where it is needed.
class Corner {
public:
  explicit Corner(const Place& place) : place_(place.cast<std::int16_t>()) {}

  Place place() const { return place_.cast<int>(); }

  /// Empty: so far inside that it does not matter.
  std::optional<Sample> inset() const {
    if (!hasInset_) return std::nullopt;
    return Sample{value_, slope_.cast<double>()};
  }
  bool hasInset() const { return hasInset_; }
  void setInset(const Sample& sample) {
    hasInset_ = true;
    value_ = sample.value;
    slope_ = sample.slope.cast<float>();
  }

private:
  double value_ = 0.0;
  Eigen::Vector3f slope_ = Eigen::Vector3f::Zero();
  Eigen::Matrix<std::int16_t, 3, 1> place_;
  bool hasInset_ = false;

public:
  /// Not where the value is negative, and not everywhere else, see `borderLattice`.
  bool isInside = true;
  /// By `takeOut`: the border shall keep away from it.
  bool isTakenOut = false;
  /// Whether inset and cut may come together here at an acute angle.
  bool mayBeChamfered = false;
};

/// What the region is like at a corner.
struct CornerSamples {
  /// The walls and the quadric; empty: they do not matter.
  std::optional<Sample> inset, cut;
  /// What cuts the edge between them off, where they come together at an acute angle.
  std::optional<Sample> chamfer;

  /// Of the region, about a signed distance; large where all are empty.
  double value() const;
};

/// The cubes of one size that the border of the region passes through. In each the corners that
/// are inside are connected along its edges, and so are those that are not: the border cuts it in
/// one piece that has the shape of a disc.
struct BorderLattice {
  Vec3 origin = Vec3::Zero();
  double edge = 0.0;
  std::optional<LayeredQuadric> quadric = {}; ///< and its transition: the region's
  double transition = 0.0;
  std::deque<Corner> corners; ///< many: a vector that grows would hold them twice
  /// Corner i of a cube is the one at its place plus (i & 1, i >> 1 & 1, i >> 2).
  std::vector<std::array<int, 8>> cubes;
  /// Corners well inside that went out because the cubes are too large for what is there.
  std::size_t unresolved = 0;

  /// Numbers; −1: there is none.
  int cubeAt(const Place& place) const;
  int cornerAt(const Place& place) const;
  /// The numbers of those at a place, which are added if they are not there; a corner as inside.
  int addCube(const Place& place);
  int addCorner(const Place& place);

  Vec3 positionOf(int corner) const {
    return origin + edge * corners[static_cast<std::size_t>(corner)].place().cast<double>();
  }
  CornerSamples samplesAt(int corner) const;
  /// A bit for each corner of a cube that is inside.
  unsigned cornersInside(int cube) const;

private:
  Place placeOfCorner(int corner) const {
    return corners[static_cast<std::size_t>(corner)].place();
  }
  Place placeOfCube(int cube) const {
    return placeOfCorner(cubes[static_cast<std::size_t>(cube)][0]);
  }
  PlaceNumbers cubeNumbers_, cornerNumbers_;
};

/// Cubes of the given edge. Where inset and cut are nearer to each other than a share of it, and
/// wherever too little is inside for cubes of that size, something is taken out of the region;
/// never put into it. Throws std::invalid_argument where that is more than 32,000 cubes across.
BorderLattice borderLattice(const Region& region, double edge);

/// Takes the corners of the cubes around these points out of the region, too.
void takeOut(const std::vector<Vec3>& points, BorderLattice& lattice);

} // namespace massprops
