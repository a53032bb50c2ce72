#include "core/query/surface_distance.h"

#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/mesh/connectivity.h"
#include "core/query/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

constexpr Eigen::Index kChunk = 1024;
constexpr double kRounding = 1e-12;
/// The search goes a little beyond the horizon: so far a face may move, as where it is rounded to
/// what is stored, before the next measurement has to look at it again. Without it twice as many
/// triangles are compared.
constexpr double kBeyond = 1.00001;

/// Radius of the smallest ball around the triangle, squared, given its sides' squares.
double squaredRadius(double ab, double bc, double ca) {
  const double longest = std::max({ab, bc, ca});
  const double others = ab + bc + ca - longest;
  if (others <= longest) return 0.25 * longest; // not acute
  // a²b²c²/(16 area²), 16 area² = 2(a²b² + b²c² + c²a²) − (a⁴ + b⁴ + c⁴)
  const double sixteenAreas = 2.0 * (ab * bc + bc * ca + ca * ab) - (ab * ab + bc * bc + ca * ca);
  return ab * bc * ca / sixteenAreas;
}

/// Bounds of distances by what is known of where vertices and faces were.
class Remembered {
public:
  Remembered(const ClearanceQuery::Memory& memory, const Points& vertices, const Faces& faces)
      : memory_(memory), areFacesTheSame_(faces.rows() == memory.faces.rows() &&
                                          (faces.array() == memory.faces.array()).all()),
        moved_(Vector::Constant(vertices.rows(), kInfinity)) {
    if (!areFacesTheSame_)
      corners_ = vertexCorners(std::max(vertices.rows(), memory.vertices.rows()), memory.faces);
    const Eigen::Index known = std::min(vertices.rows(), memory.vertices.rows());
    moved_.head(known) =
        (vertices.topRows(known) - memory.vertices.topRows(known)).rowwise().norm();
  }

  int nearestFace(Eigen::Index v) const {
    return v < memory_.vertices.rows() ? memory_.nearestFace[static_cast<std::size_t>(v)] : -1;
  }
  double vertexBound(Eigen::Index v) const {
    return memory_.vertexBounds[v] * (1.0 - kRounding) - moved_[v];
  }
  /// Of face f, with these corners, where it was; 0 when it was not there.
  double faceBoundBefore(Eigen::Index f, const Eigen::RowVector3i& face) const {
    if (areFacesTheSame_) return memory_.faceBounds[f] * (1.0 - kRounding);
    for (const int corner : corners_.at(face[0])) {
      if (memory_.faces.row(corner / 3) == face)
        return memory_.faceBounds[corner / 3] * (1.0 - kRounding);
    }
    return 0.0;
  }
  double faceMoved(const Eigen::RowVector3i& face) const {
    return std::max({moved_[face[0]], moved_[face[1]], moved_[face[2]]});
  }
  Vec3 before(int v) const { return memory_.vertices.row(v).transpose(); }

private:
  const ClearanceQuery::Memory& memory_;
  bool areFacesTheSame_;
  VertexCorners corners_; ///< of the faces that were there, unless they are the same
  Vector moved_;
};

/// One measurement, step by step.
class Measurement {
public:
  Measurement(const Points& vertices, const Faces& faces, const TriangleTree& other, double horizon,
              const ClearanceQuery::Memory& memory)
      : x_(vertices), faces_(faces), other_(other), horizon_(horizon),
        remembered_(memory, vertices, faces),
        squared_(Vector::Constant(vertices.rows(), kInfinity)),
        vertexBounds_(Vector::Zero(vertices.rows())), faceBounds_(faces.rows()),
        nearestFace_(static_cast<std::size_t>(vertices.rows()), -1) {}

  void measureVertices() {
    const double exact = 4.0 * horizon_ * horizon_;
    measureVertices(exact, false);
    // All is far away, so that the least of all is not known yet.
    if (squared_.minCoeff() > exact) measureVertices(squared_.minCoeff(), true);
  }

  /// Returns the faces that cross the other surface.
  std::vector<int> measureFaces() {
    std::vector<std::vector<Near>> near(
        static_cast<std::size_t>(chunkCount(faces_.rows(), kChunk)));
    forChunks(faces_.rows(), kChunk, [&](const Chunk& chunk) {
      for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
        double& bound = faceBounds_[f];
        bound = boundByCorners(f);
        double before = 0.0;
        if (bound < horizon_) {
          before = remembered_.faceBoundBefore(f, faces_.row(f));
          bound = std::max(bound, before - remembered_.faceMoved(faces_.row(f)));
        }
        const double sure = horizon_ * (1.0 + kRounding);
        if (bound >= sure) continue;
        const double reach = kBeyond * horizon_;
        double enough = std::min(leastAtCorners(squared_, f), reach * reach);
        if (before >= sure) enough = std::min(enough, 0.25 * (before + sure) * (before + sure));
        const double found = before > 0.0 ? distanceOf(f, enough, before) : distanceOf(f, enough);
        bound = std::sqrt(found);
        if (found < enough) {
          near[static_cast<std::size_t>(chunk.number)].push_back({static_cast<int>(f), found});
        }
      }
    });
    std::vector<int> crossing;
    for (const std::vector<Near>& part : near) {
      for (const Near& n : part) {
        if (n.squaredDistance == 0.0) crossing.push_back(n.face);
        account(n);
      }
    }
    return crossing;
  }

  /// Compares faces with those of the other surface that are next to their corners.
  void measureNearFaces() {
    forChunks(faces_.rows(), kChunk, [&](const Chunk& chunk) {
      for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
        faceBounds_[f] = boundByCorners(f);
        if (faceBounds_[f] >= horizon_) continue;
        double squared = horizon_ * horizon_;
        int last = -1;
        for (const int v : faces_.row(f)) {
          const int next = nearestFace_[static_cast<std::size_t>(v)];
          if (next != last) squared = distanceFrom(next, f, squared);
          last = next;
        }
        faceBounds_[f] = std::sqrt(squared);
      }
    });
  }

  /// Looks at all faces that may be nearer than the nearest known, the same ones whatever the
  /// number of threads.
  void findLeast() {
    double least = squared_.minCoeff();
    std::vector<int> candidates;
    for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
      if (mayBeNearer(f, least)) candidates.push_back(static_cast<int>(f));
    }
    std::sort(candidates.begin(), candidates.end(), [&](int f, int g) {
      return faceBounds_[f] < faceBounds_[g] || (faceBounds_[f] == faceBounds_[g] && f < g);
    });
    constexpr Eigen::Index kBatch = 256;
    constexpr Eigen::Index kFewFaces = 16;
    const auto count = static_cast<Eigen::Index>(candidates.size());
    for (Eigen::Index begin = 0; begin < count; begin += kBatch) {
      const int* const batch = candidates.data() + begin;
      if (!mayBeNearer(batch[0], least)) break;
      Vector found(std::min(kBatch, count - begin));
      forChunks(found.size(), kFewFaces, [&](const Chunk& chunk) {
        for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
          found[i] = distanceOf(batch[i], least);
        }
      });
      for (Eigen::Index i = 0; i < found.size(); ++i) {
        if (found[i] >= least) continue;
        least = found[i];
        account({batch[i], least});
      }
    }
  }

  Vector distances() const { return squared_.cwiseSqrt(); }
  const std::vector<int>& nearestFace() const { return nearestFace_; }
  const Vector& vertexBounds() const { return vertexBounds_; }
  const Vector& faceBounds() const { return faceBounds_; }
  /// In the place of what was remembered so far. Last of all.
  void remember(ClearanceQuery::Memory& memory) && {
    memory.vertices = x_;
    memory.faces = faces_;
    memory.nearestFace = std::move(nearestFace_);
    memory.vertexBounds = std::move(vertexBounds_);
    memory.faceBounds = std::move(faceBounds_);
  }

private:
  struct Near {
    int face;
    double squaredDistance;
  };

  void account(const Near& near) {
    for (const int v : faces_.row(near.face)) {
      squared_[v] = std::min(squared_[v], near.squaredDistance);
    }
  }

  bool mayBeNearer(Eigen::Index f, double squaredDistance) const {
    return faceBounds_[f] * faceBounds_[f] < squaredDistance * (1.0 - kRounding);
  }

  double leastAtCorners(const Vector& values, Eigen::Index f) const {
    return std::min({values[faces_(f, 0)], values[faces_(f, 1)], values[faces_(f, 2)]});
  }

  Vec3 corner(Eigen::Index f, int k) const { return x_.row(faces_(f, k)).transpose(); }

  double distanceFrom(int face, Eigen::Index f, double squaredBound) const {
    const auto corners = other_.faces().row(face);
    const auto at = [&](int k) { return Vec3(other_.vertices().row(corners[k]).transpose()); };
    const Vec3 s[3] = {corner(f, 0), corner(f, 1), corner(f, 2)};
    const Vec3 t[3] = {at(0), at(1), at(2)};
    return squaredDistanceBelow(squaredBound, s, t);
  }

  double distanceOf(Eigen::Index f, double squaredBound) const {
    return other_.squaredClearance(corner(f, 0), corner(f, 1), corner(f, 2), squaredBound);
  }

  /// Not nearer than `before` where it was.
  double distanceOf(Eigen::Index f, double squaredBound, double before) const {
    const EarlierTriangle earlier{{remembered_.before(faces_(f, 0)),
                                   remembered_.before(faces_(f, 1)),
                                   remembered_.before(faces_(f, 2))},
                                  before * (1.0 - kMeasured)};
    return other_.squaredClearance(corner(f, 0), corner(f, 1), corner(f, 2), squaredBound,
                                   &earlier);
  }

  /// At y = Σλ_i y_i the other surface is at least d away, d² ≥ Σλ_i d_i² − Σλ_i|y_i − y|²: a point
  /// nearer than that to y would be nearer than d_i to some corner, for Σλ_i|p − y_i|² = |p − y|² +
  /// Σλ_i|y_i − y|². The last sum is at most the squared radius of the smallest ball around the
  /// triangle.
  double boundByCorners(Eigen::Index f) const {
    const auto side = [&](int k) {
      return (x_.row(faces_(f, k)) - x_.row(faces_(f, (k + 1) % 3))).squaredNorm();
    };
    const double ofCorners = leastAtCorners(vertexBounds_, f);
    return std::sqrt(
        std::max(0.0, ofCorners * ofCorners - squaredRadius(side(0), side(1), side(2))));
  }

  void measureVertices(double squaredExact, bool all) {
    std::vector<char> isUsed(nearestFace_.size(), 0);
    for (Eigen::Index i = 0; i < faces_.size(); ++i) {
      isUsed[static_cast<std::size_t>(faces_.data()[i])] = 1;
    }
    forChunks(x_.rows(), kChunk, [&](const Chunk& chunk) {
      int hint = -1;
      for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
        if (isUsed[static_cast<std::size_t>(v)] == 0) continue;
        if (remembered_.nearestFace(v) >= 0) hint = remembered_.nearestFace(v);
        if (all || !isSurelyFar(v)) hint = searchNearest(v, squaredExact, hint);
        nearestFace_[static_cast<std::size_t>(v)] = hint;
      }
    });
  }

  /// Whether what is remembered of the vertex will do; if so, it is known from then on.
  bool isSurelyFar(Eigen::Index v) {
    const int face = remembered_.nearestFace(v);
    if (face < 0) return false;
    const double bound = remembered_.vertexBound(v);
    if (bound < horizon_) return false;
    const double most = other_.nearestOn(face, x_.row(v).transpose()).squaredDistance;
    if (most > TriangleTree::kSlack * TriangleTree::kSlack * bound * bound) return false;
    squared_[v] = most;
    vertexBounds_[v] = bound;
    return true;
  }

  /// Returns the nearest face.
  int searchNearest(Eigen::Index v, double squaredExact, int hint) {
    const Vec3 x = x_.row(v).transpose();
    const TriangleTree::Hit hit =
        other_.clearance(x, other_.nearest(x, kInfinity, hint, squaredExact));
    const double distance = std::sqrt(hit.squaredDistance);
    squared_[v] = hit.squaredDistance;
    vertexBounds_[v] = hit.squaredDistance > squaredExact
                           ? std::max(std::sqrt(squaredExact), distance / TriangleTree::kSlack)
                           : distance;
    return hit.face;
  }

  const Points& x_;
  const Faces& faces_;
  const TriangleTree& other_;
  double horizon_;
  Remembered remembered_;
  Vector squared_;                   ///< distances of the vertices, at most
  Vector vertexBounds_, faceBounds_; ///< distances, at least
  std::vector<int> nearestFace_;
};

} // namespace

Vector ClearanceQuery::faceDistancesAtMost(const Points& vertices, const Faces& faces,
                                           double horizon) {
  Measurement measurement(vertices, faces, other_, horizon, memory_);
  measurement.measureVertices();
  measurement.measureNearFaces();
  Vector atMost = measurement.faceBounds();
  std::move(measurement).remember(memory_);
  memory_.faceBounds.setZero();
  return atMost;
}

const Vector& ClearanceQuery::measureFaces(const Points& vertices, const Faces& faces,
                                           double horizon) {
  Measurement measurement(vertices, faces, other_, horizon, memory_);
  measurement.measureVertices();
  measurement.measureFaces();
  std::move(measurement).remember(memory_);
  return memory_.faceBounds;
}

Clearance ClearanceQuery::measure(const Points& vertices, const Faces& faces, double horizon) {
  Clearance result;
  if (faces.rows() == 0) {
    result.distance = Vector::Constant(vertices.rows(), kInfinity);
    result.nearestFace.assign(static_cast<std::size_t>(vertices.rows()), -1);
    result.vertexBounds = Vector::Zero(vertices.rows());
    result.least = kInfinity;
    return result;
  }
  Measurement measurement(vertices, faces, other_, horizon, memory_);
  measurement.measureVertices();
  result.crossing = measurement.measureFaces();
  measurement.findLeast();
  result.distance = measurement.distances();
  result.least = result.distance.minCoeff();
  result.nearestFace = measurement.nearestFace();
  result.vertexBounds = measurement.vertexBounds();
  std::move(measurement).remember(memory_);
  return result;
}

} // namespace massprops
