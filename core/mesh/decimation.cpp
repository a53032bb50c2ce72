#include "core/mesh/decimation.h"

#include "core/base/interruption.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace massprops {
namespace {

/// Weight of an edge's length against the distance from the surface, both squared: little, so that
/// thin limbs keep more vertices than broad flanks.
constexpr double kLengthWeight = 5e-4;
/// A collapse must not turn a face by more than about 80°, nor make one flatter than this.
constexpr double kLeastTurnCosine = 0.2;
constexpr double kLeastQuality = 0.25;
/// No component becomes smaller: its shape would be lost.
constexpr int kLeastVertices = 64;
/// A surface of more vertices is thinned out in two halves at once.
constexpr Eigen::Index kWorthHalving = 16384;

/// Squared distance from planes, weighted with their triangles' areas: xᵀAx + 2bᵀx + c. [GH97]
struct Quadric {
  std::array<double, 10> q{}; ///< xx xy xz yy yz zz x y z 1

  void addPlane(const Vec3& n, const Vec3& point, double weight) {
    const double d = -n.dot(point);
    const double terms[10] = {n.x() * n.x(), n.x() * n.y(), n.x() * n.z(), n.y() * n.y(),
                              n.y() * n.z(), n.z() * n.z(), n.x() * d,     n.y() * d,
                              n.z() * d,     d * d};
    for (std::size_t i = 0; i < 10; ++i) q[i] += weight * terms[i];
  }
  void add(const Quadric& other) {
    for (std::size_t i = 0; i < 10; ++i) q[i] += other.q[i];
  }
  /// Of the triangles: the trace of A, for their normals are of length 1.
  double area() const { return q[0] + q[3] + q[5]; }
  double at(const Vec3& x) const {
    return x.x() * (q[0] * x.x() + 2.0 * (q[1] * x.y() + q[2] * x.z() + q[6])) +
           x.y() * (q[3] * x.y() + 2.0 * (q[4] * x.z() + q[7])) +
           x.z() * (q[5] * x.z() + 2.0 * q[8]) + q[9];
  }
};

/// The surface while its edges collapse. Face f has the half-edges 3f, 3f+1, 3f+2.
class QuadricDecimation {
public:
  QuadricDecimation(const Points& vertices, Faces faces, const DecimationTarget& target)
      : x_(vertices), leastAngle_(target.leastAngle),
        longestSquared_(target.longestEdge * target.longestEdge), faces_(std::move(faces)),
        opposite_(oppositeHalfEdges(vertices.rows(), faces_)),
        outgoing_(static_cast<std::size_t>(vertices.rows()), -1),
        collapsedOnto_(static_cast<std::size_t>(vertices.rows())),
        quadrics_(static_cast<std::size_t>(vertices.rows())),
        component_(componentNumbers(vertices.rows(), faces_)) {
    std::iota(collapsedOnto_.begin(), collapsedOnto_.end(), 0);
    for (int h = 0; h < static_cast<int>(faces_.size()); ++h) outgoing_[at(corner(h))] = h;
    Eigen::Index betweenHalves = 0;
    for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
      const auto corners = faces_.row(f);
      if (halfOf(corners[0]) != halfOf(corners[1]) || halfOf(corners[1]) != halfOf(corners[2]))
        ++betweenHalves;
      const Vec3 a = point(corners[0]);
      const Vec3 normal = areaNormal(x_, faces_, f);
      const double twiceArea = normal.norm();
      if (!(twiceArea > 0.0)) continue;
      for (const int v : corners) {
        quadrics_[at(v)].addPlane(normal / twiceArea, a, twiceArea / 6.0);
      }
    }
    const int components =
        component_.empty() ? 0 : 1 + *std::max_element(component_.begin(), component_.end());
    for (Half& half : halves_) half.sizes.assign(at(components), 0);
    for (int v = 0; v < vertexCount(); ++v) {
      if (outgoing_[at(v)] < 0) continue;
      Half& half = halves_[halfOf(v)];
      ++half.alive;
      ++half.sizes[at(component_[at(v)])];
    }
    constexpr Eigen::Index kFew = 20;
    areHalvesApart_ = kFew * betweenHalves < faces_.rows();
  }

  void reduceTo(const DecimationTarget& target) {
    reduceTo(target.most, std::numeric_limits<double>::infinity());
    reduceTo(target.least, target.distance);
  }

  /// No vertex goes that is farther than `distance` from the planes of its faces.
  void reduceTo(Eigen::Index wanted, double distance) {
    mostSquared_ = distance * distance;
    // Sweeps with rising thresholds: the order of the vertices along a space-filling curve is kept,
    // which is quicker than a queue, and each sweep thins the surface out evenly.
    const double totalArea =
        std::accumulate(quadrics_.begin(), quadrics_.end(), 0.0,
                        [](double sum, const Quadric& q) { return sum + q.area(); });
    const double areaEach = totalArea / static_cast<double>(std::max<Eigen::Index>(size(), 1));
    double threshold = kLengthWeight * areaEach * areaEach;
    while (size() > wanted) {
      const bool near = size() < 3 * wanted;
      const Eigen::Index before = size();
      for (Half& half : halves_) half.nextCost = std::numeric_limits<double>::infinity();
      if (areHalvesApart_ && !near && before > kWorthHalving) {
        inParallel([&] { thinOut(0, threshold, wanted / 2); },
                   [&] { thinOut(1, threshold, wanted / 2); });
      } else {
        for (int v = 0; v < vertexCount() && size() > wanted; ++v) {
          if (outgoing_[at(v)] >= 0) tryToRemove(v, threshold, false);
        }
      }
      const double nextCost = std::min(halves_[0].nextCost, halves_[1].nextCost);
      const bool isStuck = size() == before;
      if (isStuck && nextCost == std::numeric_limits<double>::infinity()) break;
      do {
        threshold *= near ? 1.5 : 3.0;
      } while (isStuck && threshold < nextCost);
    }
  }

  Eigen::Index size() const { return halves_[0].alive + halves_[1].alive; }

  DecimatedMesh result() && {
    // These take most of the memory.
    std::vector<Quadric>().swap(quadrics_);
    std::vector<int>().swap(opposite_);
    DecimatedMesh result;
    std::vector<int> number(outgoing_.size(), -1);
    for (std::size_t v = 0; v < outgoing_.size(); ++v) {
      if (outgoing_[v] < 0) continue;
      number[v] = static_cast<int>(result.vertexOf.size());
      result.vertexOf.push_back(static_cast<int>(v));
    }
    result.mesh.vertices.resize(static_cast<Eigen::Index>(result.vertexOf.size()), 3);
    for (std::size_t i = 0; i < result.vertexOf.size(); ++i) {
      result.mesh.vertices.row(static_cast<Eigen::Index>(i)) = x_.row(result.vertexOf[i]);
    }
    int kept = 0;
    for (int h = 0; h < static_cast<int>(faces_.size()); ++h) {
      if (corner(h) >= 0) corner(kept++) = number[at(corner(h))];
    }
    faces_.conservativeResize(kept / 3, 3);
    result.mesh.faces = std::move(faces_);
    result.vertexFor = vertexFor(number);
    return result;
  }

private:
  /// Of the vertices, by their numbers, which are near each other in space where the numbers are.
  struct Half {
    Eigen::Index alive = 0;
    std::vector<int> sizes; ///< of the parts of the components in it
    double nextCost = 0.0;  ///< the least that the present sweep found too high
    std::vector<int> fan, otherFan;
    std::vector<std::pair<double, int>> candidates;
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int vertexCount() const { return static_cast<int>(outgoing_.size()); }
  std::size_t halfOf(int v) const { return v < vertexCount() / 2 ? 0 : 1; }
  Vec3 point(int v) const { return x_.row(v).transpose(); }
  int corner(int h) const { return faces_.data()[h]; }
  int& corner(int h) { return faces_.data()[h]; }
  int to(int h) const { return corner(nextHalfEdge(h)); }

  /// The half-edges from v outwards, counter-clockwise.
  void collectFan(int v, std::vector<int>& fan) const {
    fan.clear();
    int h = outgoing_[at(v)];
    do {
      fan.push_back(h);
      h = opposite_[at(previousHalfEdge(h))];
    } while (h != outgoing_[at(v)]);
  }

  /// One sweep over a half. What it reads and writes belongs to vertices of this half alone, for
  /// those with a neighbour in the other one stay: both halves may be thinned out at once.
  void thinOut(std::size_t number, double threshold, Eigen::Index least) {
    const Half& half = halves_[number];
    const int middle = vertexCount() / 2;
    const int begin = number == 0 ? 0 : middle;
    const int end = number == 0 ? middle : vertexCount();
    for (int v = begin; v < end && half.alive > least; ++v) {
      if (outgoing_[at(v)] >= 0) tryToRemove(v, threshold, true);
    }
  }

  /// `staysInHalf`: leave v where a neighbour is of the other half.
  void tryToRemove(int v, double threshold, bool staysInHalf) {
    Half& half = halves_[halfOf(v)];
    const std::size_t component = at(component_[at(v)]);
    const int others = staysInHalf ? 0 : halves_[1 - halfOf(v)].sizes[component];
    if (half.sizes[component] + others <= kLeastVertices) return;
    collectFan(v, half.fan);
    if (staysInHalf && std::any_of(half.fan.begin(), half.fan.end(),
                                   [&](int h) { return halfOf(to(h)) != halfOf(v); })) {
      return;
    }
    const Quadric& own = quadrics_[at(v)];
    half.candidates.clear();
    for (const int h : half.fan) {
      const Vec3 target = point(to(h));
      const double cost =
          own.at(target) + kLengthWeight * own.area() * (target - point(v)).squaredNorm();
      if (own.at(target) > mostSquared_ * own.area()) continue;
      if (cost <= threshold) {
        half.candidates.emplace_back(cost, h);
      } else {
        half.nextCost = std::min(half.nextCost, cost);
      }
    }
    std::sort(half.candidates.begin(), half.candidates.end());
    if (!half.candidates.empty()) checkpoint();
    for (const auto& [cost, h] : half.candidates) {
      if (!isLegal(v, h, half)) continue;
      collapse(v, h, half.fan);
      --half.alive;
      --half.sizes[component];
      return;
    }
  }

  /// Whether moving v onto the end of h keeps the surface a manifold [link condition] and turns no
  /// face over. `half.fan` is v's.
  bool isLegal(int v, int h, Half& half) const {
    const int w = to(h);
    collectFan(w, half.otherFan);
    int common = 0;
    for (const int g : half.fan) {
      const int u = to(g);
      for (const int e : half.otherFan) common += to(e) == u ? 1 : 0;
    }
    if (common != 2 || half.fan.size() < 4 || half.otherFan.size() < 4) return false;
    const int left = to(nextHalfEdge(h));
    const int right = to(nextHalfEdge(opposite_[at(h)]));
    if (valence(left) < 4 || valence(right) < 4) return false;
    const Vec3 target = point(w);
    const Vec3 from = point(v);
    for (const int g : half.fan) {
      const int b = to(g);
      const int c = to(nextHalfEdge(g));
      if (b == w || c == w) continue;
      const Vec3 pb = point(b);
      const Vec3 pc = point(c);
      const Vec3 before = areaNormal(from, pb, pc);
      const Vec3 after = areaNormal(target, pb, pc);
      if ((pb - target).squaredNorm() > longestSquared_) return false;
      const double longest = std::max(
          {(pb - target).squaredNorm(), (pc - target).squaredNorm(), (pc - pb).squaredNorm()});
      const double areas = before.norm() * after.norm();
      if (!(before.dot(after) > kLeastTurnCosine * areas)) return false;
      if (!(after.norm() > kLeastQuality * longest) && after.norm() < before.norm()) return false;
      if (leastAngle_ <= 0.0) continue;
      const double angle = leastAngle(target, pb, pc);
      if (angle < leastAngle_ && angle < leastAngle(from, pb, pc)) return false;
    }
    return true;
  }

  int valence(int v) const {
    int count = 0;
    int h = outgoing_[at(v)];
    do {
      ++count;
      h = opposite_[at(previousHalfEdge(h))];
    } while (h != outgoing_[at(v)]);
    return count;
  }

  void collapse(int v, int h, const std::vector<int>& fan) {
    const int w = to(h);
    for (const int g : fan) corner(g) = w;
    for (const int dead : {h, opposite_[at(h)]}) {
      // The face goes; the faces beyond its two other sides become neighbours.
      const int n = nextHalfEdge(dead);
      const int p = previousHalfEdge(dead);
      const int beyondN = opposite_[at(n)];
      const int beyondP = opposite_[at(p)];
      opposite_[at(beyondN)] = beyondP;
      opposite_[at(beyondP)] = beyondN;
      // p ends and n begins where the dead half-edge begins and ends; the third corner is p's
      // start.
      outgoing_[at(corner(p))] = beyondN;
      outgoing_[at(w)] = corner(beyondN) == w ? beyondN : beyondP;
      for (const int e : {dead, n, p}) corner(e) = -1;
    }
    outgoing_[at(v)] = -1;
    collapsedOnto_[at(v)] = w;
    quadrics_[at(w)].add(quadrics_[at(v)]);
  }

  /// For every vertex the number of the one that is left of those that it fell together with.
  std::vector<int> vertexFor(const std::vector<int>& number) const {
    const std::size_t n = outgoing_.size();
    std::vector<int> rank(n);
    std::vector<int> parent(n);
    boost::disjoint_sets<int*, int*> sets(rank.data(), parent.data());
    for (int v = 0; v < vertexCount(); ++v) sets.make_set(v);
    for (int v = 0; v < vertexCount(); ++v) sets.union_set(v, collapsedOnto_[at(v)]);
    std::vector<int> ofSet(n, -1);
    for (int v = 0; v < vertexCount(); ++v) {
      if (number[at(v)] >= 0) ofSet[at(sets.find_set(v))] = number[at(v)];
    }
    std::vector<int> result(n);
    for (int v = 0; v < vertexCount(); ++v) result[at(v)] = ofSet[at(sets.find_set(v))];
    return result;
  }

  const Points& x_;
  double leastAngle_, longestSquared_;
  Faces faces_; ///< with corners -1 where they are gone
  std::vector<int> opposite_, outgoing_;
  std::vector<int> collapsedOnto_; ///< a vertex onto itself while it is there
  std::vector<Quadric> quadrics_;
  std::vector<int> component_;
  std::array<Half, 2> halves_;
  bool areHalvesApart_ = false; ///< have few faces in common
  double mostSquared_ = 0.0;
};

} // namespace

DecimatedMesh decimated(const Points& vertices, Faces faces, const DecimationTarget& target) {
  const auto isWorthwhile = [&](Eigen::Index size) {
    return static_cast<double>(vertices.rows()) >= target.leastFactor * static_cast<double>(size);
  };
  if (isWorthwhile(target.least)) {
    const bool isAlwaysWorthwhile = target.leastFactor <= 1.0;
    Faces whole = isAlwaysWorthwhile ? Faces() : faces;
    QuadricDecimation surface(vertices, std::move(faces), target);
    surface.reduceTo(target);
    if (isWorthwhile(surface.size())) return std::move(surface).result();
    faces = std::move(whole);
  }
  std::vector<int> itself(static_cast<std::size_t>(vertices.rows()));
  std::iota(itself.begin(), itself.end(), 0);
  return {{vertices, std::move(faces)}, itself, itself};
}

} // namespace massprops
