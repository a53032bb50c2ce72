#include "core/contour/wall_keeping.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/shape_guard.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

constexpr double kMore = 1.05;  // than what is missing, for the direction turns on the way
constexpr double kLeast = 1e-4; // of the wall

/// By how much the walls of the faces around each vertex are too thin.
Vector shortfalls(double wall, const Vector& distanceOfFace, const Faces& faces,
                  Eigen::Index vertices) {
  Vector ofVertex = Vector::Zero(vertices);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (const int v : faces.row(f)) ofVertex[v] = std::max(ofVertex[v], wall - distanceOfFace[f]);
  }
  return ofVertex;
}

/// Those with a vertex that does not rest.
Faces movingFaces(const Faces& faces, const std::vector<char>& rests) {
  std::vector<Eigen::Index> moving;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto corners = faces.row(f);
    if (std::any_of(corners.begin(), corners.end(),
                    [&](int v) { return rests[static_cast<std::size_t>(v)] == 0; }))
      moving.push_back(f);
  }
  return faces(moving, Eigen::all);
}

std::vector<int> positive(const Vector& values) {
  std::vector<int> numbers;
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    if (values[v] > 0.0) numbers.push_back(static_cast<int>(v));
  }
  return numbers;
}

/// Moves vertices by what is missing, and `more` times that.
void moveInwards(const ClearanceQuery& clearance, double wall, const Vector& missing, double more,
                 const Faces& faces, Points& vertices) {
  const TriangleTree& surface = clearance.other();
  constexpr Eigen::Index kRun = 256;
  Points targets = vertices;
  const Points normals = vertexNormals(vertices, faces);
  const std::vector<int> thin = positive(missing);
  forChunks(static_cast<Eigen::Index>(thin.size()), kRun, [&](const Chunk& chunk) {
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      const int v = thin[static_cast<std::size_t>(i)];
      const Vec3 x = vertices.row(v).transpose();
      const int near = clearance.nearestFace()[static_cast<std::size_t>(v)];
      const Vec3 next = surface.clearance(x, surface.nearestOn(near, x)).point;
      const Vec3 inwards = -normals.row(v).transpose();
      // Where a face bulges, away from its corner's nearest point is not away from the face's.
      targets.row(v) += ((kMore + more) * missing[v] + kLeast * wall) *
                        ((x - next).normalized() + inwards).normalized().transpose();
    }
  });
  moveSoundly(targets, faces, vertices);
}

} // namespace

void keepWallNearly(ClearanceQuery& clearance, double wall, const Faces& faces, Points& vertices) {
  const Vector distances = clearance.faceDistancesAtMost(vertices, faces, wall);
  moveInwards(clearance, wall, shortfalls(wall, distances, faces, vertices.rows()), 0.0, faces,
              vertices);
}

std::vector<int> keepWall(ClearanceQuery& clearance, double wall, const Faces& faces,
                          Points& vertices, const std::vector<char>& rests) {
  constexpr int kRounds = 12;
  constexpr double kGrowth = 0.5;
  Faces some;
  if (!rests.empty()) some = movingFaces(faces, rests);
  const Faces& moving = rests.empty() ? faces : some;
  for (int round = 0;; ++round) {
    const Vector& distances = clearance.measureFaces(vertices, moving, wall);
    Vector missing = shortfalls(wall, distances, moving, vertices.rows());
    for (std::size_t v = 0; v < rests.size(); ++v) {
      if (rests[v] != 0) missing[static_cast<Eigen::Index>(v)] = 0.0;
    }
    std::vector<int> thin = positive(missing);
    if (thin.empty() || round == kRounds) return thin;
    moveInwards(clearance, wall, missing, kGrowth * round, faces, vertices);
  }
}

} // namespace massprops
