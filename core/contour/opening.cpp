#include "core/contour/opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace massprops {
namespace {

constexpr double kTiny = 1e-12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Ways v with slope·v ≥ rise.
struct HalfSpace {
  Vec3 slope;
  double rise;
};

/// The shortest way into all of some half-spaces.
class ShortestWay {
public:
  static constexpr std::size_t kMost = 8;

  bool isFull() const { return count_ == kMost; }

  /// One more, that the shortest way into those before it does not lead into: so that the new one
  /// ends on its border, and on those of two others at most. It is the shortest of all ways onto
  /// such borders that lead into the others, too. Empty: there is none.
  std::optional<Vec3> add(const HalfSpace& a) {
    shortest_.reset();
    halfSpaces_[count_++] = a;
    consider(a.rise * a.slope);
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      considerBoth(a, halfSpaces_[i]);
      for (std::size_t k = 0; k < i; ++k) considerAll(a, halfSpaces_[i], halfSpaces_[k]);
    }
    return shortest_;
  }

private:
  void considerBoth(const HalfSpace& a, const HalfSpace& b) {
    const double c = a.slope.dot(b.slope);
    const double squaredSine = 1.0 - c * c;
    if (squaredSine < kTiny) return;
    consider(((a.rise - c * b.rise) * a.slope + (b.rise - c * a.rise) * b.slope) / squaredSine);
  }

  void considerAll(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vec3 bc = b.slope.cross(c.slope);
    const double volume = a.slope.dot(bc);
    if (std::abs(volume) < kTiny) return;
    consider((a.rise * bc + b.rise * c.slope.cross(a.slope) + c.rise * a.slope.cross(b.slope)) /
             volume);
  }

  void consider(const Vec3& way) {
    if (shortest_ && way.squaredNorm() >= shortest_->squaredNorm()) return;
    constexpr double kRoundedOff = 1e-9;
    for (std::size_t i = 0; i < count_; ++i) {
      const HalfSpace& h = halfSpaces_[i];
      if (h.slope.dot(way) < h.rise - kRoundedOff * std::abs(h.rise)) return;
    }
    shortest_ = way;
  }

  std::array<HalfSpace, kMost> halfSpaces_;
  std::size_t count_ = 0;
  std::optional<Vec3> shortest_;
};

constexpr int kSide = 4; // nodes along a block's

/// From a block's first node, in their distance.
Vec3 stepTo(std::size_t node) {
  const auto i = static_cast<int>(node);
  return Eigen::Vector3i(i % kSide, i / kSide % kSide, i / (kSide * kSide)).cast<double>();
}

std::int64_t numberOf(const Eigen::Array3i& block) {
  constexpr std::int64_t kAcross = std::int64_t{1} << 20; // more blocks than any grid has
  const Eigen::Array<std::int64_t, 3, 1> n = block.cast<std::int64_t>();
  return n.x() + kAcross * (n.y() + kAcross * n.z());
}

NodePlaces joined(const NodePlaces& a, const NodePlaces& b) {
  NodePlaces all;
  for (std::size_t i = 0; i < all.known.size(); ++i) {
    if (!a.known[i] && !b.known[i]) continue;
    const bool isFound = a.found[i] || b.found[i];
    all.add(i, isFound ? std::optional(a.found[i] ? a.of(i) : b.of(i)) : std::nullopt);
  }
  return all;
}

} // namespace

OpeningProbe::OpeningProbe(const TriangleTree& surface, const Opening& opening, double slack)
    : surface_(surface), opening_(opening), slack_(slack), inside_(surface),
      spacing_(0.5 * opening.reach), nodeReach_(0.5 * std::sqrt(3.0) * spacing_) {}

std::optional<Sample> OpeningProbe::at(const Vec3& x, const Sample& depth, double enough,
                                       double horizon) {
  const Sample surely{kInfinity, Vec3::UnitX()};
  if (depth.value >= opening_.fits || isSurely(x, enough)) return surely;
  constexpr double kNearly = 1.001;
  const double farthest = opening_.reach + horizon;
  std::optional<Vec3> place = placeNear(x, depth, farthest);
  const double nearer = place ? (*place - x).norm() : farthest;
  // No place is nearer than what depth misses, for it grows by no more than one moves.
  const bool isNearest = place && nearer <= kNearly * (opening_.fits - depth.value);
  if (!place || (enough > 0.0 && opening_.reach - nearer < enough && !isNearest)) {
    const Vec3 onSurface = x - depth.value * depth.slope;
    const double near = opening_.reach + std::max(std::min(horizon, opening_.reach), spacing_);
    const auto other = placeAround(x, onSurface, std::min(nearer, near));
    if (other) place = other;
  }
  if (!place) return {};
  known_ = place;
  const double away = (*place - x).norm();
  const double value = opening_.reach - away;
  if (value >= enough) return surely;
  return Sample{value, (*place - x) / std::max(away, kTiny)};
}

Sample OpeningProbe::depthAt(const Vec3& x, bool isInside) {
  // Only the very nearest face tells the side.
  const double exact = isInside ? opening_.fits * opening_.fits : kInfinity;
  const TriangleTree::Hit hit =
      surface_.nearest(x, kInfinity, nearestFace_, exact, isInside ? slack_ : 0.0);
  nearestFace_ = hit.face;
  const double sign = isInside || inside_.contains(x, hit) ? 1.0 : -1.0;
  const TriangleTree::Hit clear = surface_.clearance(x, hit);
  const double distance = std::sqrt(clear.squaredDistance);
  return {sign * distance, sign * (x - clear.point) / std::max(distance, kTiny)};
}

std::optional<Vec3> OpeningProbe::placeNear(const Vec3& x, const Sample& depth, double farthest) {
  constexpr double kReached = 1e-6; // of the depth
  const double enough = (1.0 - kReached) * opening_.fits;
  ShortestWay shortest;
  Vec3 y = x;
  Sample here = depth;
  while (!shortest.isFull()) {
    const std::optional<Vec3> way =
        shortest.add({here.slope, opening_.fits - here.value + here.slope.dot(y - x)});
    if (!way || way->norm() > farthest) return {};
    y = x + *way;
    here = depthAt(y, way->norm() < depth.value);
    if (here.value >= enough) return y;
  }
  return {};
}

/// The nearest one next to a node, moved towards x as far as the ball fits.
std::optional<Vec3> OpeningProbe::placeAround(const Vec3& x, const Vec3& onSurface,
                                              double farthest) {
  const Vec3 fromOrigin = x - surface_.lower();
  const double side = kSide * spacing_;
  const double around = farthest + nodeReach_;
  const Eigen::Array3i first = ((fromOrigin.array() - around) / side).floor().cast<int>();
  const Eigen::Array3i last = ((fromOrigin.array() + around) / side).floor().cast<int>();
  std::optional<Vec3> nearest;
  Eigen::Array3i block;
  for (block.z() = first.z(); block.z() <= last.z(); ++block.z()) {
    for (block.y() = first.y(); block.y() <= last.y(); ++block.y()) {
      for (block.x() = first.x(); block.x() <= last.x(); ++block.x()) {
        const double least = nearest ? (*nearest - x).norm() : farthest;
        if (const auto place = placeInBlock(block, x, onSurface, least)) nearest = place;
      }
    }
  }
  if (!nearest) return {};
  constexpr int kHalvings = 6;
  Vec3 from = *nearest;
  Vec3 to = x;
  for (int i = 0; i < kHalvings; ++i) {
    const Vec3 middle = 0.5 * (from + to);
    const Sample depth = depthAt(middle, false);
    const double away = (from - x).norm();
    std::optional<Vec3> place = middle;
    // Between walls that the ball just fits places are as good as in one plane.
    if (depth.value < opening_.fits) place = placeNear(middle, depth, away);
    if (place && (*place - x).norm() < away) {
      from = *place;
    } else {
      to = middle;
    }
  }
  if ((from - x).norm() > farthest) return {};
  return from;
}

/// The nearest one nearer than `least`.
std::optional<Vec3> OpeningProbe::placeInBlock(const Eigen::Array3i& block, const Vec3& x,
                                               const Vec3& onSurface, double least) {
  const Vec3 low = surface_.lower() + kSide * spacing_ * block.matrix().cast<double>();
  const Vec3 high = low + Vec3::Constant((kSide - 1) * spacing_);
  const double tooNear = opening_.fits - nodeReach_; // for there to be a place next to a node
  double within = least + nodeReach_;                // else another place is nearer
  if ((x - x.cwiseMax(low).cwiseMin(high)).squaredNorm() > within * within) return {};
  const std::shared_ptr<const NodePlaces> known = opening_.known->find(numberOf(block));
  NodePlaces asked;
  std::optional<Vec3> nearest;
  for (std::size_t i = 0; i < asked.known.size(); ++i) {
    const Vec3 node = low + spacing_ * stepTo(i);
    if ((node - x).squaredNorm() > within * within) continue;
    if ((node - onSurface).squaredNorm() < tooNear * tooNear) continue;
    std::optional<Vec3> place;
    if (known && known->known[i]) {
      if (known->found[i]) place = known->of(i);
    } else {
      place = placeAtNode(node);
      asked.add(i, place);
    }
    if (!place || (*place - x).norm() >= least) continue;
    nearest = place;
    least = (*place - x).norm();
    within = least + nodeReach_;
  }
  if (asked.known.any()) opening_.known->add(numberOf(block), asked);
  return nearest;
}

/// Depends on the node alone, and leaves no trace in the probe: so it does not matter which probe
/// comes to it first.
std::optional<Vec3> OpeningProbe::placeAtNode(const Vec3& node) {
  const double tooNear = opening_.fits - nodeReach_; // for there to be a place next to it
  const double slack = std::exchange(slack_, 0.0);
  const int face = std::exchange(nearestFace_, -1);
  std::optional<Vec3> place;
  // On either side of the surface; which one it is takes longer.
  if (depthAt(node, true).value >= tooNear) {
    const Sample depth = depthAt(node, false);
    if (depth.value >= opening_.fits) {
      place = node;
    } else if (depth.value >= tooNear) {
      place = placeNear(node, depth, nodeReach_);
    }
  }
  slack_ = slack;
  nearestFace_ = face;
  return place;
}

std::shared_ptr<const NodePlaces> KnownPlaces::find(std::int64_t block) const {
  const Part& part = parts_[partOf(block)];
  const std::lock_guard lock(part.access);
  const auto found = part.blocks.find(block);
  return found == part.blocks.end() ? nullptr : found->second;
}

void KnownPlaces::add(std::int64_t block, const NodePlaces& places) {
  constexpr std::size_t kOfBlock = 5;
  Part& part = parts_[partOf(block)];
  const std::lock_guard lock(part.access);
  if (part.held >= kMost) { // those asked for next are near each other
    part.blocks.clear();
    part.held = 0;
  }
  std::shared_ptr<const NodePlaces>& known = part.blocks[block];
  const std::size_t before = known ? known->places.size() : 0;
  if (!known) part.held += kOfBlock;
  known = std::make_shared<NodePlaces>(known ? joined(*known, places) : places);
  part.held += known->places.size() - before;
}

std::size_t KnownPlaces::partOf(std::int64_t block) {
  return static_cast<std::size_t>(block ^ block >> 20 ^ block >> 40) % kParts;
}

} // namespace massprops
