#include "core/contour/cavity_surface.h"

#include "core/base/angles.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/shape_guard.h"
#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// By how much the walls of the faces around each vertex are too thin.
Vector shortfalls(double wall, const Vector& distanceOfFace, const Faces& faces,
                  Eigen::Index vertices) {
  Vector ofVertex = Vector::Zero(vertices);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (const int v : faces.row(f)) ofVertex[v] = std::max(ofVertex[v], wall - distanceOfFace[f]);
  }
  return ofVertex;
}

std::vector<int> positive(const Vector& values) {
  std::vector<int> numbers;
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    if (values[v] > 0.0) numbers.push_back(static_cast<int>(v));
  }
  return numbers;
}

/// Moves these vertices by `factor` times what is missing.
void moveInwards(const ClearanceQuery& clearance, const std::vector<int>& thin,
                 const Vector& missing, double factor, bool guarded, const Faces& faces,
                 Points& vertices) {
  constexpr Eigen::Index kRun = 256;
  const TriangleTree& surface = clearance.other();
  Points targets = vertices;
  const Points normals = vertexNormals(vertices, faces);
  forChunks(static_cast<Eigen::Index>(thin.size()), kRun, [&](const Chunk& chunk) {
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      const int v = thin[static_cast<std::size_t>(i)];
      const Vec3 x = vertices.row(v).transpose();
      const int near = clearance.nearestFace()[static_cast<std::size_t>(v)];
      const Vec3 next = surface.clearance(x, surface.nearestOn(near, x)).point;
      const Vec3 inwards = -normals.row(v).transpose();
      // Where a face bulges, away from its corner's nearest point is not away from the face's.
      targets.row(v) +=
          factor * missing[v] * ((x - next).normalized() + inwards).normalized().transpose();
    }
  });
  if (guarded) {
    moveSoundly(targets, faces, vertices);
  } else {
    vertices = std::move(targets);
  }
}

} // namespace

void removeSmallComponents(double ball, Contour& contour) {
  const double least = kPi / 6.0 * std::pow(ball, 3);
  const Points& vertices = contour.mesh.vertices;
  std::vector<Faces> kept;
  for (Faces& part : connectedComponents(vertices.rows(), contour.mesh.faces)) {
    if (signedVolume(vertices, part) >= least) kept.push_back(std::move(part));
  }
  contour.mesh.faces = joined(kept);
}

void moveOntoWalls(const TriangleTree& surface, double wall, double edge,
                   const std::vector<char>& moves, Contour& contour) {
  constexpr double kFarthest = 0.5; // edges
  constexpr Eigen::Index kRun = 512;
  Points& vertices = contour.mesh.vertices;
  forChunks(vertices.rows(), kRun, [&](const Chunk& chunk) {
    RegionProbe probe({surface, wall, 0.0});
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (moves[i] == 0) continue;
      const Sample depth = probe.depthAt(vertices.row(v).transpose(), wall + edge);
      const double way = wall - depth.value;
      // What lies on something else, too, only keeps the wall.
      const bool isWanted = contour.on[i] == On::Wall || way > 0.0;
      if (isWanted && std::abs(way) <= kFarthest * edge)
        vertices.row(v) += way * depth.slope.transpose();
    }
  });
}

std::vector<int> keepWall(ClearanceQuery& clearance, double wall, const Faces& faces,
                          Points& vertices) {
  constexpr int kRounds = 6;
  constexpr int kGuarded = 2; // rounds in which triangles stay sound; then the inspection decides
  constexpr double kMore = 1.05;  // than what is missing, for the direction turns on the way
  constexpr double kGrowth = 0.5; // a round: moves of neighbours undo some of it
  for (int round = 0;; ++round) {
    const Vector& distances = clearance.measureFaces(vertices, faces, wall);
    const Vector missing = shortfalls(wall, distances, faces, vertices.rows());
    std::vector<int> thin = positive(missing);
    if (thin.empty() || round == kRounds) return thin;
    moveInwards(clearance, thin, missing, kMore + kGrowth * round, round < kGuarded, faces,
                vertices);
  }
}

} // namespace massprops
