// VCG mesh ⇄ arrays: the only place where the two meet. Header-only, so that the library itself
// needs no vcglib and one source serves every host's mesh type and scalar.
#pragma once

#include "core/base/types.h"
#include "core/mesh/signed_volume.h"

#include <Eigen/Geometry>
#include <vcg/complex/complex.h>

#include <cstddef>
#include <vector>

namespace massprops {

/// What the mesh's coordinates are multiplied with to get world coordinates.
using Placement = Eigen::Affine3d;

/// Whether `placement` turns outward surfaces inside out.
inline bool mirrors(const Placement& placement) {
  return placement.linear().determinant() < 0;
}

/// Living vertices and faces of `mesh` in world coordinates, faces outward in the world when they
/// are outward in the mesh.
template <class VcgMesh>
TriangleMesh fromVcg(const VcgMesh& mesh, const Placement& placement) {
  TriangleMesh result;
  result.vertices.resize(mesh.VN(), 3);
  result.faces.resize(mesh.FN(), 3);

  std::vector<int> indexOf(mesh.vert.size(), -1);
  int vertices = 0;
  for (std::size_t i = 0; i < mesh.vert.size(); ++i) {
    if (mesh.vert[i].IsD()) continue;
    const auto& p = mesh.vert[i].cP();
    result.vertices.row(vertices) =
        placement *
        Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    indexOf[i] = vertices++;
  }
  int faces = 0;
  for (const auto& face : mesh.face) {
    if (face.IsD()) continue;
    for (int corner = 0; corner < 3; ++corner) {
      result.faces(faces, corner) = indexOf[vcg::tri::Index(mesh, face.cV(corner))];
    }
    ++faces;
  }
  if (mirrors(placement)) flip(result.faces);
  return result;
}

/// The rows of `fromVcg`'s faces that are selected, ascending.
template <class VcgMesh>
std::vector<int> selectedFaces(const VcgMesh& mesh) {
  std::vector<int> selected;
  int row = 0;
  for (const auto& face : mesh.face) {
    if (face.IsD()) continue;
    if (face.IsS()) selected.push_back(row);
    ++row;
  }
  return selected;
}

/// Coordinates that a mesh with that scalar and placement stores for points of the world.
template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Eigen::RowMajor> stored(const Points& world,
                                                                 const Placement& placement) {
  const Placement inverse = placement.inverse(Eigen::Affine);
  const Points local =
      (world * inverse.linear().transpose()).rowwise() + inverse.translation().transpose();
  return local.cast<Scalar>();
}

/// The points of the world that such a mesh can hold, nearest to `world`.
template <class Scalar>
Points representable(const Points& world, const Placement& placement) {
  const Points local = stored<Scalar>(world, placement).template cast<double>();
  Points result(local.rows(), 3);
  // Point by point as in fromVcg, so that reading the mesh gives these very numbers.
  for (Eigen::Index i = 0; i < local.rows(); ++i) {
    result.row(i) = placement * Vec3(local.row(i).transpose());
  }
  return result;
}

/// Appends `world` to the empty `mesh`; inverse of `fromVcg`.
template <class VcgMesh>
void toVcg(const TriangleMesh& world, const Placement& placement, VcgMesh& mesh) {
  using Scalar = typename VcgMesh::ScalarType;
  const auto vertices = stored<Scalar>(world.vertices, placement);
  Faces faces = world.faces;
  if (mirrors(placement)) flip(faces);

  auto vertex =
      vcg::tri::Allocator<VcgMesh>::AddVertices(mesh, static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index i = 0; i < vertices.rows(); ++i, ++vertex) {
    vertex->P() = typename VcgMesh::CoordType(vertices(i, 0), vertices(i, 1), vertices(i, 2));
  }
  auto face = vcg::tri::Allocator<VcgMesh>::AddFaces(mesh, static_cast<std::size_t>(faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f, ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      face->V(corner) = &mesh.vert[static_cast<std::size_t>(faces(f, corner))];
    }
  }
}

} // namespace massprops
