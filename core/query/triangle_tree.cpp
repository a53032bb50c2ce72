#include "core/query/triangle_tree.h"

#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/query/triangle_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

constexpr Eigen::Index kChunk = 4096;
/// Of what is kept out: none at all would be a crossing's.
constexpr double kLeastClearance = 1e-12;

float below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}

} // namespace

TriangleTree::TriangleTree(const Points& vertices, const Faces& faces, Order order, Queries queries)
    : TriangleTree(vertices, faces,
                   order == Order::Any ? spatialOrder(vertices, faces) : std::vector<int>(),
                   queries) {}

TriangleTree::TriangleTree(const Points& vertices, const Faces& faces, std::vector<int> order,
                           Queries queries)
    : vertices_(vertices), faces_(faces), order_(std::move(order)),
      leaves_(leafCount(faces.rows())) {
  makeBoxes(queries);
  // A float has 24 digits: so far away that most of them would be spent on the place, boxes are
  // relative to the surface's middle.
  constexpr double kFar = 64.0;
  const Vec3 middle = 0.5 * (lower() + upper());
  if (middle.cwiseAbs().maxCoeff() > kFar * (upper() - lower()).maxCoeff()) {
    centre_ = middle;
    makeBoxes(queries);
  }
}

void TriangleTree::makeBoxes(Queries queries) {
  if (queries == Queries::All) triangles_.resize(static_cast<std::size_t>(leaves_));
  std::vector<Box> level(static_cast<std::size_t>(leaves_));
  forChunks(leaves_, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index leaf = chunk.begin; leaf < chunk.end; ++leaf) {
      level[static_cast<std::size_t>(leaf)] = boxOf(firstPlace(leaf), firstPlace(leaf + 1));
      if (queries == Queries::All) triangles_[static_cast<std::size_t>(leaf)] = trianglesOf(leaf);
    }
  });
  roots_ = static_cast<int>(leaves_ / leavesOfRoot(leaves_));
  // All nodes above the leaves, roots·(1 + 4 + … + leaves/(4·roots)) of them.
  const auto nodesAbove = [&](Eigen::Index nodes) { return (nodes - roots_) / 3; };
  boxes_.resize(static_cast<std::size_t>(nodesAbove(leaves_)));
  for (Eigen::Index nodes = leaves_; nodes > roots_; nodes /= 4) {
    for (Eigen::Index i = 0; i < nodes / 4; ++i) {
      BoxPacket& four = boxes_[static_cast<std::size_t>(nodesAbove(nodes / 4) + i)];
      Box all = level[static_cast<std::size_t>(4 * i)];
      for (int child = 0; child < 4; ++child) {
        const Box& box = level[static_cast<std::size_t>(4 * i + child)];
        for (int k = 0; k < 3; ++k) {
          four.lower[k][child] = box.lower[k];
          four.upper[k][child] = box.upper[k];
        }
        all = {all.lower.min(box.lower), all.upper.max(box.upper)};
      }
      level[static_cast<std::size_t>(i)] = all;
    }
  }
  if (queries == Queries::All) makePlanes();
  box_ = level[0];
  for (int root = 1; root < roots_; ++root) {
    const Box& box = level[static_cast<std::size_t>(root)];
    box_ = {box_.lower.min(box.lower), box_.upper.max(box.upper)};
  }
  rounding_ = kFloatRounding * std::max(box_.lower.abs().maxCoeff(), box_.upper.abs().maxCoeff());
}

void TriangleTree::makePlanes() {
  // Of the last two levels.
  const Eigen::Index ofRoot = leavesOfRoot(leaves_);
  const Eigen::Index last = roots_ * (ofRoot / 4);
  const Eigen::Index before = roots_ * (ofRoot / 16);
  firstPlanes_ = innerNodes() - last - before;
  planes_.resize(static_cast<std::size_t>(last + before));
  forChunks(last + before, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      planes_[static_cast<std::size_t>(i)] =
          i < before ? planesOf(16 * i, 16) : planesOf(4 * (i - before), 4);
    }
  });
}

PlanePacket TriangleTree::planesOf(Eigen::Index firstLeaf, Eigen::Index leaves) const {
  PlanePacket planes;
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = firstPlace(firstLeaf); i < firstPlace(firstLeaf + leaves); ++i)
    sum += areaNormal(vertices_, faces_, faceAt(i));
  const double length = sum.norm();
  if (!(length > 0.0)) return planes;
  planes.normal = (sum / length).cast<float>();
  const Vec3 normal = planes.normal.cast<double>();
  for (int child = 0; child < 4; ++child) {
    const Eigen::Index first = firstLeaf + child * leaves / 4;
    double low = kInfinity;
    double high = -kInfinity;
    for (Eigen::Index i = firstPlace(first); i < firstPlace(first + leaves / 4); ++i) {
      for (const int v : faces_.row(faceAt(i))) {
        const double at = normal.dot(vertices_.row(v).transpose() - centre_);
        low = std::min(low, at);
        high = std::max(high, at);
      }
    }
    planes.above[child] = below(low);
    planes.below[child] = -below(-high);
  }
  return planes;
}

TriangleTree::Box TriangleTree::around(const Vec3& lower, const Vec3& upper) const {
  // Differences and floats are rounded without changing an order, so that boxes that meet still do.
  Box box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = below(lower[k] - centre_[k]);
    box.upper[k] = -below(centre_[k] - upper[k]);
  }
  return box;
}

TrianglePacket TriangleTree::trianglesOf(Eigen::Index leaf) const {
  TrianglePacket four;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Index place = std::min(firstPlace(leaf) + i, firstPlace(leaf + 1) - 1);
    if (place < 0) break; // no triangles at all
    const int f = faceAt(place);
    four.set(i, corner(f, 0) - centre_, corner(f, 1) - centre_, corner(f, 2) - centre_);
  }
  return four;
}

TriangleTree::Box TriangleTree::boxOf(Eigen::Index begin, Eigen::Index end) const {
  Vec3 lower = Vec3::Constant(kInfinity);
  Vec3 upper = -lower;
  for (Eigen::Index i = begin; i < end; ++i) {
    for (const int v : faces_.row(faceAt(i))) {
      lower = lower.cwiseMin(vertices_.row(v).transpose());
      upper = upper.cwiseMax(vertices_.row(v).transpose());
    }
  }
  return around(lower, upper);
}

Lanes TriangleTree::squaredGaps(const BoxPacket& boxes, const Box& other) const {
  Lanes sum = Lanes::Zero();
  for (int k = 0; k < 3; ++k) {
    // What floats cannot tell counts as no gap.
    const Lanes outside =
        (boxes.lower[k] - other.upper[k]).max(other.lower[k] - boxes.upper[k]) - rounding_;
    sum += Lanes::Zero().max(outside).square();
  }
  return (1.0F - kFloatRounding) * Lanes::Zero()
                                       .max(sum - std::numeric_limits<float>::min())
                                       .min(std::numeric_limits<float>::max());
}

template <class Distances, class Reach, class Visit>
void TriangleTree::visitNearest(const Distances& distances, const Reach& reach,
                                const Visit& visit) const {
  struct Entry {
    Eigen::Index node;
    double distance;
  };
  Entry stack[64];
  int size = 0;
  for (int root = 0; root < roots_; ++root) stack[size++] = {root, -kInfinity};
  while (size > 0) {
    const Entry e = stack[--size];
    if (!(e.distance < reach())) continue;
    if (e.node >= innerNodes()) {
      visit(e.node - innerNodes());
      continue;
    }
    const auto found = distances(e.node);
    const double most = reach();
    const int first = size;
    for (int k = 0; k < 4; ++k) {
      stack[size] = {childOf(e.node, k), static_cast<double>(found[k])};
      if (stack[size].distance < most) ++size;
    }
    for (int i = first; i + 1 < size; ++i) {
      if (stack[i].distance < stack[size - 1].distance) std::swap(stack[i], stack[size - 1]);
    }
  }
}

template <class Distances, class Reach, class Visit>
void TriangleTree::visitWithin(const Distances& distances, const Reach& reach,
                               const Visit& visit) const {
  Eigen::Index stack[64];
  int size = 0;
  for (int root = 0; root < roots_; ++root) stack[size++] = root;
  while (size > 0) {
    const Eigen::Index node = stack[--size];
    if (node >= innerNodes()) {
      visit(node - innerNodes());
      continue;
    }
    const Lanes found = distances(node);
    for (int k = 0; k < 4; ++k) {
      stack[size] = childOf(node, k);
      if (static_cast<double>(found[k]) < reach()) ++size;
    }
  }
}

double TriangleTree::slightSlack() const {
  constexpr double kSlight = 0.002;
  return isLarge(faces_.rows()) ? kSlight : 0.0;
}

TriangleTree::Hit TriangleTree::nearest(const Vec3& p, double squaredBound, int hintFace,
                                        double squaredExact, double slack) const {
  assert(!triangles_.empty());
  Hit best;
  best.squaredDistance = squaredBound;
  // Boxes at this distance or farther away are of no interest.
  double reach = squaredBound;
  const double nearEnough = 1.0 / ((1.0 + slack) * (1.0 + slack));
  const auto visit = [&](int f) {
    const Hit hit = nearestOn(f, p);
    if (!(hit.squaredDistance < best.squaredDistance)) return;
    best = hit;
    reach = best.squaredDistance > squaredExact
                ? std::max(squaredExact, best.squaredDistance / (kSlack * kSlack))
                : nearEnough * best.squaredDistance;
  };
  if (hintFace >= 0) visit(hintFace);
  visitNearest(
      [&](Eigen::Index node) {
        return boxesAt(node).squaredDistances(p - centre_, rounding_, planesAt(node));
      },
      [&] { return reach; },
      [&](Eigen::Index leaf) {
        const Lanes atLeast = triangles_[static_cast<std::size_t>(leaf)].squaredDistances(
            p - centre_, rounding_, reach);
        const Eigen::Index begin = firstPlace(leaf);
        const Eigen::Index end = firstPlace(leaf + 1);
        for (Eigen::Index i = begin; i < end; ++i) {
          if (!(static_cast<double>(atLeast[i - begin]) >= reach)) visit(faceAt(i));
        }
      });
  return best;
}

TriangleTree::Hit TriangleTree::nearestOn(int face, const Vec3& p) const {
  const Vec3 point = nearestOnTriangle(p, corner(face, 0), corner(face, 1), corner(face, 2));
  return {(p - point).squaredNorm(), face, point};
}

double TriangleTree::squaredDistance(const Vec3& a, const Vec3& b, const Vec3& c,
                                     double squaredBound, const EarlierTriangle* earlier) const {
  assert(!triangles_.empty());
  const Vec3 s[3] = {a, b, c};
  const QueryTriangle query(a - centre_, b - centre_, c - centre_);
  const Box box = around(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
  double least = squaredBound;
  const auto visit = [&](Eigen::Index leaf) {
    const Lanes atLeast =
        query.squaredDistances(triangles_[static_cast<std::size_t>(leaf)], rounding_);
    const Eigen::Index begin = firstPlace(leaf);
    const Eigen::Index end = firstPlace(leaf + 1);
    for (Eigen::Index i = begin; i < end; ++i) {
      if (static_cast<double>(atLeast[i - begin]) >= least) continue;
      const int f = faceAt(i);
      const Vec3 t[3] = {corner(f, 0), corner(f, 1), corner(f, 2)};
      least = squaredDistanceBelow(least, s, t);
    }
  };
  // The bound is near the distance most often: no order would bring it down much sooner.
  const auto distances = [&](Eigen::Index node) -> Lanes {
    const BoxPacket& boxes = boxesAt(node);
    return squaredGaps(boxes, box).max(query.squaredDistances(boxes, rounding_, planesAt(node)));
  };
  if (earlier == nullptr) {
    visitWithin(
        distances, [&] { return least; }, visit);
    return least;
  }
  const auto& were = earlier->corners;
  const WayOfTriangle way(
      a - centre_, b - centre_, c - centre_,
      {{were[0] - centre_, were[1] - centre_, were[2] - centre_}, earlier->distance});
  visitWithin(
      [&](Eigen::Index node) -> Lanes {
        return distances(node).max(way.squaredDistances(boxesAt(node), rounding_));
      },
      [&] { return least; }, visit);
  return least;
}

void TriangleTree::keepOut(const TriangleTree& triangles, double radius) {
  keptOut_ = &triangles;
  keptOutRadius_ = radius;
}

TriangleTree::Hit TriangleTree::clearance(const Vec3& p, const Hit& nearest) const {
  if (keptOut_ == nullptr) return nearest;
  const double reach = std::sqrt(nearest.squaredDistance) + keptOutRadius_;
  const Hit core = keptOut_->nearest(p, reach * reach);
  if (core.face < 0) return nearest;
  const double distance =
      std::max(std::sqrt(core.squaredDistance) - keptOutRadius_, kLeastClearance);
  const Vec3 away = (p - core.point).stableNormalized();
  return {distance * distance, nearest.face, p - distance * away};
}

double TriangleTree::squaredClearance(const Vec3& a, const Vec3& b, const Vec3& c,
                                      double squaredBound, const EarlierTriangle* earlier) const {
  // What is kept out reaches farther than its triangles.
  const double least =
      squaredDistance(a, b, c, squaredBound, keptOut_ == nullptr ? earlier : nullptr);
  if (keptOut_ == nullptr || least == 0.0) return least;
  const double reach = std::sqrt(least) + keptOutRadius_;
  const double fromCore = keptOut_->squaredDistance(a, b, c, reach * reach);
  if (fromCore >= reach * reach) return least;
  const double clear = std::max(std::sqrt(fromCore) - keptOutRadius_, kLeastClearance);
  return std::min(least, clear * clear);
}

double TriangleTree::firstHit(const Vec3& start, const Vec3& direction, double limit) const {
  double best = limit;
  const Vec3 inverse = direction.cwiseInverse();
  const Vec3 from = start - centre_;
  const auto entries = [&](Eigen::Index node) -> Eigen::Array4d {
    const BoxPacket& boxes = boxesAt(node);
    Eigen::Array4d first = Eigen::Array4d::Zero();
    Eigen::Array4d last = Eigen::Array4d::Constant(best);
    Eigen::Array4d beside = Eigen::Array4d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Array4d lower = boxes.lower[k].cast<double>() - from[k];
      const Eigen::Array4d upper = boxes.upper[k].cast<double>() - from[k];
      if (direction[k] == 0.0) {
        beside = beside.max(lower).max(-upper);
      } else {
        const Eigen::Array4d s = lower * inverse[k];
        const Eigen::Array4d t = upper * inverse[k];
        first = first.max(s.min(t));
        last = last.min(s.max(t));
      }
    }
    const Eigen::Array4d missed = beside.max(first - last * (1.0 + 1e-12) - 1e-15);
    return (missed > 0.0).select(kInfinity, first);
  };
  const auto visit = [&](int f) {
    const Vec3 a = corner(f, 0);
    const Vec3 b = corner(f, 1);
    const Vec3 c = corner(f, 2);
    if (a == start || b == start || c == start) return;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 q = direction.cross(ac);
    const double determinant = ab.dot(q);
    if (!(std::abs(determinant) > 1e-12 * ab.norm() * ac.norm())) return;
    const Vec3 s = start - a;
    const double u = s.dot(q) / determinant;
    if (!(u >= -kMeasured && u <= 1.0 + kMeasured)) return;
    const Vec3 r = s.cross(ab);
    const double v = direction.dot(r) / determinant;
    if (!(v >= -kMeasured && u + v <= 1.0 + kMeasured)) return;
    const double t = ac.dot(r) / determinant;
    if (t >= 0.0 && t < best) best = t;
  };
  visitNearest(
      entries, [&] { return best; },
      [&](Eigen::Index leaf) {
        const Eigen::Index end = firstPlace(leaf + 1);
        for (Eigen::Index i = firstPlace(leaf); i < end; ++i) visit(faceAt(i));
      });
  return best < limit ? best : kInfinity;
}

Vector chords(const TriangleTree& surface, const Points& points, const Points& directions) {
  constexpr Eigen::Index kRays = 1024;
  Vector result(points.rows());
  forChunks(points.rows(), kRays, [&](const Chunk& chunk) {
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      result[i] = surface.firstHit(points.row(i).transpose(), directions.row(i).transpose());
    }
  });
  return result;
}

} // namespace massprops
