#include "core/query/self_intersection.h"

#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"
#include "core/query/embedded_fans.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Triangles that are looked at together.
constexpr Eigen::Index kBlock = 32;
/// Around a block, in edges: neighbours whose boxes meet those of the block belong to its patch,
/// too, and need not be compared. Without it an inspection takes half as much time again.
constexpr double kMargin = 0.25;
/// Each has an array over all faces, so that there are to be few.
constexpr Eigen::Index kMostChunks = 16;

/// Of the faces from a place on, each once, ascending.
void leaveOne(std::size_t from, std::vector<int>& faces) {
  const auto begin = faces.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(begin, faces.end());
  faces.erase(std::unique(begin, faces.end()), faces.end());
}

/// Looks for crossings of one surface with itself.
class SelfIntersections {
public:
  /// \param similar null, or what the tree's surface is to this one
  SelfIntersections(const Points& vertices, const Faces& faces, const TriangleTree& tree,
                    const SimilarSurface* similar)
      : x_(vertices), faces_(faces), tree_(tree), similar_(similar),
        opposite_(oppositeHalfEdges(x_.rows(), faces_)),
        isEmbedded_(embeddedFans(x_, faces_, opposite_)),
        size_((x_.colwise().maxCoeff() - x_.colwise().minCoeff()).maxCoeff()) {}

  std::vector<int> find() const {
    const Eigen::Index blocks = chunkCount(faces_.rows(), kBlock);
    const Eigen::Index length = std::max<Eigen::Index>(16, chunkCount(blocks, kMostChunks));
    std::vector<std::vector<int>> found(static_cast<std::size_t>(chunkCount(blocks, length)));
    forChunks(blocks, length, [&](const Chunk& chunk) {
      Patches patches;
      patches.of.assign(static_cast<std::size_t>(faces_.rows()), 0);
      for (Eigen::Index b = chunk.begin; b < chunk.end; ++b) {
        searchBlock(b, patches, found[static_cast<std::size_t>(chunk.number)]);
      }
    });
    std::vector<int> all;
    for (const std::vector<int>& part : found) all.insert(all.end(), part.begin(), part.end());
    leaveOne(0, all);
    return all;
  }

private:
  /// For every face the number of the patch around the present block that it belongs to; numbers
  /// of former blocks are smaller than `first`.
  struct Patches {
    std::vector<std::uint16_t> of;
    std::uint16_t first = 1;
    std::uint16_t next = 1;
    std::vector<int> queue, doubtful;

    void beginBlock() {
      if (next > std::numeric_limits<std::uint16_t>::max() - kBlock) {
        std::fill(of.begin(), of.end(), std::uint16_t{0});
        next = 1;
      }
      first = next;
    }
  };

  int faceAt(Eigen::Index place) const {
    const int f = tree_.faceAt(place);
    return similar_ == nullptr ? f : similar_->faceOf[at(f)];
  }

  static std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }
  Vec3 point(int v) const { return x_.row(v).transpose(); }

  using Box = Eigen::AlignedBox3d;

  Box boxOf(int f) const {
    Box box;
    for (const int v : faces_.row(f)) box.extend(point(v));
    return box;
  }

  /// A rectangle across `axis`, a little larger and a little smaller than it is.
  struct Window {
    Vec3 axis, u, w;
    Vec3 origin; ///< near the rectangle: coordinates far from it have few digits to spare
    Vec2 lower, upper;
    double slack;

    Vec2 project(const Vec3& p) const { return {u.dot(p - origin), w.dot(p - origin)}; }
    bool contains(const Vec2& p) const {
      return p.x() > lower.x() + slack && p.x() < upper.x() - slack && p.y() > lower.y() + slack &&
             p.y() < upper.y() - slack;
    }
    bool mayMeet(const Vec2& p, const Vec2& q) const {
      return std::max(p.x(), q.x()) > lower.x() - slack &&
             std::min(p.x(), q.x()) < upper.x() + slack &&
             std::max(p.y(), q.y()) > lower.y() - slack &&
             std::min(p.y(), q.y()) < upper.y() + slack;
    }
  };

  /// A face's corners in the window's plane.
  using Shadow = std::array<Vec2, 3>;
  Shadow shadowOf(int f, const Window& window) const {
    return {window.project(point(faces_(f, 0))), window.project(point(faces_(f, 1))),
            window.project(point(faces_(f, 2)))};
  }

  /// Whether the face faces the axis and its corners in the cylinder have embedded fans.
  bool isGraph(int f, const Shadow& shadow, const Window& window) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const bool mayBeIn = window.mayMeet(shadow[k], shadow[k]);
      if (mayBeIn && isEmbedded_[at(faces_(f, static_cast<int>(k)))] == 0) return false;
    }
    return facesTowards(faceNormal(x_, faces_, f), window.axis);
  }

  /// The faces that are connected within the cylinder over the window with face `seed`, if all of
  /// them face its axis and their vertices have embedded fans: then the projection of what is in
  /// the cylinder is a covering of the window, hence one-to-one. They get the number
  /// `patches.next`.
  bool growPatch(int seed, const Window& window, Patches& patches) const {
    patches.queue.assign(1, seed);
    patches.doubtful.clear();
    patches.of[at(seed)] = patches.next;
    bool isPatch = growSurely(window, patches);
    const std::size_t sure = patches.queue.size();
    // Faces that may be connected, too, must face the axis but count as strangers.
    isPatch = isPatch && growPerhaps(window, patches);
    for (std::size_t i = isPatch ? sure : 0; i < patches.queue.size(); ++i) {
      patches.of[at(patches.queue[i])] = 0;
    }
    return isPatch;
  }

  /// Lengthens the queue by the faces that are reached within the cylinder; those of which rounding
  /// hides it become doubtful. Returns whether all may form a patch.
  bool growSurely(const Window& window, Patches& patches) const {
    for (std::size_t i = 0; i < patches.queue.size(); ++i) {
      const int f = patches.queue[i];
      const Shadow p = shadowOf(f, window);
      if (!isGraph(f, p, window)) return false;
      const bool in[3] = {window.contains(p[0]), window.contains(p[1]), window.contains(p[2])};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = (k + 1) % 3;
        if (!window.mayMeet(p[k], p[n])) continue;
        const int across = opposite_[3 * at(f) + k];
        if (across < 0) return false;
        if (patches.of[at(across / 3)] == patches.next) continue;
        if (in[k] || in[n]) {
          patches.of[at(across / 3)] = patches.next;
          patches.queue.push_back(across / 3);
        } else {
          patches.doubtful.push_back(across / 3);
        }
      }
    }
    return true;
  }

  /// The same for what the doubtful faces lead to.
  bool growPerhaps(const Window& window, Patches& patches) const {
    for (std::size_t i = 0; i < patches.doubtful.size(); ++i) {
      const int f = patches.doubtful[i];
      if (patches.of[at(f)] == patches.next) continue;
      patches.of[at(f)] = patches.next;
      patches.queue.push_back(f);
      const Shadow p = shadowOf(f, window);
      if (!isGraph(f, p, window)) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!window.mayMeet(p[k], p[(k + 1) % 3])) continue;
        const int across = opposite_[3 * at(f) + k];
        if (across < 0) return false;
        if (patches.of[at(across / 3)] != patches.next) patches.doubtful.push_back(across / 3);
      }
    }
    return true;
  }

  /// Triangles at the places begin … end − 1 of the tree.
  struct Block {
    Eigen::Index begin, end;
    Box boxes[kBlock];
    Box all;
    Vec3 axis = Vec3::Zero(); ///< sum of the unit normals
    double edge = 0.0;        ///< mean length
  };

  Block blockAt(Eigen::Index number) const {
    Block block;
    block.begin = number * kBlock;
    block.end = std::min(faces_.rows(), block.begin + kBlock);
    for (Eigen::Index i = block.begin; i < block.end; ++i) {
      const int f = faceAt(i);
      const FaceNormal n = faceNormal(x_, faces_, f);
      const double length = n.vector.norm();
      if (length > 0.0) block.axis += n.vector / length;
      block.edge += std::sqrt(n.length);
      block.boxes[i - block.begin] = boxOf(f);
      block.all.extend(block.boxes[i - block.begin]);
    }
    block.edge /= static_cast<double>(block.end - block.begin);
    return block;
  }

  /// What may cross the block has a box in the tree that meets this one.
  Box boxInTree(const Block& block) const {
    if (similar_ == nullptr) return block.all;
    Box box;
    for (Eigen::Index i = block.begin; i < block.end; ++i) {
      for (const int v : tree_.faces().row(tree_.faceAt(i)))
        box.extend(Vec3(tree_.vertices().row(v).transpose()));
    }
    const Vec3 apart = Vec3::Constant(similar_->apart);
    return {box.min() - apart, box.max() + apart};
  }

  Window windowOver(const Block& block) const {
    Window window;
    window.axis = block.axis.normalized();
    window.u = window.axis.unitOrthogonal();
    window.w = window.axis.cross(window.u);
    window.origin = block.all.min();
    window.lower.setConstant(kInfinity);
    window.upper = -window.lower;
    for (Eigen::Index i = block.begin; i < block.end; ++i) {
      for (const Vec2& p : shadowOf(faceAt(i), window)) {
        window.lower = window.lower.cwiseMin(p);
        window.upper = window.upper.cwiseMax(p);
      }
    }
    window.slack = kSafe * (size_ + block.edge);
    window.lower.array() -= kMargin * block.edge;
    window.upper.array() += kMargin * block.edge;
    return window;
  }

  void searchBlock(Eigen::Index number, Patches& patches, std::vector<int>& found) const {
    const Block block = blockAt(number);
    patches.beginBlock();
    if (block.axis.norm() > 0.0) {
      const Window window = windowOver(block);
      for (Eigen::Index i = block.begin; i < block.end; ++i) {
        const int f = faceAt(i);
        if (patches.of[at(f)] >= patches.first) continue;
        if (!growPatch(f, window, patches)) break;
        ++patches.next;
      }
    }
    const std::size_t before = found.size();
    comparePairs(block, patches, found);
    leaveOne(before, found); // in a soup every face crosses many
  }

  /// Pairs that no patch has in common. Most often one patch has the whole block.
  void comparePairs(const Block& block, const Patches& patches, std::vector<int>& found) const {
    const std::uint16_t common = patches.of[at(faceAt(block.begin))];
    bool isOnePatch = common >= patches.first;
    std::uint16_t patchOf[kBlock];
    for (Eigen::Index i = block.begin; i < block.end; ++i) {
      patchOf[i - block.begin] = patches.of[at(faceAt(i))];
      isOnePatch = isOnePatch && patchOf[i - block.begin] == common;
    }
    const Box around = boxInTree(block);
    tree_.forOverlaps(around.min(), around.max(), block.begin, [&](Eigen::Index i) {
      const int f = faceAt(i);
      const std::uint16_t patch = patches.of[at(f)];
      const bool isKnown = patch >= patches.first;
      if (isOnePatch && patch == common) return;
      const Box box = boxOf(f);
      if (!box.intersects(block.all)) return;
      for (Eigen::Index j = 0; j < std::min(block.end, i) - block.begin; ++j) {
        if (!box.intersects(block.boxes[j]) || (isKnown && patchOf[j] == patch)) continue;
        const int g = faceAt(block.begin + j);
        if (cross(f, g)) {
          found.push_back(f);
          found.push_back(g);
        }
      }
    });
  }

  Kernel::Point_3 exact(int v) const { return {x_(v, 0), x_(v, 1), x_(v, 2)}; }

  /// Whether a plane near one of the triangles has them on different sides.
  bool areApart(int f, int g) const {
    for (int turn = 0; turn < 2; ++turn) {
      const int one = turn == 0 ? f : g;
      const int two = turn == 0 ? g : f;
      const FaceNormal n = faceNormal(x_, faces_, one);
      const Vec3 a = point(faces_(one, 0));
      double least = kInfinity;
      double most = -least;
      double scale = 0.0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 d = point(faces_(two, k)) - a;
        const double side = n.vector.dot(d);
        least = std::min(least, side);
        most = std::max(most, side);
        scale = std::max(scale, d.norm());
      }
      const double doubt = kSafe * n.length * scale;
      if (least > doubt || most < -doubt) return true;
    }
    return false;
  }

  /// As CGAL's `self_intersections` decides it.
  bool cross(int f, int g) const {
    int sharedF[3];
    int sharedG[3];
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (faces_(f, i) != faces_(g, j)) continue;
        if (isEmbedded_[at(faces_(f, i))] != 0) return false;
        sharedF[shared] = i;
        sharedG[shared] = j;
        if (++shared == 3) return true;
      }
    }
    const auto triangle = [&](int face) {
      return Kernel::Triangle_3(exact(faces_(face, 0)), exact(faces_(face, 1)),
                                exact(faces_(face, 2)));
    };
    if (shared == 0 && areApart(f, g)) return false;
    // The predicates do not take faces without area, which `facesWithoutArea` finds.
    if (triangle(f).is_degenerate() || triangle(g).is_degenerate()) return false;
    if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
    if (shared == 1) {
      const int i = sharedF[0];
      const int j = sharedG[0];
      return CGAL::do_intersect(triangle(f), Kernel::Segment_3(exact(faces_(g, (j + 1) % 3)),
                                                               exact(faces_(g, (j + 2) % 3)))) ||
             CGAL::do_intersect(triangle(g), Kernel::Segment_3(exact(faces_(f, (i + 1) % 3)),
                                                               exact(faces_(f, (i + 2) % 3))));
    }
    const Kernel::Point_3 p = exact(faces_(f, sharedF[0]));
    const Kernel::Point_3 q = exact(faces_(f, sharedF[1]));
    const Kernel::Point_3 r = exact(faces_(f, 3 - sharedF[0] - sharedF[1]));
    const Kernel::Point_3 s = exact(faces_(g, 3 - sharedG[0] - sharedG[1]));
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

  const Points& x_;
  const Faces& faces_;
  const TriangleTree& tree_;
  const SimilarSurface* similar_;
  std::vector<int> opposite_;
  std::vector<char> isEmbedded_;
  double size_; ///< of the surface's box
};

} // namespace

std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces,
                                       TriangleTree::Order order) {
  return selfIntersectingFaces(
      TriangleTree(vertices, faces, order, TriangleTree::Queries::NoDistances));
}

std::vector<int> selfIntersectingFaces(const TriangleTree& surface) {
  if (surface.faces().rows() == 0) return {};
  return SelfIntersections(surface.vertices(), surface.faces(), surface, nullptr).find();
}

std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces,
                                       const TriangleTree& tree, const SimilarSurface& similar) {
  return SelfIntersections(vertices, faces, tree, &similar).find();
}

} // namespace massprops
