#include "core/spatial.h"

#include "core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Eigen::Index kChunk = 1024;

/// Radius of the smallest ball around the triangle, squared, given its sides' squares.
double squaredRadius(double ab, double bc, double ca) {
  const double longest = std::max({ab, bc, ca});
  const double others = ab + bc + ca - longest;
  if (others <= longest) return 0.25 * longest; // not acute
  // a²b²c²/(16 area²), 16 area² = 2(a²b² + b²c² + c²a²) − (a⁴ + b⁴ + c⁴)
  const double sixteenAreas = 2.0 * (ab * bc + bc * ca + ca * ab) - (ab * ab + bc * bc + ca * ca);
  return ab * bc * ca / sixteenAreas;
}

} // namespace

Vector chords(const TriangleTree& surface, const Points& points, const Points& directions) {
  Vector result(points.rows());
  forChunks(points.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      result[i] = surface.firstHit(points.row(i).transpose(), directions.row(i).transpose());
    }
  });
  return result;
}

Clearance clearanceOf(const Points& vertices, const Faces& faces, const TriangleTree& other,
                      double horizon, bool findLeast) {
  Clearance result;
  result.distance = Vector::Constant(vertices.rows(), kInfinity);
  result.nearestFace.assign(static_cast<std::size_t>(vertices.rows()), -1);
  result.least = kInfinity;
  if (faces.rows() == 0) return result;
  std::vector<char> isUsed(static_cast<std::size_t>(vertices.rows()), 0);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    isUsed[static_cast<std::size_t>(faces.data()[i])] = 1;
  }
  Vector squared = Vector::Constant(vertices.rows(), kInfinity);
  double exact = 4.0 * horizon * horizon;
  const auto measure = [&] {
    forChunks(vertices.rows(), kChunk, [&](const Chunk& chunk) {
      int hint = -1;
      for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
        if (isUsed[static_cast<std::size_t>(v)] == 0) continue;
        const TriangleTree::Hit hit =
            other.nearest(vertices.row(v).transpose(), kInfinity, hint, exact);
        squared[v] = hit.squaredDistance;
        hint = hit.face;
        result.nearestFace[static_cast<std::size_t>(v)] = hit.face;
      }
    });
  };
  measure();
  if (findLeast && squared.minCoeff() > exact) {
    // All is far away, so that the least of all is not known yet.
    exact = squared.minCoeff();
    measure();
  }
  constexpr double kSlackSquared = TriangleTree::kSlack * TriangleTree::kSlack;
  const auto surely = [&](double squaredDistance) {
    return squaredDistance > exact ? std::max(exact, squaredDistance / kSlackSquared)
                                   : squaredDistance;
  };

  // At y = Σλ_i y_i the other surface is at least d away, d² ≥ Σλ_i d_i² − Σλ_i|y_i − y|²: a point
  // nearer than that to y would be nearer than d_i to some corner, for Σλ_i|p − y_i|² = |p − y|² +
  // Σλ_i|y_i − y|². The last sum is at most the squared radius of the smallest ball around the
  // triangle.
  const double leastAtVertices = squared.minCoeff();
  const double wanted =
      findLeast ? std::max(horizon * horizon, leastAtVertices) : horizon * horizon;
  struct Near {
    int face;
    double squaredDistance;
  };
  std::vector<std::vector<Near>> near(static_cast<std::size_t>(chunkCount(faces.rows(), kChunk)));
  forChunks(faces.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
      const double corners =
          std::min({squared[faces(f, 0)], squared[faces(f, 1)], squared[faces(f, 2)]});
      const Vec3 a = vertices.row(faces(f, 0)).transpose();
      const Vec3 b = vertices.row(faces(f, 1)).transpose();
      const Vec3 c = vertices.row(faces(f, 2)).transpose();
      const double loss =
          squaredRadius((b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm());
      constexpr double kRounding = 1e-12;
      if (surely(corners) - loss >= wanted * (1.0 + kRounding)) continue;
      const double least = other.squaredDistance(a, b, c, std::min(corners, wanted));
      if (least < corners) {
        near[static_cast<std::size_t>(chunk.number)].push_back({static_cast<int>(f), least});
      }
    }
  });

  for (const std::vector<Near>& part : near) {
    for (const Near& n : part) {
      if (n.squaredDistance == 0.0) result.crossing.push_back(n.face);
      for (const int v : faces.row(n.face)) squared[v] = std::min(squared[v], n.squaredDistance);
    }
  }
  Vector around = squared;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const double least =
        std::min({squared[faces(f, 0)], squared[faces(f, 1)], squared[faces(f, 2)]});
    for (const int v : faces.row(f)) around[v] = std::min(around[v], least);
  }
  result.distance = around.cwiseSqrt();
  result.least = result.distance.minCoeff();
  return result;
}

Vector surfaceDistances(const Points& vertices, const Faces& faces, const Points& otherVertices,
                        const Faces& otherFaces, double horizon) {
  return clearanceOf(vertices, faces, TriangleTree(otherVertices, otherFaces), horizon).distance;
}

} // namespace massprops
