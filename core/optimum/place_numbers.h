// Finds what is at a place by its number.
#pragma once

#include "core/base/types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace massprops {

/// Integer coordinates of a corner of cubes.
using Place = Eigen::Vector3i;

/// From a cube's lowest corner to its corner i = 0 … 7.
inline Place cornerStep(int i) {
  return {i & 1, i >> 1 & 1, i >> 2};
}

/// An open-addressing hash table of 8 bytes an entry: those whose places are asked for keep these
/// themselves, and a map of the standard library takes 50.
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
  static std::size_t hash(const Place& place) {
    const auto part = [](int i) { return std::uint64_t{static_cast<unsigned>(i)}; };
    // MurmurHash3's finalizer, whose last digits depend on all.
    std::uint64_t hash = part(place.x()) << 42 ^ part(place.y()) << 21 ^ part(place.z());
    hash ^= hash >> 33;
    hash *= 0xff51afd7ed558ccdULL;
    hash ^= hash >> 33;
    hash *= 0xc4ceb9fe1a85ec53ULL;
    return static_cast<std::size_t>(hash ^ hash >> 33);
  }
  void put(const Place& place, int number) {
    std::size_t slot = hash(place) & (slots_.size() - 1);
    while (slots_[slot] >= 0) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = number;
  }

  std::vector<int> slots_; ///< a power of two, a third of them free; −1: free
  int count_ = 0;
};

} // namespace massprops
