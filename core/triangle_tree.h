// A hierarchy of boxes around the triangles of a mesh, and what is found with it.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace massprops {

/// The triangles' numbers in an order in which halves, quarters … of the list are halves, quarters
/// … in space: cut at the median along the longest side of the box around their centres.
std::vector<int> spatialOrder(const Points& vertices, const Faces& faces);

/// A complete binary tree over runs of two to four triangles. Refers to the arrays it was made
/// from.
class TriangleTree {
public:
  enum class Order {
    Any,     ///< the faces come in any order
    Spatial, ///< they come in the order of `spatialOrder`, or nearly so
  };
  TriangleTree(const Points& vertices, const Faces& faces, Order order = Order::Any);

  const Points& vertices() const { return vertices_; }
  const Faces& faces() const { return faces_; }
  /// Corners of a box around the triangles.
  Vec3 lower() const { return boxes_[1].lower.head<3>().cast<double>(); }
  Vec3 upper() const { return boxes_[1].upper.head<3>().cast<double>(); }

  struct Hit {
    double squaredDistance = std::numeric_limits<double>::infinity();
    int face = -1; ///< −1: nothing within the bound
    Vec3 point = Vec3::Zero();
  };
  /// The point of the surface next to `p`, if it is nearer than the bound; quicker with a face that
  /// is known to be near. What is not within `squaredExact` may be farther than the nearest point
  /// by 5 %: from the middle of a limb all of it is equally far, and looking for the nearest is
  /// slow.
  Hit nearest(const Vec3& p, double squaredBound = std::numeric_limits<double>::infinity(),
              int hintFace = -1,
              double squaredExact = std::numeric_limits<double>::infinity()) const;
  static constexpr double kSlack = 1.05;

  /// Squared distance of a point from one face.
  double squaredDistance(const Vec3& p, int face) const;

  /// Squared distance of the triangle (a, b, c) from the surface if below `squaredBound`, else
  /// that; 0 where they cross.
  double squaredDistance(const Vec3& a, const Vec3& b, const Vec3& c, double squaredBound) const;

  /// Length along the unit `direction` to the first triangle that does not have `start` as a
  /// corner, infinity where there is none. A triangle counts as 1e-9 of its size larger, so that
  /// no ray slips between two.
  /// `limit`: what is farther is not looked for.
  double firstHit(const Vec3& start, const Vec3& direction,
                  double limit = std::numeric_limits<double>::infinity()) const;

  /// Calls visit(i) for the places i ≥ `from` of all triangles whose boxes meet the box.
  template <class Visit>
  void forOverlaps(const Vec3& lower, const Vec3& upper, Eigen::Index from,
                   const Visit& visit) const;

  /// Places 0…m−1 run along the tree.
  int faceAt(Eigen::Index place) const {
    return order_.empty() ? static_cast<int>(place) : order_[static_cast<std::size_t>(place)];
  }

private:
  /// Four floats each, the last one 0: a distance takes one instruction a step.
  struct Box {
    Eigen::Array4f lower, upper;
  };
  /// Calls visit(face) for the triangles in boxes of which `distance`(node) is below `reach`(), the
  /// nearer ones first; a visit may bring the reach down.
  template <class Distance, class Reach, class Visit>
  void visitNearest(const Distance& distance, const Reach& reach, const Visit& visit) const;
  Eigen::Index firstPlace(Eigen::Index leaf) const { return leaf * faces_.rows() / leaves_; }
  /// Not more than the squared distance of a node's box from the box lower…upper.
  double squaredGap(Eigen::Index node, const Eigen::Array4f& lower,
                    const Eigen::Array4f& upper) const {
    const Box& box = boxes_[static_cast<std::size_t>(node)];
    const Eigen::Array4f outside = (box.lower - upper).max(lower - box.upper) - rounding_;
    // What floats cannot tell counts as no gap.
    const float sum = Eigen::Array4f::Zero().max(outside).square().sum();
    if (!(sum >= std::numeric_limits<float>::min())) return 0.0;
    return kBelowRounding * static_cast<double>(std::min(sum, std::numeric_limits<float>::max()));
  }
  Box boxOf(Eigen::Index begin, Eigen::Index end) const;
  Vec3 corner(int face, int k) const { return vertices_.row(faces_(face, k)).transpose(); }

  const Points& vertices_;
  const Faces& faces_;
  std::vector<int> order_;  ///< empty: as given
  Eigen::Index leaves_ = 1; ///< a power of two
  std::vector<Box> boxes_;  ///< children of i: 2i, 2i + 1; the root is 1
  /// More than the boxes lose as floats; what far points lose is a share of the gap, as are the
  /// roundings of its square.
  float rounding_ = 0.0F;
  static constexpr double kBelowRounding = 1.0 - 1e-6;
};

/// The point of the triangle (a, b, c) next to p, by its weights at the corners. [Eri05,
/// Sec. 5.1.5]
Vec3 nearestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

template <class Visit>
void TriangleTree::forOverlaps(const Vec3& lower, const Vec3& upper, Eigen::Index from,
                               const Visit& visit) const {
  const auto meets = [&](const Box& box) {
    return lower.x() <= box.upper[0] && upper.x() >= box.lower[0] && lower.y() <= box.upper[1] &&
           upper.y() >= box.lower[1] && lower.z() <= box.upper[2] && upper.z() >= box.lower[2];
  };
  // Nodes with the number of leaves below them.
  struct Entry {
    Eigen::Index node, firstLeaf, leaves;
  };
  Entry stack[64];
  int size = 0;
  stack[size++] = {1, 0, leaves_};
  while (size > 0) {
    const Entry e = stack[--size];
    if (firstPlace(e.firstLeaf + e.leaves) <= from) continue;
    if (!meets(boxes_[static_cast<std::size_t>(e.node)])) continue;
    if (e.leaves > 1) {
      const Eigen::Index half = e.leaves / 2;
      stack[size++] = {2 * e.node + 1, e.firstLeaf + half, half};
      stack[size++] = {2 * e.node, e.firstLeaf, half};
      continue;
    }
    const Eigen::Index end = firstPlace(e.firstLeaf + 1);
    for (Eigen::Index i = std::max(from, firstPlace(e.firstLeaf)); i < end; ++i) visit(i);
  }
}

} // namespace massprops
