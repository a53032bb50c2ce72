#include "core/mesh/decimation.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace massprops {
namespace {

/// A proxy that is not smaller by this factor does not pay.
constexpr double kWorthwhile = 1.4;
/// Weight of an edge's length against the distance from the surface, both squared: little, so that
/// thin limbs keep more vertices than broad flanks.
constexpr double kLengthWeight = 5e-4;
/// A collapse must not turn a face by more than about 80°, nor make one flatter than this.
constexpr double kLeastTurnCosine = 0.2;
constexpr double kLeastQuality = 0.25;
/// No component becomes smaller: its shape would be lost.
constexpr int kLeastVertices = 64;
constexpr Eigen::Index kChunk = 4096;
/// A surface of more vertices is thinned out in two halves at once.
constexpr Eigen::Index kWorthHalving = 16384;

/// Squared distance from planes, weighted with their triangles' areas: xᵀAx + 2bᵀx + c. [GH97]
struct Quadric {
  std::array<double, 10> q{}; ///< xx xy xz yy yz zz x y z 1
  double area = 0.0;

  void addPlane(const Vec3& n, const Vec3& point, double weight) {
    const double d = -n.dot(point);
    const double terms[10] = {n.x() * n.x(), n.x() * n.y(), n.x() * n.z(), n.y() * n.y(),
                              n.y() * n.z(), n.z() * n.z(), n.x() * d,     n.y() * d,
                              n.z() * d,     d * d};
    for (std::size_t i = 0; i < 10; ++i) q[i] += weight * terms[i];
    area += weight;
  }
  void add(const Quadric& other) {
    for (std::size_t i = 0; i < 10; ++i) q[i] += other.q[i];
    area += other.area;
  }
  double at(const Vec3& x) const {
    return x.x() * (q[0] * x.x() + 2.0 * (q[1] * x.y() + q[2] * x.z() + q[6])) +
           x.y() * (q[3] * x.y() + 2.0 * (q[4] * x.z() + q[7])) +
           x.z() * (q[5] * x.z() + 2.0 * q[8]) + q[9];
  }
};

/// The surface while its edges collapse. Face f has the half-edges 3f, 3f+1, 3f+2.
class QuadricDecimation {
public:
  QuadricDecimation(const Points& vertices, const Faces& faces)
      : x_(vertices), corner_(faces.data(), faces.data() + faces.size()),
        opposite_(oppositeHalfEdges(vertices.rows(), faces)),
        outgoing_(static_cast<std::size_t>(vertices.rows()), -1),
        parent_(static_cast<std::size_t>(vertices.rows())),
        quadrics_(static_cast<std::size_t>(vertices.rows())),
        component_(componentNumbers(vertices.rows(), faces)) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t h = 0; h < corner_.size(); ++h)
      outgoing_[at(corner_[h])] = static_cast<int>(h);
    Eigen::Index betweenHalves = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      if (halfOf(faces(f, 0)) != halfOf(faces(f, 1)) || halfOf(faces(f, 1)) != halfOf(faces(f, 2)))
        ++betweenHalves;
      const Vec3 a = point(faces(f, 0));
      const Vec3 normal = (point(faces(f, 1)) - a).cross(point(faces(f, 2)) - a);
      const double twiceArea = normal.norm();
      if (!(twiceArea > 0.0)) continue;
      for (const int v : faces.row(f)) {
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
    areHalvesApart_ = kFew * betweenHalves < faces.rows();
  }

  void reduceTo(const Coarseness& wanted) {
    reduceTo(wanted.most, std::numeric_limits<double>::infinity());
    reduceTo(wanted.least, wanted.distance);
  }

  /// No vertex goes that is farther than `distance` from the planes of its faces.
  void reduceTo(Eigen::Index wanted, double distance) {
    mostSquared_ = distance * distance;
    // Sweeps with rising thresholds: the order of the vertices along a space-filling curve is kept,
    // which is quicker than a queue, and each sweep thins the surface out evenly.
    const double totalArea =
        std::accumulate(quadrics_.begin(), quadrics_.end(), 0.0,
                        [](double sum, const Quadric& q) { return sum + q.area; });
    const double areaEach = totalArea / static_cast<double>(std::max<Eigen::Index>(size(), 1));
    double threshold = kLengthWeight * areaEach * areaEach;
    constexpr int kMostSweeps = 200;
    for (int sweep = 0; sweep < kMostSweeps && size() > wanted; ++sweep) {
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

  CoarseCopy copy() const {
    CoarseCopy result;
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
    std::vector<int> kept;
    for (std::size_t h = 0; h < corner_.size(); h += 3) {
      if (corner_[h] < 0) continue;
      for (std::size_t k = 0; k < 3; ++k) kept.push_back(number[at(corner_[h + k])]);
    }
    result.mesh.faces =
        Eigen::Map<const Faces>(kept.data(), static_cast<Eigen::Index>(kept.size() / 3), 3);
    return result;
  }

  std::vector<int> vertexFor(const CoarseCopy& copy);

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
  int to(int h) const { return corner_[at(nextHalfEdge(h))]; }

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
          own.at(target) + kLengthWeight * own.area * (target - point(v)).squaredNorm();
      if (own.at(target) > mostSquared_ * own.area) continue;
      if (cost <= threshold) {
        half.candidates.emplace_back(cost, h);
      } else {
        half.nextCost = std::min(half.nextCost, cost);
      }
    }
    std::sort(half.candidates.begin(), half.candidates.end());
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
      const Vec3 before = (pb - from).cross(pc - from);
      const Vec3 after = (pb - target).cross(pc - target);
      const double longest = std::max(
          {(pb - target).squaredNorm(), (pc - target).squaredNorm(), (pc - pb).squaredNorm()});
      const double areas = before.norm() * after.norm();
      if (!(before.dot(after) > kLeastTurnCosine * areas)) return false;
      if (!(after.norm() > kLeastQuality * longest) && after.norm() < before.norm()) return false;
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
    for (const int g : fan) corner_[at(g)] = w;
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
      outgoing_[at(corner_[at(p)])] = beyondN;
      outgoing_[at(w)] = corner_[at(beyondN)] == w ? beyondN : beyondP;
      for (const int e : {dead, n, p}) corner_[at(e)] = -1;
    }
    outgoing_[at(v)] = -1;
    parent_[at(v)] = w;
    quadrics_[at(w)].add(quadrics_[at(v)]);
  }

  int root(int v) {
    while (parent_[at(v)] != v) {
      parent_[at(v)] = parent_[at(parent_[at(v)])];
      v = parent_[at(v)];
    }
    return v;
  }

  const Points& x_;
  std::vector<int> corner_, opposite_, outgoing_, parent_;
  std::vector<Quadric> quadrics_;
  std::vector<int> component_;
  std::array<Half, 2> halves_;
  bool areHalvesApart_ = false; ///< have few faces in common
  double mostSquared_ = 0.0;
};

/// For every vertex of the surface the vertex of the copy that it was collapsed onto.
std::vector<int> QuadricDecimation::vertexFor(const CoarseCopy& copy) {
  std::vector<int> number(outgoing_.size(), -1);
  for (std::size_t i = 0; i < copy.vertexOf.size(); ++i) {
    number[at(copy.vertexOf[i])] = static_cast<int>(i);
  }
  std::vector<int> result(static_cast<std::size_t>(x_.rows()));
  for (std::size_t v = 0; v < result.size(); ++v) {
    result[v] = number[at(root(static_cast<int>(v)))];
  }
  return result;
}

bool isMuchLess(Eigen::Index size, const Points& vertices) {
  return static_cast<double>(vertices.rows()) >= kWorthwhile * static_cast<double>(size);
}

template <int Columns>
void addTransposed(const Faces& corners, const Points& weights,
                   const Eigen::Ref<const RowMatrix>& values, const Chunk& chunk, RowMatrix& sum) {
  using Row = Eigen::Matrix<double, 1, Columns>;
  for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
    const Eigen::Map<const Row> value(values.row(v).data(), values.cols());
    for (int k = 0; k < 3; ++k) {
      Eigen::Map<Row>(sum.row(corners(v, k)).data(), sum.cols()) += weights(v, k) * value;
    }
  }
}

} // namespace

Interpolation::Interpolation(Faces corners, Points weights, Eigen::Index proxySize)
    : rows_(corners.rows()), cols_(proxySize), corners_(std::move(corners)),
      weights_(std::move(weights)) {}

Interpolation Interpolation::identity(Eigen::Index size) {
  Interpolation result;
  result.rows_ = size;
  result.cols_ = size;
  return result;
}

Vector Interpolation::operator*(const Vector& values) const {
  if (isIdentity()) return values;
  Vector result(rows_);
  forChunks(rows_, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      result[v] = weights_(v, 0) * values[corners_(v, 0)] +
                  weights_(v, 1) * values[corners_(v, 1)] + weights_(v, 2) * values[corners_(v, 2)];
    }
  });
  return result;
}

Points Interpolation::operator*(const Points& values) const {
  if (isIdentity()) return values;
  Points result(rows_, 3);
  forChunks(rows_, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      result.row(v) = weights_(v, 0) * values.row(corners_(v, 0)) +
                      weights_(v, 1) * values.row(corners_(v, 1)) +
                      weights_(v, 2) * values.row(corners_(v, 2));
    }
  });
  return result;
}

RowMatrix Interpolation::transposeTimes(const Eigen::Ref<const RowMatrix>& values) const {
  if (isIdentity()) return values;
  // One sum a chunk, for the sums of two threads must not depend on who comes first.
  const Eigen::Index length = std::max<Eigen::Index>(kChunk / 2, chunkCount(rows_, 4));
  std::vector<RowMatrix> parts(static_cast<std::size_t>(chunkCount(rows_, length)));
  forChunks(rows_, length, [&](const Chunk& chunk) {
    RowMatrix& part = parts[static_cast<std::size_t>(chunk.number)];
    part.setZero(cols_, values.cols());
    // Rows of known length take half the time.
    switch (values.cols()) {
    case 4:
      addTransposed<4>(corners_, weights_, values, chunk, part);
      break;
    case 10:
      addTransposed<10>(corners_, weights_, values, chunk, part);
      break;
    default:
      addTransposed<Eigen::Dynamic>(corners_, weights_, values, chunk, part);
    }
  });
  for (std::size_t i = 1; i < parts.size(); ++i) parts[0] += parts[i];
  return std::move(parts[0]);
}

CoarseCopy coarseCopy(const Points& vertices, const Faces& faces, const Coarseness& wanted) {
  if (isMuchLess(wanted.least, vertices)) {
    QuadricDecimation surface(vertices, faces);
    surface.reduceTo(wanted);
    if (isMuchLess(surface.size(), vertices)) return surface.copy();
  }
  CoarseCopy copy{{vertices, faces}, {}};
  copy.vertexOf.resize(static_cast<std::size_t>(vertices.rows()));
  std::iota(copy.vertexOf.begin(), copy.vertexOf.end(), 0);
  return copy;
}

Proxy makeProxy(const Points& vertices, const Faces& faces, const Coarseness& wanted) {
  if (isMuchLess(wanted.least, vertices)) {
    QuadricDecimation surface(vertices, faces);
    surface.reduceTo(wanted);
    if (isMuchLess(surface.size(), vertices)) {
      CoarseCopy copy = surface.copy();
      std::vector<int> vertexFor = surface.vertexFor(copy);
      return {std::move(copy.mesh), std::move(copy.vertexOf), std::move(vertexFor)};
    }
  }
  return {{vertices, faces}, {}, {}};
}

Interpolation interpolationFrom(const Proxy& proxy, const Points& vertices) {
  if (proxy.vertexFor.empty()) return Interpolation::identity(vertices.rows());
  // A vertex lies near the one that it was collapsed onto: from there over the copy, always to
  // the nearest face around the corners of the last one.
  const TriangleMesh& mesh = proxy.mesh;
  const Eigen::Index vertexCount = vertices.rows();
  const VertexCorners corners = vertexCorners(mesh.vertices.rows(), mesh.faces);
  Faces faces(vertexCount, 3);
  Points weights(vertexCount, 3);
  forChunks(vertexCount, kChunk, [&](const Chunk& chunk) {
    std::vector<int> visited;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      visited.clear();
      const Vec3 p = vertices.row(v).transpose();
      double best = std::numeric_limits<double>::infinity();
      int bestFace = -1;
      Vec3 bestWeights = Vec3::Zero();
      const auto visit = [&](int around) {
        if (std::find(visited.begin(), visited.end(), around) != visited.end()) return;
        visited.push_back(around);
        for (const int corner : corners.at(around)) {
          const int f = corner / 3;
          const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
          const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
          const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
          const Vec3 w = nearestWeights(p, a, b, c);
          const double distance = (w[0] * a + w[1] * b + w[2] * c - p).squaredNorm();
          if (distance < best) {
            best = distance;
            bestFace = f;
            bestWeights = w;
          }
        }
      };
      visit(proxy.vertexFor[static_cast<std::size_t>(v)]);
      constexpr int kMostSteps = 16;
      for (int step = 0; step < kMostSteps; ++step) {
        const int last = bestFace;
        for (const int around : Eigen::RowVector3i(mesh.faces.row(last))) visit(around);
        if (bestFace == last) break;
      }
      faces.row(v) = mesh.faces.row(bestFace);
      weights.row(v) = bestWeights.transpose();
    }
  });
  return {std::move(faces), std::move(weights), mesh.vertices.rows()};
}

} // namespace massprops
