#include "core/answer/cutaway.h"

#include "core/mesh/degenerate_faces.h"
#include "core/mesh/plane_cut.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {
namespace {

Points asTheyAre(const Points& points) {
  return points;
}

/// At least the level, and off all heights.
double levelOff(const Eigen::VectorXd& heights, double level, double apart) {
  while ((heights.array() - level).abs().minCoeff() < 0.5 * apart) level += apart;
  return level;
}

/// Along a plane next to z = 0 that meets no vertex; empty where it cannot be cut along.
std::optional<PlaneCut> cutNear(const TriangleMesh& mesh, double size) {
  const double level = levelOff(mesh.vertices.col(2), 0.0, kSafe * size);
  return cutAbove(mesh.vertices, mesh.faces, level, 0.0, asTheyAre);
}

} // namespace

std::optional<ColouredMesh> cutaway(const TriangleMesh& material, Eigen::Index cavityVertices,
                                    const Vec3& point, const Vec3& normal) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(normal, -Vec3::UnitZ()).toRotationMatrix();
  TriangleMesh turned = material;
  turned.vertices = (material.vertices.rowwise() - point.transpose()) * turn.transpose();
  if (turned.vertices.col(2).maxCoeff() <= 0.0) return ColouredMesh{};
  const double size =
      (material.vertices.colwise().maxCoeff() - material.vertices.colwise().minCoeff()).norm();
  const std::optional<PlaneCut> half = cutNear(turned, size);
  if (!half) return std::nullopt;

  enum Kind { Outer, Cavity, Cut };
  const Colour colours[] = {kOuterColour, kCavityColour, kCutColour};
  const Faces& faces = half->mesh.faces;
  ColouredMesh result;
  result.mesh.faces.resize(faces.rows(), 3);
  std::vector<Vec3> points;
  std::vector<int> numbers[3];
  for (std::vector<int>& number : numbers)
    number.assign(static_cast<std::size_t>(half->mesh.vertices.rows()), -1);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const int face = half->faceOf[static_cast<std::size_t>(f)];
    const Kind kind = face < 0                                               ? Cut
                      : material.faces.row(face).minCoeff() < cavityVertices ? Cavity
                                                                             : Outer;
    for (int k = 0; k < 3; ++k) {
      int& number = numbers[kind][static_cast<std::size_t>(faces(f, k))];
      if (number < 0) {
        number = static_cast<int>(points.size());
        points.emplace_back(turn.transpose() * half->mesh.vertices.row(faces(f, k)).transpose() +
                            point);
        result.colours.push_back(colours[kind]);
      }
      result.mesh.faces(f, k) = number;
    }
  }
  result.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    result.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v].transpose();
  }
  return result;
}

} // namespace massprops
