#include "core/solid.h"

#include "core/moments.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

namespace massprops {
namespace {

std::string count(std::size_t n, const std::string& singular, const std::string& plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

std::uint64_t edgeKey(int from, int to) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32U) |
         static_cast<std::uint32_t>(to);
}

struct EdgeUse {
  int forward = 0;  ///< faces that run along the edge from the smaller to the larger index
  int backward = 0; ///< faces that run the other way
};

class DisjointSets {
public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }

private:
  std::vector<std::size_t> parent_;
};

/// Leaves out vertices that no face uses.
TriangleMesh compacted(const TriangleMesh& mesh) {
  std::vector<int> newIndex(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  for (Eigen::Index f = 0; f < mesh.faces.size(); ++f) {
    newIndex[static_cast<std::size_t>(mesh.faces.data()[f])] = 0;
  }
  int next = 0;
  for (int& index : newIndex) {
    if (index == 0) index = next++;
  }
  TriangleMesh result;
  result.vertices.resize(next, 3);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const int index = newIndex[static_cast<std::size_t>(v)];
    if (index >= 0) result.vertices.row(index) = mesh.vertices.row(v);
  }
  result.faces = mesh.faces.unaryExpr([&](int v) { return newIndex[static_cast<std::size_t>(v)]; });
  return result;
}

bool hasCoincidentVertices(const Points& vertices) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(vertices.rows()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto key = [&](Eigen::Index v) {
    return std::array<double, 3>{vertices(v, 0), vertices(v, 1), vertices(v, 2)};
  };
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return key(a) < key(b); });
  return std::adjacent_find(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
           return key(a) == key(b);
         }) != order.end();
}

void requireFiniteTriangles(const TriangleMesh& mesh) {
  if (mesh.faces.rows() == 0) {
    throw InvalidInput(mesh.vertices.rows() == 0
                           ? "The layer is empty: open a model with faces, then run again."
                           : "The layer has points but no faces: use Remeshing > Surface "
                             "Reconstruction: Screened Poisson to make a closed surface, then run "
                             "again.");
  }
  if (!mesh.vertices.allFinite()) {
    throw InvalidInput("The layer has vertices whose coordinates are not finite numbers: use "
                       "Cleaning and Repairing > Remove Vertices wrt Quality or select and delete "
                       "them, then run again.");
  }
  if (mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows()) {
    throw InvalidInput("The layer has faces that refer to vertices which do not exist: save and "
                       "open it again, then run again.");
  }
  std::size_t degenerate = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const int a = mesh.faces(f, 0);
    const int b = mesh.faces(f, 1);
    const int c = mesh.faces(f, 2);
    if (a == b || b == c || c == a) ++degenerate;
  }
  if (degenerate > 0) {
    throw InvalidInput("The layer has " + count(degenerate, "face that uses", "faces that use") +
                       " a vertex twice: use Cleaning and Repairing > Remove Zero Area Faces, "
                       "then run again.");
  }
}

void requireClosedManifoldEdges(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, EdgeUse> edges;
  edges.reserve(static_cast<std::size_t>(3 * mesh.faces.rows() / 2 + 1));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.faces(f, k);
      const int to = mesh.faces(f, (k + 1) % 3);
      EdgeUse& use = edges[edgeKey(std::min(from, to), std::max(from, to))];
      ++(from < to ? use.forward : use.backward);
    }
  }
  std::size_t boundary = 0;
  std::size_t nonManifold = 0;
  std::size_t incoherent = 0;
  for (const auto& [key, use] : edges) {
    const int faces = use.forward + use.backward;
    if (faces == 1) ++boundary;
    if (faces > 2) ++nonManifold;
    if (faces == 2 && use.forward != use.backward) ++incoherent;
  }
  if (boundary > 0 && hasCoincidentVertices(mesh.vertices)) {
    throw InvalidInput("The surface is open along " +
                       count(boundary, "boundary edge", "boundary edges") +
                       ", and vertices lie on top of each other: use Cleaning and Repairing > "
                       "Merge Close Vertices (and Close Holes if that is not enough), then run "
                       "again.");
  }
  if (nonManifold > 0) {
    throw InvalidInput("The surface has " +
                       count(nonManifold, "non-manifold edge", "non-manifold edges") +
                       " where more than two faces meet: use Cleaning and Repairing > Repair non "
                       "Manifold Edges, then run again.");
  }
  if (boundary > 0) {
    throw InvalidInput("The surface is open along " +
                       count(boundary, "boundary edge", "boundary edges") +
                       ": use Remeshing > Close Holes, then run again.");
  }
  if (incoherent > 0) {
    throw InvalidInput("The faces on the two sides of " + count(incoherent, "edge", "edges") +
                       " are oriented against each other: use Normals > Re-Orient all faces "
                       "coherentely, then run again.");
  }
}

void requireManifoldVertices(const TriangleMesh& mesh) {
  // The faces around a vertex form one fan exactly if they are joined through shared edges. With
  // every directed edge used once, the face after the one with corner v and edge v→to is the face
  // with the edge to→v.
  std::unordered_map<std::uint64_t, std::size_t> cornerWithOutgoing;
  cornerWithOutgoing.reserve(static_cast<std::size_t>(3 * mesh.faces.rows()));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      cornerWithOutgoing[edgeKey(mesh.faces(f, k), mesh.faces(f, (k + 1) % 3))] =
          static_cast<std::size_t>(3 * f + k);
    }
  }
  DisjointSets fans(static_cast<std::size_t>(3 * mesh.faces.rows()));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.faces(f, k);
      const int incoming = mesh.faces(f, (k + 2) % 3);
      fans.unite(static_cast<std::size_t>(3 * f + k), cornerWithOutgoing.at(edgeKey(v, incoming)));
    }
  }
  std::vector<int> fansAt(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  for (std::size_t corner = 0; corner < static_cast<std::size_t>(mesh.faces.size()); ++corner) {
    if (fans.find(corner) == corner) ++fansAt[static_cast<std::size_t>(mesh.faces.data()[corner])];
  }
  const auto bad = static_cast<std::size_t>(
      std::count_if(fansAt.begin(), fansAt.end(), [](int n) { return n > 1; }));
  if (bad > 0) {
    throw InvalidInput("The surface touches itself at " +
                       count(bad, "non-manifold vertex", "non-manifold vertices") +
                       ": use Cleaning and Repairing > Repair non Manifold Vertices by splitting, "
                       "then run again.");
  }
}

void requireOneComponent(const TriangleMesh& mesh) {
  DisjointSets components(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 1; k < 3; ++k) {
      components.unite(static_cast<std::size_t>(mesh.faces(f, 0)),
                       static_cast<std::size_t>(mesh.faces(f, k)));
    }
  }
  std::size_t roots = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(mesh.vertices.rows()); ++v) {
    if (components.find(v) == v) ++roots;
  }
  if (roots > 1) {
    throw InvalidInput("The layer has " + std::to_string(roots) +
                       " separate components: keep one of them (Mesh Layer > Split in Connected "
                       "Components, or Cleaning and Repairing > Remove Isolated pieces (wrt "
                       "Diameter)), or join them (Mesh Boolean: Union), then run again.");
  }
}

} // namespace

Solid makeSolid(const TriangleMesh& mesh) {
  requireFiniteTriangles(mesh);
  Solid solid;
  solid.mesh_ = compacted(mesh);
  requireClosedManifoldEdges(solid.mesh_);
  requireManifoldVertices(solid.mesh_);
  requireOneComponent(solid.mesh_);

  const Eigen::RowVector3d low = solid.mesh_.vertices.colwise().minCoeff();
  const Eigen::RowVector3d high = solid.mesh_.vertices.colwise().maxCoeff();
  solid.diagonal_ = (high - low).norm();
  const Points centred = solid.mesh_.vertices.rowwise() - 0.5 * (low + high);
  const double volume = moments(centred, solid.mesh_.faces)[0];
  const double roundOff = 1e-12 * solid.diagonal_ * solid.diagonal_ * solid.diagonal_;
  if (!(std::abs(volume) > roundOff)) {
    throw InvalidInput("The surface encloses no volume: use a model that is a solid body.");
  }
  if (volume < 0.0) {
    solid.inverted_ = true;
    solid.mesh_.faces.col(1).swap(solid.mesh_.faces.col(2));
  }
  return solid;
}

} // namespace massprops
