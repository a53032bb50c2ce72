#include "core/contour/slivers.h"

#include "core/base/triangle.h"
#include "core/contour/shape_guard.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// One pass: what lies around an edge that was changed rests until the next.
class SliverPass {
public:
  SliverPass(double angle, Contour& contour)
      : angle_(angle), contour_(contour), faces_(contour.mesh.faces),
        vertices_(contour.mesh.vertices), corners_(vertexCorners(vertices_.rows(), faces_)),
        opposite_(oppositeHalfEdges(corners_, faces_)), rests_(contour.on.size(), 0),
        isGone_(static_cast<std::size_t>(faces_.rows()), 0) {}

  struct Outcome {
    int slivers = 0, changes = 0;
  };

  /// Vertices that should be on a crease and are not go onto a neighbour that is.
  int sharpen() {
    int changes = 0;
    for (int v = 0; v < static_cast<int>(contour_.on.size()); ++v) {
      if (contour_.on[at(v)] == On::Chamfer && goesOntoCrease(v)) ++changes;
    }
    dropGone();
    return changes;
  }

  Outcome run() {
    Outcome outcome;
    for (int f = 0; f < faces_.rows(); ++f) {
      if (isGone_[at(f)] != 0) continue;
      if (leastAngle(point(faces_(f, 0)), point(faces_(f, 1)), point(faces_(f, 2))) >= angle_)
        continue;
      ++outcome.slivers;
      if (mend(f)) ++outcome.changes;
    }
    dropGone();
    return outcome;
  }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int from(int h) const { return faces_(h / 3, h % 3); }
  int to(int h) const { return from(nextHalfEdge(h)); }
  Vec3 point(int v) const { return vertices_.row(v).transpose(); }
  double squaredLength(int h) const { return (point(to(h)) - point(from(h))).squaredNorm(); }

  bool mend(int f) {
    int shortest = 3 * f;
    int longest = 3 * f;
    for (const int h : {3 * f + 1, 3 * f + 2}) {
      if (squaredLength(h) < squaredLength(shortest)) shortest = h;
      if (squaredLength(h) > squaredLength(longest)) longest = h;
    }
    return collapse(shortest, from(shortest), to(shortest)) ||
           collapse(shortest, to(shortest), from(shortest)) || flip(longest);
  }

  bool goesOntoCrease(int v) {
    std::vector<std::pair<double, int>> ways;
    for (const int h : corners_.at(v)) {
      if (contour_.on[at(to(h))] == On::Crease) ways.emplace_back(squaredLength(h), h);
    }
    std::sort(ways.begin(), ways.end());
    return std::any_of(ways.begin(), ways.end(),
                       [&](const auto& way) { return collapse(way.second, v, to(way.second)); });
  }

  bool isFree(int v) const {
    if (rests_[at(v)] != 0) return false;
    return std::all_of(corners_.at(v).begin(), corners_.at(v).end(),
                       [&](int h) { return rests_[at(to(h))] == 0; });
  }

  void rest(int v) {
    rests_[at(v)] = 1;
    for (const int h : corners_.at(v)) rests_[at(to(h))] = 1;
  }

  /// Vertices next to both ends.
  int commonNeighbours(int a, int b) const {
    int common = 0;
    for (const int g : corners_.at(a)) {
      for (const int h : corners_.at(b)) common += to(g) == to(h) ? 1 : 0;
    }
    return common;
  }

  /// Of the edge of `h` its end `gone` onto the end `kept`.
  bool collapse(int h, int gone, int kept) {
    if (contour_.on[at(gone)] == On::Crease && contour_.on[at(kept)] != On::Crease) return false;
    if (!isFree(gone) || !isFree(kept) || commonNeighbours(gone, kept) != 2) return false;
    const int other = opposite_[at(h)];
    for (const int apex : {from(previousHalfEdge(h)), from(previousHalfEdge(other))}) {
      if (corners_.at(apex).size() < 4) return false;
    }
    const Vec3 target = point(kept);
    const double before = leastAround(gone, point(gone), kept);
    if (!(leastAround(gone, target, kept) > std::min(before, angle_))) return false;
    if (!keepsDirections(gone, target, kept)) return false;
    rest(gone);
    rest(kept);
    for (const int g : corners_.at(gone)) faces_(g / 3, g % 3) = kept;
    isGone_[at(h / 3)] = isGone_[at(other / 3)] = 1;
    return true;
  }

  /// Least angle of the triangles around v that do not have `without`, v being at x; with v where
  /// it is also those that have it.
  double leastAround(int v, const Vec3& x, int without) const {
    double least = 180.0;
    const bool isAll = x == point(v);
    for (const int h : corners_.at(v)) {
      const int b = to(h);
      const int c = from(previousHalfEdge(h));
      if (!isAll && (b == without || c == without)) continue;
      least = std::min(least, leastAngle(x, point(b), point(c)));
    }
    return least;
  }

  bool keepsDirections(int v, const Vec3& x, int without) const {
    constexpr double kLeastCosine = 0.7;
    const auto& around = corners_.at(v);
    return std::all_of(around.begin(), around.end(), [&](int h) {
      const int b = to(h);
      const int c = from(previousHalfEdge(h));
      if (b == without || c == without) return true;
      const Vec3 before = areaNormal(point(v), point(b), point(c));
      const Vec3 after = areaNormal(x, point(b), point(c));
      constexpr double kFlat = 1e-3; // its direction tells nothing
      const double longest =
          std::max((point(b) - point(v)).squaredNorm(), (point(c) - point(v)).squaredNorm());
      return before.norm() < kFlat * longest ||
             before.dot(after) > kLeastCosine * before.norm() * after.norm();
    });
  }

  bool flip(int h) {
    const int other = opposite_[at(h)];
    const int a = from(h);
    const int b = to(h);
    const int c = from(previousHalfEdge(h));
    const int d = from(previousHalfEdge(other));
    for (const int v : {a, b, c, d}) {
      if (rests_[at(v)] != 0) return false;
    }
    if (corners_.at(a).size() < 4 || corners_.at(b).size() < 4) return false;
    for (const int g : corners_.at(c)) {
      if (to(g) == d || from(previousHalfEdge(g)) == d) return false;
    }
    const Vec3 pa = point(a);
    const Vec3 pb = point(b);
    const Vec3 pc = point(c);
    const Vec3 pd = point(d);
    const double before = std::min(leastAngle(pa, pb, pc), leastAngle(pa, pd, pb));
    const double after = std::min(leastAngle(pc, pa, pd), leastAngle(pc, pd, pb));
    if (!(after > before)) return false;
    const Vec3 larger = areaNormal(pa, pb, pc).squaredNorm() > areaNormal(pa, pd, pb).squaredNorm()
                            ? areaNormal(pa, pb, pc)
                            : areaNormal(pa, pd, pb);
    constexpr double kLeastCosine = 0.9;
    for (const Vec3& normal : {areaNormal(pc, pa, pd), areaNormal(pc, pd, pb)}) {
      if (!(normal.dot(larger) > kLeastCosine * normal.norm() * larger.norm())) return false;
    }
    for (const int v : {a, b, c, d}) rest(v);
    faces_.row(h / 3) << c, a, d;
    faces_.row(other / 3) << c, d, b;
    return true;
  }

  void dropGone() {
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
      if (isGone_[static_cast<std::size_t>(f)] == 0) faces_.row(kept++) = faces_.row(f).eval();
    }
    faces_.conservativeResize(kept, 3);
  }

  double angle_;
  Contour& contour_;
  Faces& faces_;
  const Points& vertices_;
  VertexCorners corners_;
  std::vector<int> opposite_;
  std::vector<char> rests_;  ///< for every vertex
  std::vector<char> isGone_; ///< for every face
};

} // namespace

int removeSlivers(double angle, Contour& contour) {
  constexpr int kPasses = 12;
  int left = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (SliverPass(angle, contour).sharpen() == 0) break;
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto [slivers, changes] = SliverPass(angle, contour).run();
    left = slivers - changes;
    if (changes == 0) break;
  }
  Submesh used = submesh(contour.mesh.vertices, contour.mesh.faces);
  contour = partOf(contour, std::move(used.mesh), used.vertexOf);
  return left;
}

} // namespace massprops
