#include "simulation/hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <numeric>

namespace simulation {
namespace {

constexpr double kContactHeight = 1e-4;

/// Twice the area of the triangle a, b, c seen from above.
double turn(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

std::vector<Vector3d> contacts(const Mesh& mesh) {
  const double ground = mesh.vertices.col(2).minCoeff();
  std::vector<Vector3d> points;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (mesh.vertices(v, 2) <= ground + kContactHeight) points.emplace_back(mesh.vertices.row(v));
  }
  return points;
}

} // namespace

std::vector<Vector3d> hullCorners(const Mesh& mesh) {
  btConvexHullComputer hull;
  hull.compute(mesh.vertices.data(), 3 * sizeof(double), static_cast<int>(mesh.vertices.rows()),
               0.0, 0.0);
  std::vector<Vector3d> corners;
  for (int i = 0; i < hull.vertices.size(); ++i) {
    const btVector3& v = hull.vertices[i];
    corners.emplace_back(v.x(), v.y(), v.z());
  }
  return corners;
}

std::vector<Vector3d> contactPolygon(const Mesh& mesh) {
  std::vector<Vector3d> points = contacts(mesh);
  std::sort(points.begin(), points.end(), [](const Vector3d& a, const Vector3d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  // The lower chain from left to right, then the upper one back [And79].
  std::vector<Vector3d> polygon;
  for (const bool upper : {false, true}) {
    const std::size_t start = polygon.size();
    for (const Vector3d& p : points) {
      while (polygon.size() >= start + 2 &&
             turn(polygon[polygon.size() - 2], polygon.back(), p) <= 0.0) {
        polygon.pop_back();
      }
      polygon.push_back(p);
    }
    polygon.pop_back();
    if (!upper) std::reverse(points.begin(), points.end());
  }
  return polygon;
}

Vector3d middleOfContact(const Mesh& mesh) {
  const std::vector<Vector3d> polygon = contactPolygon(mesh);
  Vector3d sum = Vector3d::Zero();
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double part = turn(polygon[0], polygon[i], polygon[i + 1]);
    twice += part;
    sum += part / 3.0 * (polygon[0] + polygon[i] + polygon[i + 1]);
  }
  Vector3d middle = sum / twice;
  if (!(twice > 2.0 * kContactHeight * kContactHeight)) {
    const std::vector<Vector3d> points = contacts(mesh);
    middle = std::accumulate(points.begin(), points.end(), Vector3d(0, 0, 0)) /
             static_cast<double>(points.size());
  }
  middle.z() = mesh.vertices.col(2).minCoeff();
  return middle;
}

Vector3d topPoint(const Mesh& mesh) {
  const Eigen::DiagonalMatrix<double, 3> over(1.0, -1.0, -1.0);
  return over * middleOfContact({mesh.vertices * over, mesh.faces});
}

} // namespace simulation
