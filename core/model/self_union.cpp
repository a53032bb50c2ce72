#include "core/model/self_union.h"

#include "core/base/triangle.h"
#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/model/manifold_split.h"
#include "core/query/self_intersection.h"
#include "core/query/triangle_tree.h"
#include "core/query/winding_number.h"

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// More are a soup, and take long.
constexpr std::size_t kMostCrossings = 40000;

/// Whether two of these faces lie in one plane, near each other, without a common edge: the
/// refinement does not survive that.
bool hasCoplanarFaces(const TriangleMesh& mesh, const std::vector<int>& crossing) {
  Faces faces(static_cast<Eigen::Index>(crossing.size()), 3);
  for (std::size_t i = 0; i < crossing.size(); ++i) {
    faces.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(crossing[i]);
  }
  const TriangleTree tree(mesh.vertices, faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  const auto exact = [&](int v) {
    return SurfaceKernel::Point_3(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2));
  };
  bool found = false;
  for (Eigen::Index f = 0; f < faces.rows() && !found; ++f) {
    Eigen::AlignedBox3d box;
    for (const int v : faces.row(f)) box.extend(Vec3(mesh.vertices.row(v).transpose()));
    tree.forOverlaps(box.min(), box.max(), 0, [&](Eigen::Index i) {
      const int g = tree.faceAt(i);
      if (g == f || found) return;
      int shared = 0;
      bool isCoplanar = true;
      for (const int v : faces.row(g)) {
        const bool isCommon = (faces.row(f).array() == v).any();
        shared += isCommon ? 1 : 0;
        isCoplanar =
            isCoplanar && (isCommon || CGAL::coplanar(exact(faces(f, 0)), exact(faces(f, 1)),
                                                      exact(faces(f, 2)), exact(v)));
      }
      found = isCoplanar && shared < 2;
    });
  }
  return found;
}

/// Bodies that face inwards and cross others are turned over.
TriangleMesh outward(const TriangleMesh& mesh, const std::vector<int>& crossing) {
  TriangleMesh result = mesh;
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), mesh.faces);
  const Components components = connectedComponents(mesh.vertices.rows(), mesh.faces);
  std::vector<char> turns(components.size(), 0);
  for (const int f : crossing) turns[at(number[at(mesh.faces(f, 0))])] = 1;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (turns[c] != 0 && signedVolume(mesh.vertices, components[c]) >= 0.0) turns[c] = 0;
  }
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (turns[at(number[at(mesh.faces(f, 0))])] != 0) {
      std::swap(result.faces(f, 1), result.faces(f, 2));
    }
  }
  return result;
}

/// Cut along all crossings, equal points merged; empty where that fails.
TriangleMesh refined(const TriangleMesh& mesh) {
  auto surface = surfaceMesh(mesh.vertices, mesh.faces);
  try {
    CGAL::Polygon_mesh_processing::experimental::autorefine(surface);
  } catch (const std::exception&) {
    return {};
  }
  surface.collect_garbage();
  TriangleMesh result = triangleMesh(surface);
  std::map<std::array<double, 3>, int> first;
  std::vector<int> becomes;
  for (Eigen::Index v = 0; v < result.vertices.rows(); ++v) {
    const std::array<double, 3> place{result.vertices(v, 0), result.vertices(v, 1),
                                      result.vertices(v, 2)};
    becomes.push_back(first.emplace(place, static_cast<int>(v)).first->second);
  }
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < result.faces.rows(); ++f) {
    const int a = becomes[at(result.faces(f, 0))];
    const int b = becomes[at(result.faces(f, 1))];
    const int c = becomes[at(result.faces(f, 2))];
    if (a != b && b != c && c != a) result.faces.row(rows++) << a, b, c;
  }
  result.faces.conservativeResize(rows, 3);
  return result;
}

/// Faces that are connected across edges of two faces, which agree in orientation.
std::vector<std::vector<int>> patchesOf(const Faces& faces) {
  std::vector<std::array<int, 4>> sides; // edge, face, direction
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(f, k);
      const int b = faces(f, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b ? 1 : 0});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::vector<int>> next(at(faces.rows()));
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end][0] == sides[i][0] && sides[end][1] == sides[i][1])
      ++end;
    if (end - i == 2 && sides[i][3] != sides[i + 1][3]) {
      next[at(sides[i][2])].push_back(sides[i + 1][2]);
      next[at(sides[i + 1][2])].push_back(sides[i][2]);
    }
    i = end;
  }
  std::vector<std::vector<int>> patches;
  std::vector<char> isKnown(at(faces.rows()), 0);
  for (Eigen::Index seed = 0; seed < faces.rows(); ++seed) {
    if (isKnown[at(seed)] != 0) continue;
    std::vector<int> patch{static_cast<int>(seed)};
    isKnown[at(seed)] = 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int g : next[at(patch[i])]) {
        if (isKnown[at(g)] != 0) continue;
        isKnown[at(g)] = 1;
        patch.push_back(g);
      }
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

/// Whether the material ends at the patch: told in the middle of its roundest large face.
bool isBoundary(const TriangleMesh& mesh, const std::vector<int>& patch,
                const WindingNumber& winding) {
  double widest = -1.0;
  int best = patch.front();
  for (const int f : patch) {
    const double twiceArea = areaNormal(mesh.vertices, mesh.faces, f).norm();
    double edges = 0.0;
    for (int k = 0; k < 3; ++k) {
      edges += (mesh.vertices.row(mesh.faces(f, k)) - mesh.vertices.row(mesh.faces(f, (k + 1) % 3)))
                   .norm();
    }
    const double inradius = edges > 0.0 ? twiceArea / edges : 0.0;
    if (inradius > widest) {
      widest = inradius;
      best = f;
    }
  }
  const Vec3 normal = areaNormal(mesh.vertices, mesh.faces, best).stableNormalized();
  Vec3 middle = Vec3::Zero();
  for (const int v : mesh.faces.row(best)) middle += mesh.vertices.row(v).transpose() / 3.0;
  constexpr double kBeside = 0.01;
  return winding.at(middle + kBeside * widest * normal) < 0.5 &&
         winding.at(middle - kBeside * widest * normal) >= 0.5;
}

} // namespace

MendedMesh selfUnited(const TriangleMesh& input, const MendingTask& task) {
  const EdgeCounts edges = countEdges(input.vertices.rows(), input.faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return {input};
  const std::vector<int> crossing = selfIntersectingFaces(input.vertices, input.faces);
  if (crossing.empty() || crossing.size() > kMostCrossings) return {input};
  if (hasCoplanarFaces(input, crossing)) return {input};
  const TriangleMesh bodies = outward(input, crossing);
  const TriangleMesh pieces = refined(bodies);
  const WindingNumber winding(bodies.vertices, bodies.faces);
  Faces kept(pieces.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (const std::vector<int>& patch : patchesOf(pieces.faces)) {
    if (!isBoundary(pieces, patch, winding)) continue;
    for (const int f : patch) kept.row(rows++) = pieces.faces.row(f);
  }
  if (rows == 0) return {input};
  MendedMesh result = splitToManifold(submesh(pieces.vertices, kept.topRows(rows)).mesh, task);
  const EdgeCounts left = countEdges(result.mesh.vertices.rows(), result.mesh.faces);
  if (left.boundary + left.nonManifold + left.incoherent > 0) return {input};
  result.done = counted(crossing.size(), "crossing face", "crossing faces") + " united";
  return result;
}

} // namespace massprops
