#include "core/model/open_surface.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"

#include <algorithm>

namespace massprops {
namespace {

/// Cosine of the angle between a level strip and the skin's normals up to which it is a strip
/// across the wall and not along it.
constexpr double kSteep = 0.7;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

template <class Predicate>
Faces rowsWhere(const Faces& faces, const Predicate& holds) {
  Faces kept(faces.rows(), 3);
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (holds(faces.row(f))) kept.row(row++) = faces.row(f);
  }
  return kept.topRows(row);
}

} // namespace

OpenSurface openSurface(Eigen::Index vertexCount, const Faces& faces,
                        const std::vector<char>& isLid) {
  const std::vector<int> opposite = oppositeHalfEdges(vertexCount, faces);
  const int n = static_cast<int>(vertexCount);
  const auto lids = static_cast<Eigen::Index>(std::count(isLid.begin(), isLid.end(), 1));
  OpenSurface open;
  open.skin.resize(faces.rows() - lids, 3);
  std::vector<Eigen::RowVector3i> strips;
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (isLid[at(f)] != 0) continue;
    open.skin.row(row++) = faces.row(f);
    for (int k = 0; k < 3; ++k) {
      if (isLid[at(opposite[at(3 * f + k)] / 3)] == 0) continue;
      // Against the skin's edge i → j and the lid's edge j + n → i + n.
      const int i = faces(f, k);
      const int j = faces(f, (k + 1) % 3);
      strips.emplace_back(j, i, i + n);
      strips.emplace_back(j, i + n, j + n);
      open.rim.push_back(i);
    }
  }
  std::sort(open.rim.begin(), open.rim.end());
  Faces lidFaces(lids, 3);
  row = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (isLid[at(f)] != 0) lidFaces.row(row++) = faces.row(f);
  }
  open.openings = static_cast<int>(connectedComponents(vertexCount, lidFaces).size());
  open.cavity.resize(faces.rows() + static_cast<Eigen::Index>(strips.size()), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    open.cavity.row(f) = faces.row(f).array() + (isLid[at(f)] != 0 ? n : 0);
  }
  for (std::size_t s = 0; s < strips.size(); ++s) {
    open.cavity.row(faces.rows() + static_cast<Eigen::Index>(s)) = strips[s];
  }
  return open;
}

Faces withoutStrips(const Faces& cavity, Eigen::Index vertexCount) {
  return rowsWhere(cavity, [&](const auto& face) { return face.maxCoeff() < vertexCount; });
}

Faces withoutLids(const Faces& cavity, Eigen::Index vertexCount) {
  return rowsWhere(cavity, [&](const auto& face) { return face.minCoeff() < vertexCount; });
}

Faces shellOf(const Faces& skin, const Faces& cavity, Eigen::Index vertexCount) {
  Faces inner = withoutLids(cavity, vertexCount);
  flip(inner);
  Faces shell(skin.rows() + inner.rows(), 3);
  shell << skin.array() + static_cast<int>(vertexCount), inner;
  return shell;
}

Points stacked(const Points& inner, const Points& outer) {
  Points both(inner.rows() + outer.rows(), 3);
  both << inner, outer;
  return both;
}

Points levelAtRim(const Points& vertices, const Faces& faces, const std::vector<char>& isLid,
                  const OpenSurface& open, Points axis) {
  const VertexCorners corners = vertexCorners(vertices.rows(), faces);
  const auto normal = [&](Eigen::Index f) { return areaNormal(vertices, faces, f); };
  for (const int v : open.rim) {
    Vec3 up = Vec3::Zero();
    for (const int corner : corners.at(v)) {
      if (isLid[at(corner / 3)] != 0) up += normal(corner / 3);
    }
    up.stableNormalize();
    const Vec3 outward = (vertices.row(v) - axis.row(v)).transpose();
    const Vec3 level = outward - outward.dot(up) * up;
    const IndexRange around = corners.at(v);
    const bool isSteep = std::all_of(around.begin(), around.end(), [&](int corner) {
      const Vec3 n = normal(corner / 3);
      return isLid[at(corner / 3)] != 0 || n.dot(level) > kSteep * n.norm() * level.norm();
    });
    if (isSteep) axis.row(v) = vertices.row(v) - level.transpose();
  }
  return axis;
}

} // namespace massprops
