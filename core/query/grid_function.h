// A function that is known at the nodes of a grid.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// A function near a point, positive inside, its slope a unit vector: about a signed distance.
struct Sample {
  double value;
  Vec3 slope;
};

/// Nodes of cubes that may be turned: node (i, j, k) lies at `origin` + `edge`·(i, j, k) in
/// coordinates x' = `rotation`·x.
struct Grid {
  Mat3 rotation = Mat3::Identity();
  Vec3 origin = Vec3::Zero(); ///< turned coordinates
  double edge = 0.0;
  Eigen::Array3i counts = Eigen::Array3i::Zero();

  Eigen::Index nodes() const { return counts.cast<Eigen::Index>().prod(); }
  Eigen::Index nodeAt(int i, int j, int k) const {
    return i + Eigen::Index(counts.x()) * (j + Eigen::Index(counts.y()) * k);
  }
  Vec3 positionOf(int i, int j, int k) const {
    return rotation.transpose() * (origin + edge * Vec3(i, j, k));
  }
};

/// Linear along each edge of the cubes.
struct GridFunction {
  Grid grid;
  std::vector<float>
      values; ///< at the nodes, in edges; grows by about 1 an edge where it is near 0

  /// In lengths, where the grid ends what it is there.
  Sample at(const Vec3& x) const;
};

} // namespace massprops
