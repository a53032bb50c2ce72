#include "core/overhang/layer_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace massprops {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

} // namespace

LayerDistance::LayerDistance(int columns, int rows)
    : columns_(columns), rows_(rows), nearest_(at(columns * rows)), squared_(at(columns * rows)),
      distances_(at(columns * rows)) {}

Eigen::Vector2f LayerDistance::nearestOf(const Segment& segment, const Eigen::Vector2f& p) const {
  const Eigen::Vector2f along = segment.b - segment.a;
  const float squared = along.squaredNorm();
  const float share =
      squared > 0.0F ? std::clamp((p - segment.a).dot(along) / squared, 0.0F, 1.0F) : 0.0F;
  return segment.a + share * along;
}

void LayerDistance::take(int i, int j, int segment) {
  const Eigen::Vector2f p(static_cast<float>(i), static_cast<float>(j));
  const float squared = (nearestOf(segments_[at(segment)], p) - p).squaredNorm();
  const std::size_t node = at(i + columns_ * j);
  if (squared >= squared_[node]) return;
  squared_[node] = squared;
  nearest_[node] = segment;
}

void LayerDistance::addSegments(const std::vector<float>& values, int i, int j) {
  // Corners and sides around the square, side k from corner k on.
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::array<float, 4> value{};
  int inside = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value[k] = values[at(i + kCorners[k][0] + columns_ * (j + kCorners[k][1]))];
    if (value[k] > 0.0F) ++inside;
  }
  if (inside == 0 || inside == 4) return;
  std::array<Eigen::Vector2f, 4> crossing;
  std::array<std::size_t, 4> sides{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if ((value[k] > 0.0F) == (value[next] > 0.0F)) continue;
    const float share = value[k] / (value[k] - value[next]);
    const Eigen::Vector2f from(static_cast<float>(i + kCorners[k][0]),
                               static_cast<float>(j + kCorners[k][1]));
    const Eigen::Vector2f to(static_cast<float>(i + kCorners[next][0]),
                             static_cast<float>(j + kCorners[next][1]));
    crossing[k] = from + share * (to - from);
    sides[count++] = k;
  }
  const auto add = [&](std::size_t from, std::size_t to) {
    const int segment = static_cast<int>(segments_.size());
    segments_.push_back({crossing[from], crossing[to]});
    for (const auto& corner : kCorners) take(i + corner[0], j + corner[1], segment);
  };
  if (count == 2) {
    add(sides[0], sides[1]);
    return;
  }
  // Two corners inside, opposite each other: joined where the middle is inside.
  const bool isJoined = value[0] + value[1] + value[2] + value[3] > 0.0F;
  const bool isFirstInside = value[0] > 0.0F;
  if (isJoined == isFirstInside) {
    add(0, 1);
    add(2, 3);
  } else {
    add(3, 0);
    add(1, 2);
  }
}

void LayerDistance::measure(const std::vector<float>& values) {
  segments_.clear();
  std::fill(nearest_.begin(), nearest_.end(), -1);
  std::fill(squared_.begin(), squared_.end(), std::numeric_limits<float>::infinity());
  for (int j = 0; j + 1 < rows_; ++j) {
    for (int i = 0; i + 1 < columns_; ++i) addSegments(values, i, j);
  }
  // Every node learns of its neighbours' nearest segments, in two sweeps. [Dan80]
  const auto learn = [&](int i, int j, int di, int dj) {
    const int x = i + di;
    const int y = j + dj;
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return;
    const int segment = nearest_[at(x + columns_ * y)];
    if (segment >= 0 && segment != nearest_[at(i + columns_ * j)]) take(i, j, segment);
  };
  for (const int up : {1, -1}) {
    const int first = up > 0 ? 0 : rows_ - 1;
    for (int j = first; j >= 0 && j < rows_ && hasBorder(); j += up) {
      for (int i = 0; i < columns_; ++i) {
        for (const int di : {-1, 0, 1}) learn(i, j, di, -up);
        learn(i, j, -1, 0);
      }
      for (int i = columns_ - 1; i >= 0; --i) learn(i, j, 1, 0);
    }
  }
  for (std::size_t node = 0; node < distances_.size(); ++node) {
    const float distance = hasBorder() ? std::sqrt(squared_[node]) : kFar;
    distances_[node] = values[node] > 0.0F ? distance : -distance;
  }
}

Eigen::Vector2f LayerDistance::wayToBorder(int i, int j) const {
  const Eigen::Vector2f p(static_cast<float>(i), static_cast<float>(j));
  return nearestOf(segments_[at(nearest_[at(i + columns_ * j)])], p) - p;
}

} // namespace massprops
