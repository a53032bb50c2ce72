#include "core/reduced/offset_field.h"

#include "core/base/triangle.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/lipschitz.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/triangle_tree.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace massprops {
namespace {

/// Two opposite sides of a limb that both move less than half-way cannot meet.
constexpr double kShareOfChord = 0.5;

Points unitFaceNormals(const Points& vertices, const Faces& faces) {
  Points normals(faces.rows(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    normals.row(f) = areaNormal(vertices, faces, f).stableNormalized().transpose();
  }
  return normals;
}

/// The faces around a vertex.
using FaceFan = std::vector<int>;

double clearanceOf(const Vec3& direction, const FaceFan& fan, const Points& normals) {
  double least = 1.0;
  for (const int f : fan) least = std::min(least, normals.row(f).dot(direction.transpose()));
  return least;
}

/// The direction that leaves the steepest face around the vertex best: the axis of the narrowest
/// cone around the faces' normals, by the Badoiu–Clarkson iteration (each step goes towards the
/// worst normal, the i-th by 1/(i+1)).
Vec3 mostNormalDirection(const FaceFan& fan, const Points& normals) {
  Vec3 axis = Vec3::Zero();
  for (const int f : fan) axis += normals.row(f).transpose();
  axis.stableNormalize();
  constexpr int kSteps = 60;
  Vec3 best = axis;
  double bestClearance = clearanceOf(axis, fan, normals);
  for (int i = 1; i <= kSteps; ++i) {
    int worst = fan.front();
    for (const int f : fan) {
      if (normals.row(f).dot(axis) < normals.row(worst).dot(axis)) worst = f;
    }
    axis += (normals.row(worst).transpose() - axis) / (i + 1.0);
    const Vec3 unit = axis.stableNormalized();
    const double clearance = clearanceOf(unit, fan, normals);
    if (clearance > bestClearance) {
      bestClearance = clearance;
      best = unit;
    }
  }
  return best;
}

/// `direction` turned towards `target` just as far as the wanted clearance takes.
Vec3 turnedIntoCone(const Vec3& direction, const Vec3& target, double wanted, const FaceFan& fan,
                    const Points& normals) {
  double low = 0.0;
  double high = 1.0;
  constexpr int kBisections = 20;
  for (int i = 0; i < kBisections; ++i) {
    const double t = 0.5 * (low + high);
    const Vec3 blend = ((1.0 - t) * direction + t * target).stableNormalized();
    (clearanceOf(blend, fan, normals) < wanted ? low : high) = t;
  }
  return ((1.0 - high) * direction + high * target).stableNormalized();
}

} // namespace

Points smoothedOverSurface(const Points& values, const SparseMatrix& L, const Vector& mass,
                           double length) {
  SparseMatrix system = length * length * L;
  system.diagonal() += mass;
  const Eigen::SimplicialLDLT<SparseMatrix> solver(system);
  if (solver.info() != Eigen::Success) {
    throw std::runtime_error("the skeleton cannot be smoothed over this mesh: use Remeshing > "
                             "Isotropic Explicit Remeshing, then run again");
  }
  return solver.solve(mass.asDiagonal() * values);
}

OffsetField offsetField(const Points& vertices, const Faces& faces, const Points& axis) {
  const Points normals = unitFaceNormals(vertices, faces);
  const VertexCorners corners = vertexCorners(vertices.rows(), faces);
  OffsetField field;
  field.directions.resize(vertices.rows(), 3);
  field.reach.resize(vertices.rows());
  field.clearance.resize(vertices.rows());
  field.meanClearance.resize(vertices.rows());
  FaceFan fan;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    fan.clear();
    for (const int corner : corners.at(v)) fan.push_back(corner / 3);
    const Vec3 outward = (vertices.row(v) - axis.row(v)).transpose();
    Vec3 direction = outward.stableNormalized();
    double clearance = clearanceOf(direction, fan, normals);
    if (!(clearance >= kWantedClearance)) {
      const Vec3 target = mostNormalDirection(fan, normals);
      const double attainable = clearanceOf(target, fan, normals);
      direction =
          turnedIntoCone(direction, target, std::min(kWantedClearance, attainable), fan, normals);
      clearance = clearanceOf(direction, fan, normals);
    }
    field.directions.row(v) = direction.transpose();
    field.reach[v] = outward.norm();
    field.clearance[v] = clearance;
    Vec3 mean = Vec3::Zero();
    for (const int f : fan) mean += areaNormal(vertices, faces, f);
    field.meanClearance[v] = std::max(clearance, mean.stableNormalized().dot(direction));
  }
  const TriangleTree tree(vertices, faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  const Vector through = chords(tree, vertices, -field.directions);
  field.reach = lipschitzBelow(vertices, vertexAdjacency(vertices.rows(), faces),
                               field.reach.cwiseMin(kShareOfChord * through));
  return field;
}

} // namespace massprops
