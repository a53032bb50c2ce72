// A hierarchy of boxes around the triangles of a mesh, and what is found with it.
#pragma once

#include "core/base/types.h"
#include "core/query/spatial_order.h"
#include "core/query/triangle_packet.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace massprops {

/// Some complete trees over runs of up to four triangles. Refers to the arrays it was made from.
class TriangleTree {
public:
  enum class Order {
    Any,     ///< the faces come in any order
    Spatial, ///< they come in the order of `spatialOrder`, or nearly so
  };
  enum class Queries {
    All,
    NoDistances, ///< made sooner; `nearest` and the distance of a triangle must not be called
  };
  TriangleTree(const Points& vertices, const Faces& faces, Order order = Order::Any,
               Queries queries = Queries::All);

  /// \param order of the faces, that of `spatialOrder` or nearly so
  TriangleTree(const Points& vertices, const Faces& faces, std::vector<int> order, Queries queries);

  const Points& vertices() const { return vertices_; }
  const Faces& faces() const { return faces_; }
  /// Corners of a box around the triangles.
  Vec3 lower() const { return box_.lower.matrix().cast<double>() + centre_ - roundedOff(); }
  Vec3 upper() const { return box_.upper.matrix().cast<double>() + centre_ + roundedOff(); }

  struct Hit {
    double squaredDistance = std::numeric_limits<double>::infinity();
    int face = -1; ///< −1: nothing within the bound
    Vec3 point = Vec3::Zero();
  };
  /// The point of the surface next to `p`, if it is nearer than the bound; quicker with a face that
  /// is known to be near. Looking for the nearest of many that are about as far away is slow: what
  /// is found may be farther away than that by `slack`, a share, and what is not within
  /// `squaredExact` by 5 %, as from the middle of a limb.
  Hit nearest(const Vec3& p, double squaredBound = std::numeric_limits<double>::infinity(),
              int hintFace = -1, double squaredExact = std::numeric_limits<double>::infinity(),
              double slack = 0.0) const;
  static constexpr double kSlack = 1.05;
  /// For where a point about as far away will do: 0.002 for surfaces of more than 500,000
  /// triangles; else 0, for there is little to gain, and edges between walls stay exact.
  double slightSlack() const;

  /// The point of one face next to `p`.
  Hit nearestOn(int face, const Vec3& p) const;

  /// From then on clearances are those from all within `radius` of these other triangles, too,
  /// which must outlive the tree. Distances stay those from the surface.
  void keepOut(const TriangleTree& triangles, double radius);
  bool keepsOut() const { return keptOut_ != nullptr; }

  /// What is nearest to `p` of the surface, which is what `nearest` found with any bound, and of
  /// what is kept out, whose points are 1e-12 away from themselves. The face is that of `nearest`.
  Hit clearance(const Vec3& p, const Hit& nearest) const;
  /// The same as `nearest`, of both.
  Hit clearance(const Vec3& p,
                double squaredBound = std::numeric_limits<double>::infinity()) const {
    return clearance(p, nearest(p, squaredBound));
  }
  /// As the squared distance of a triangle, of both; 0 only where it crosses the surface.
  /// `earlier`: null, or a place where it was, which tells how far away what it left behind is.
  double squaredClearance(const Vec3& a, const Vec3& b, const Vec3& c, double squaredBound,
                          const EarlierTriangle* earlier = nullptr) const;

  /// Squared distance, to a billionth, of the triangle (a, b, c) from the surface if below
  /// `squaredBound`, else that; 0 where they cross. `earlier`: as above.
  double squaredDistance(const Vec3& a, const Vec3& b, const Vec3& c, double squaredBound,
                         const EarlierTriangle* earlier = nullptr) const;

  /// Length along the unit `direction` to the first triangle that does not have `start` as a
  /// corner, infinity where there is none. A triangle counts as a billionth of its size larger, so
  /// that no ray slips between two. `limit`: what is farther is not looked for.
  double firstHit(const Vec3& start, const Vec3& direction,
                  double limit = std::numeric_limits<double>::infinity()) const;

  /// Calls visit(i) for the places i ≥ `from` of all triangles whose boxes meet the box, and of
  /// some of their neighbours.
  template <class Visit>
  void forOverlaps(const Vec3& lower, const Vec3& upper, Eigen::Index from,
                   const Visit& visit) const;

  /// Places 0…m−1 run along the tree.
  int faceAt(Eigen::Index place) const {
    return order_.empty() ? static_cast<int>(place) : order_[static_cast<std::size_t>(place)];
  }

private:
  /// Around some triangles, or around what is looked for.
  struct Box {
    Eigen::Array3f lower, upper;
  };

  void makeBoxes(Queries queries);
  Box around(const Vec3& lower, const Vec3& upper) const;
  Box boxOf(Eigen::Index begin, Eigen::Index end) const;
  TrianglePacket trianglesOf(Eigen::Index leaf) const;
  /// Of the boxes around few triangles: what is larger is too curved to be thin.
  void makePlanes();
  PlanePacket planesOf(Eigen::Index firstLeaf, Eigen::Index leaves) const;
  const PlanePacket* planesAt(Eigen::Index node) const {
    return node < firstPlanes_ ? nullptr : &planes_[static_cast<std::size_t>(node - firstPlanes_)];
  }
  const BoxPacket& boxesAt(Eigen::Index node) const {
    return boxes_[static_cast<std::size_t>(node)];
  }
  /// Nodes that are no leaves; these follow them.
  Eigen::Index innerNodes() const { return static_cast<Eigen::Index>(boxes_.size()); }
  Eigen::Index childOf(Eigen::Index node, int k) const { return roots_ + 4 * node + k; }
  /// Calls visit(leaf) for the leaves in boxes of which `distances`(node), of its four boxes, are
  /// below `reach`(), of four the nearest one first; a visit may bring the reach down.
  template <class Distances, class Reach, class Visit>
  void visitNearest(const Distances& distances, const Reach& reach, const Visit& visit) const;
  /// The same in any order.
  template <class Distances, class Reach, class Visit>
  void visitWithin(const Distances& distances, const Reach& reach, const Visit& visit) const;
  Eigen::Index firstPlace(Eigen::Index leaf) const { return leaf * faces_.rows() / leaves_; }
  /// Not more than the squared distances of the boxes from `other`.
  Lanes squaredGaps(const BoxPacket& boxes, const Box& other) const;
  Vec3 corner(int face, int k) const { return vertices_.row(faces_(face, k)).transpose(); }

  /// What a sum with the centre may lose.
  Vec3 roundedOff() const { return std::numeric_limits<double>::epsilon() * centre_.cwiseAbs(); }

  const Points& vertices_;
  const Faces& faces_;
  std::vector<int> order_;     ///< empty: as given
  Vec3 centre_ = Vec3::Zero(); ///< that boxes and packets are relative to
  Eigen::Index leaves_ = 1;    ///< roots · 4^k
  /// Walks begin at nodes 0 … roots − 1; the children of node i are roots + 4i … roots + 4i + 3.
  /// Entry i holds their boxes.
  int roots_ = 1;
  std::vector<BoxPacket> boxes_;
  std::vector<PlanePacket> planes_;       ///< of the lowest nodes that have boxes
  Eigen::Index firstPlanes_ = 0;          ///< the first of these nodes
  std::vector<TrianglePacket> triangles_; ///< of the leaves
  const TriangleTree* keptOut_ = nullptr; ///< not this alone, but all within a radius of it
  double keptOutRadius_ = 0.0;
  Box box_; ///< around all
  /// More than the boxes lose as floats; what far points lose is a share of the gap, as are the
  /// roundings of its square.
  float rounding_ = 0.0F;
};

/// Length of the chord from row i of `points` along row i of `directions` (unit) to the first
/// triangle that does not contain the start, infinity where there is none. n entries.
Vector chords(const TriangleTree& surface, const Points& points, const Points& directions);

template <class Visit>
void TriangleTree::forOverlaps(const Vec3& lower, const Vec3& upper, Eigen::Index from,
                               const Visit& visit) const {
  const Box box = around(lower, upper);
  // Nodes with the leaves below them.
  struct Range {
    Eigen::Index node, firstLeaf, leaves;
  };
  Range stack[64];
  int size = 0;
  for (int root = roots_ - 1; root >= 0; --root) {
    stack[size++] = {root, root * leaves_ / roots_, leaves_ / roots_};
  }
  while (size > 0) {
    const Range e = stack[--size];
    if (e.node >= innerNodes()) {
      const Eigen::Index end = firstPlace(e.firstLeaf + 1);
      for (Eigen::Index i = std::max(from, firstPlace(e.firstLeaf)); i < end; ++i) visit(i);
      continue;
    }
    const BoxPacket& boxes = boxesAt(e.node);
    Lanes gap = Lanes::Constant(-std::numeric_limits<float>::infinity());
    for (int k = 0; k < 3; ++k) {
      gap = gap.max(boxes.lower[k] - box.upper[k]).max(box.lower[k] - boxes.upper[k]);
    }
    const Eigen::Index quarter = e.leaves / 4;
    for (int k = 3; k >= 0; --k) {
      const Eigen::Index firstLeaf = e.firstLeaf + k * quarter;
      if (gap[k] > 0.0F || firstPlace(firstLeaf + quarter) <= from) continue;
      stack[size++] = {childOf(e.node, k), firstLeaf, quarter};
    }
  }
}

} // namespace massprops
