// Distances within a horizontal layer.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace massprops {

/// How far the nodes of a plane grid are from where a function vanishes that is linear along the
/// grid's edges. Lengths in edges.
class LayerDistance {
public:
  LayerDistance(int columns, int rows);

  /// `values`: of the function at the nodes, row by row.
  void measure(const std::vector<float>& values);

  /// Whether the function vanishes anywhere.
  bool hasBorder() const { return !segments_.empty(); }
  /// Of every node, signed as the function; ±`kFar` without a border.
  const std::vector<float>& distances() const { return distances_; }
  /// The way from a node to the nearest point of the border. \pre `hasBorder`()
  Eigen::Vector2f wayToBorder(int i, int j) const;

  static constexpr float kFar = 1e4F;

private:
  struct Segment {
    Eigen::Vector2f a, b;
  };
  void addSegments(const std::vector<float>& values, int i, int j);
  void take(int i, int j, int segment);
  Eigen::Vector2f nearestOf(const Segment& segment, const Eigen::Vector2f& p) const;

  int columns_, rows_;
  std::vector<Segment> segments_;
  std::vector<int> nearest_; ///< of the segments; −1: none is known yet
  std::vector<float> squared_, distances_;
};

} // namespace massprops
