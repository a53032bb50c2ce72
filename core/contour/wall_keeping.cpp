#include "core/contour/wall_keeping.h"

#include "core/base/triangle.h"
#include "core/contour/shape_guard.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// By how much the walls of the faces around each vertex are too thin.
Vector shortfalls(ClearanceQuery& clearance, double wall, const TriangleMesh& cavity) {
  clearance.measure(cavity.vertices, cavity.faces, wall);
  const Vector& ofFace = clearance.faceDistances();
  Vector ofVertex = Vector::Zero(cavity.vertices.rows());
  for (Eigen::Index f = 0; f < ofFace.size(); ++f) {
    for (const int v : cavity.faces.row(f)) ofVertex[v] = std::max(ofVertex[v], wall - ofFace[f]);
  }
  return ofVertex;
}

} // namespace

std::vector<int> keepWall(ClearanceQuery& clearance, double wall, TriangleMesh& cavity) {
  constexpr int kRounds = 12;
  constexpr double kMore = 1.05; // than what is missing, for the direction turns on the way
  constexpr double kGrowth = 0.5;
  constexpr double kLeast = 1e-4; // of the wall
  std::vector<int> thin;
  for (int round = 0; round <= kRounds; ++round) {
    const Vector missing = shortfalls(clearance, wall, cavity);
    thin.clear();
    for (Eigen::Index v = 0; v < missing.size(); ++v) {
      if (missing[v] > 0.0) thin.push_back(static_cast<int>(v));
    }
    if (thin.empty() || round == kRounds) break;
    Points targets = cavity.vertices;
    const Points normals = vertexNormals(cavity.vertices, cavity.faces);
    for (const int v : thin) {
      const Vec3 x = cavity.vertices.row(v).transpose();
      const Vec3 away = (x - clearance.other().clearance(x).point).normalized();
      const Vec3 inwards = -normals.row(v).transpose();
      // Where a face bulges, away from its corner's nearest point is not away from the face's.
      targets.row(v) += ((kMore + kGrowth * round) * missing[v] + kLeast * wall) *
                        (away + inwards).normalized().transpose();
    }
    moveSoundly(targets, cavity.faces, cavity.vertices);
  }
  return thin;
}

} // namespace massprops
