#include "core/solid.h"

#include "core/components.h"
#include "core/half_edges.h"
#include "core/moments.h"
#include "core/validity.h"

#include <cmath>
#include <string>
#include <vector>

namespace massprops {
namespace {

std::string count(std::size_t n, const std::string& singular, const std::string& plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
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
}

void requireClosedManifoldEdges(const TriangleMesh& mesh) {
  std::size_t boundary = 0;
  std::size_t nonManifold = 0;
  std::size_t incoherent = 0;
  for (const EdgeUse& use : edgeUses(mesh.vertices.rows(), mesh.faces)) {
    const int faces = use.forward + use.backward;
    if (faces == 1) ++boundary;
    if (faces > 2) ++nonManifold;
    if (faces == 2 && use.forward != use.backward) ++incoherent;
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
                       ": use Remeshing > Close Holes (Cleaning and Repairing > Merge Close "
                       "Vertices first, if parts only seem joined), then run again.");
  }
  if (incoherent > 0) {
    throw InvalidInput("The faces on the two sides of " + count(incoherent, "edge", "edges") +
                       " are oriented against each other: use Normals > Re-Orient all faces, "
                       "then run again.");
  }
}

void requireManifoldVertices(const TriangleMesh& mesh) {
  // Turning round a vertex from one face to the next must lead through all of its faces.
  const VertexCorners corners = vertexCorners(mesh.vertices.rows(), mesh.faces);
  const std::vector<int> opposite = oppositeHalfEdges(mesh.vertices.rows(), mesh.faces);
  std::size_t bad = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const IndexRange all = corners.at(v);
    if (all.size() == 0) continue;
    std::size_t turned = 0;
    int corner = *all.begin();
    do {
      ++turned;
      corner = opposite[static_cast<std::size_t>(previousHalfEdge(corner))];
    } while (corner != *all.begin() && turned <= all.size());
    if (turned != all.size()) ++bad;
  }
  if (bad > 0) {
    throw InvalidInput("The surface touches itself at " +
                       count(bad, "non-manifold vertex", "non-manifold vertices") +
                       ": use Cleaning and Repairing > Repair non Manifold Vertices by splitting, "
                       "then run again.");
  }
}

void requireNoSelfIntersection(const TriangleMesh& mesh) {
  const std::size_t crossing = selfIntersectingFaces(mesh.vertices, mesh.faces).size();
  if (crossing > 0) {
    throw InvalidInput("The surface crosses itself: " + count(crossing, "face", "faces") +
                       " intersect others. Use Selection > Select Self Intersecting Faces, delete "
                       "them and use Remeshing > Close Holes, then run again; parts that overlap "
                       "are joined by Mesh Boolean: Union.");
  }
}

/// Removing flat faces may bring parts together that only lay on each other.
RepairedMesh withoutFlatFaces(RepairedMesh mesh) {
  const int before = mesh.repairs.zeroAreaFaces;
  const Eigen::Index facesBefore = mesh.mesh.faces.rows();
  mesh = withoutZeroAreaFaces(std::move(mesh));
  const int removed = mesh.repairs.zeroAreaFaces - before;
  if (removed == 0 && mesh.mesh.faces.rows() == facesBefore) return mesh;
  try {
    requireClosedManifoldEdges(mesh.mesh);
    requireManifoldVertices(mesh.mesh);
  } catch (const InvalidInput&) {
    throw InvalidInput("The surface has " +
                       count(static_cast<std::size_t>(removed), "face", "faces") +
                       " without area that cannot be removed without making it non-manifold: use "
                       "Cleaning and Repairing > Remove T-Vertices by Edge Flip, then run again.");
  }
  return mesh;
}

double volumeOf(const Points& vertices, const Faces& faces) {
  const Eigen::RowVector3d near = vertices.row(faces(0, 0));
  return moments(vertices.rowwise() - near, faces)[0];
}

void turnRound(Faces& faces) {
  faces.col(1).swap(faces.col(2));
}

Faces stacked(const std::vector<Faces>& parts) {
  Eigen::Index rows = 0;
  for (const Faces& part : parts) rows += part.rows();
  Faces result(rows, 3);
  rows = 0;
  for (const Faces& part : parts) {
    result.middleRows(rows, part.rows()) = part;
    rows += part.rows();
  }
  return result;
}

} // namespace

Solid makeSolid(const TriangleMesh& input) {
  requireFiniteTriangles(input);
  RepairedMesh repaired = mergedAndCompacted(input);
  if (repaired.mesh.faces.rows() == 0) {
    throw InvalidInput("The layer has only faces without area: open a model that is a solid body.");
  }
  requireClosedManifoldEdges(repaired.mesh);
  requireManifoldVertices(repaired.mesh);
  repaired = withoutFlatFaces(std::move(repaired));
  const TriangleMesh& mesh = repaired.mesh;
  if (mesh.faces.rows() == 0) {
    throw InvalidInput("The surface encloses no volume: open a model that is a solid body.");
  }

  Solid solid;
  solid.repairs_ = repaired.repairs;
  const Eigen::RowVector3d extent =
      mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  solid.diagonal_ = extent.norm();
  const double roundOff = 1e-12 * std::pow(solid.diagonal_, 3);
  Components components = connectedComponents(mesh.vertices.rows(), mesh.faces);
  std::vector<double> volumes;
  for (const Faces& component : components) {
    volumes.push_back(volumeOf(mesh.vertices, component));
    if (!(std::abs(volumes.back()) > roundOff)) {
      throw InvalidInput("The surface, or a component of it, encloses no volume: use Cleaning and "
                         "Repairing > Remove Isolated pieces (wrt Diameter), or open a model that "
                         "is a solid body.");
    }
  }
  requireNoSelfIntersection(mesh);
  const std::vector<int> depths = nestingDepths(mesh.vertices, components);
  std::vector<Faces> bodies;
  std::vector<Faces> cavities;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (depths[c] > 1) {
      throw InvalidInput("A part of the model lies loose inside of a cavity of another one: remove "
                         "it (Mesh Layer > Split in Connected Components), then run again.");
    }
    const bool isCavity = depths[c] == 1;
    if ((volumes[c] < 0.0) != isCavity) {
      turnRound(components[c]);
      ++solid.repairs_.turnedComponents;
    }
    (isCavity ? cavities : bodies).push_back(components[c]);
  }
  solid.repairs_.replacedCavities = static_cast<int>(cavities.size());
  solid.mesh_ = submesh(mesh.vertices, stacked(bodies)).mesh;
  solid.cavities_ = submesh(mesh.vertices, stacked(cavities)).mesh;
  return solid;
}

} // namespace massprops
