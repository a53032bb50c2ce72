#include "simulation/body.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace simulation {
namespace {

/// ∫1, ∫x, ∫xxᵀ over the mass.
struct Integrals {
  double mass = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();

  void add(const Mesh& mesh, const Vector3d& apex, double density) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      addTetrahedron(
          {cornerOf(mesh, f, 0) - apex, cornerOf(mesh, f, 1) - apex, cornerOf(mesh, f, 2) - apex},
          density);
    }
  }

  /// What of the inside lies below the level, the apex's height, where a tetrahedron's fourth
  /// corner leaves nothing to be added for the level itself.
  void addBelow(const Mesh& mesh, const Vector3d& apex, double density) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      std::vector<Vector3d> below;
      for (int k = 0; k < 3; ++k) {
        const Vector3d p = cornerOf(mesh, f, k) - apex;
        const Vector3d q = cornerOf(mesh, f, (k + 1) % 3) - apex;
        if (p.z() <= 0.0) below.push_back(p);
        if ((p.z() <= 0.0) != (q.z() <= 0.0)) {
          below.emplace_back((q.z() * p - p.z() * q) / (q.z() - p.z()));
        }
      }
      for (std::size_t i = 2; i < below.size(); ++i) {
        addTetrahedron({below[0], below[i - 1], below[i]}, density);
      }
    }
  }

private:
  static Vector3d cornerOf(const Mesh& mesh, Eigen::Index f, int k) {
    return mesh.vertices.row(mesh.faces(f, k)).transpose();
  }

  /// With the fourth corner at the origin.
  void addTetrahedron(const std::array<Vector3d, 3>& corner, double density) {
    const double quarter = density * corner[0].dot(corner[1].cross(corner[2])) / 24.0;
    const double near = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
    const double far = (5.0 - std::sqrt(5.0)) / 20.0;
    const Vector3d sum = far * (corner[0] + corner[1] + corner[2]);
    for (int point = 0; point < 4; ++point) {
      Vector3d x = sum;
      if (point < 3) x += (near - far) * corner[static_cast<std::size_t>(point)];
      mass += quarter;
      first += quarter * x;
      second += quarter * x * x.transpose();
    }
  }
};

} // namespace

MassProperties massProperties(const Mesh& outer, const Mesh& inner, double density,
                              double fillDensity, double level) {
  Vector3d apex = outer.vertices.colwise().mean().transpose();
  const bool isPartial = level < std::numeric_limits<double>::infinity();
  if (isPartial) apex.z() = level;
  Integrals sum;
  sum.add(outer, apex, density);
  sum.add(inner, apex, isPartial ? density : density - fillDensity);
  if (isPartial) sum.addBelow(inner, apex, -fillDensity);
  MassProperties result;
  result.mass = sum.mass;
  result.centre = apex + sum.first / sum.mass;
  const Matrix3d central = sum.second - sum.first * sum.first.transpose() / sum.mass;
  result.inertia = central.trace() * Matrix3d::Identity() - central;
  return result;
}

Body inNaturalUnits(const Mesh& outer, const MassProperties& properties, double unit) {
  Body body;
  body.surface = outer;
  body.surface.vertices /= unit;
  body.centre = properties.centre / unit;
  body.inertia = properties.inertia / (properties.mass * unit * unit);
  return body;
}

double diagonal(const Mesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

} // namespace simulation
