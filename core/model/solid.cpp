#include "core/model/solid.h"

#include "core/base/interruption.h"
#include "core/base/parallel.h"
#include "core/base/tolerances.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"
#include "core/mesh/hole_filling.h"
#include "core/mesh/signed_volume.h"
#include "core/model/frame.h"
#include "core/query/nesting.h"
#include "core/query/self_intersection.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
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

/// Returns the number of boundary edges, of which there may be some where openings are allowed.
std::size_t requireManifoldEdges(const TriangleMesh& mesh, bool mayBeOpen) {
  const auto [boundary, nonManifold, incoherent] = countEdges(mesh.vertices.rows(), mesh.faces);
  if (nonManifold > 0) {
    throw DefectiveSurface(
        "The surface has " + count(nonManifold, "non-manifold edge", "non-manifold edges") +
        " where more than two faces meet: use Cleaning and Repairing > Repair non "
        "Manifold Edges, then run again.");
  }
  if (boundary > 0 && !mayBeOpen) {
    throw DefectiveSurface(
        "The surface is open along " + count(boundary, "boundary edge", "boundary edges") +
        ": use Remeshing > Close Holes (Cleaning and Repairing > Merge Close "
        "Vertices first, if parts only seem joined), or switch open_surface on if "
        "it is to become a shell with these openings, then run again.");
  }
  if (incoherent > 0) {
    throw DefectiveSurface("The faces on the two sides of " + count(incoherent, "edge", "edges") +
                           " are oriented against each other: use Normals > Re-Orient all faces, "
                           "then run again.");
  }
  return boundary;
}

void requireManifoldVertices(const TriangleMesh& mesh) {
  // Going round a vertex from one face to the next, from a boundary if there is one, must lead
  // through all of its faces.
  const VertexCorners corners = vertexCorners(mesh.vertices.rows(), mesh.faces);
  const std::vector<int> opposite = oppositeHalfEdges(corners, mesh.faces);
  std::atomic<std::size_t> bad = 0;
  constexpr Eigen::Index kChunk = 4096;
  forChunks(mesh.vertices.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const IndexRange all = corners.at(v);
      if (all.size() == 0) continue;
      const int* const boundary = std::find_if(all.begin(), all.end(), [&](int corner) {
        return opposite[static_cast<std::size_t>(corner)] < 0;
      });
      const int first = boundary != all.end() ? *boundary : *all.begin();
      std::size_t turned = 0;
      int corner = first;
      do {
        ++turned;
        corner = opposite[static_cast<std::size_t>(previousHalfEdge(corner))];
      } while (corner >= 0 && corner != first && turned <= all.size());
      if (turned != all.size()) ++bad;
    }
  });
  if (bad > 0) {
    throw DefectiveSurface(
        "The surface touches itself at " +
        count(bad, "non-manifold vertex", "non-manifold vertices") +
        ": use Cleaning and Repairing > Repair non Manifold Vertices by splitting, "
        "then run again.");
  }
}

std::vector<int> orderInSpace(const Points& vertices, const Faces& faces, const Mat3& rotation,
                              double diagonal) {
  Points turned = vertices * rotation.transpose();
  const Eigen::RowVector3d corner = turned.colwise().minCoeff();
  turned = (turned.rowwise() - corner) / diagonal; // in place: large models have many points
  return spatialOrder(snapped(std::move(turned)), faces);
}

/// Ascending.
std::vector<int> crossingFacesOf(const Points& vertices, const Faces& faces,
                                 const std::vector<int>& spatialFaceOrder) {
  return selfIntersectingFaces(
      TriangleTree(vertices, faces, spatialFaceOrder, TriangleTree::Queries::NoDistances));
}

/// `skinFaces`: those before the lids.
void requireNone(const std::vector<int>& crossingFaces, Eigen::Index skinFaces) {
  const std::size_t crossing = crossingFaces.size();
  if (crossing > 0 && crossingFaces.back() >= skinFaces) {
    throw DefectiveSurface(
        "A lid that closes an opening of the surface, which open_surface needs for "
        "its own calculations, crosses the surface: close the opening with Remeshing > "
        "Close Holes, or cut the model where its openings are flat, then run again.");
  }
  if (crossing > 0) {
    throw DefectiveSurface(
        "The surface crosses itself: " + count(crossing, "face", "faces") +
        " intersect others. Use Selection > Select Self Intersecting Faces, delete "
        "them and use Remeshing > Close Holes, then run again; parts that overlap "
        "are joined by Mesh Boolean: Union (CSG Operation in MeshLab 2020.09).");
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
    requireManifoldEdges(mesh.mesh, false);
    requireManifoldVertices(mesh.mesh);
  } catch (const DefectiveSurface&) {
    throw DefectiveSurface(
        "The surface has " + count(static_cast<std::size_t>(removed), "face", "faces") +
        " without area that cannot be removed without making it non-manifold: use "
        "Cleaning and Repairing > Remove T-Vertices by Edge Flip, then run again.");
  }
  return mesh;
}

/// Removing them as on a closed surface would move the openings.
void requireNoFlatFaces(const TriangleMesh& open) {
  const std::size_t flat = facesWithoutArea(open.vertices, open.faces).size();
  if (flat == 0) return;
  throw DefectiveSurface(
      "The open surface has " + count(flat, "face", "faces") +
      " without area: use Cleaning and Repairing > Remove T-Vertices by Edge Flip, "
      "then run again.");
}

/// For every face of the part whether it is one of the lids, whose corners are numbered as in the
/// whole mesh.
std::vector<char> marksOf(const Submesh& part, const Faces& lids) {
  const auto corners = [](int a, int b, int c) {
    std::array<int, 3> sorted{a, b, c};
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  std::vector<std::array<int, 3>> known;
  for (Eigen::Index f = 0; f < lids.rows(); ++f) {
    known.push_back(corners(lids(f, 0), lids(f, 1), lids(f, 2)));
  }
  std::sort(known.begin(), known.end());
  std::vector<char> marks;
  for (Eigen::Index f = 0; f < part.mesh.faces.rows(); ++f) {
    const auto whole = [&](int k) {
      return part.vertexOf[static_cast<std::size_t>(part.mesh.faces(f, k))];
    };
    const bool isLid =
        std::binary_search(known.begin(), known.end(), corners(whole(0), whole(1), whole(2)));
    marks.push_back(isLid ? 1 : 0);
  }
  return marks;
}

/// The input, mended and closed.
struct ClosedSurface {
  RepairedMesh repaired;
  Eigen::Index skinFaces; ///< those before the lids
  bool hasLids;
};

ClosedSurface closedSurface(TriangleMesh input, bool closeOpenings) {
  RepairedMesh repaired = mergedAndCompacted(std::move(input));
  if (repaired.mesh.faces.rows() == 0) {
    throw InvalidInput("The layer has only faces without area: open a model that is a solid body.");
  }
  const std::size_t boundary = requireManifoldEdges(repaired.mesh, closeOpenings);
  requireManifoldVertices(repaired.mesh);
  if (boundary > 0) {
    requireNoFlatFaces(repaired.mesh);
    const Eigen::Index skinFaces = repaired.mesh.faces.rows();
    repaired.mesh = withOpeningsFilled(repaired.mesh);
    return {std::move(repaired), skinFaces, true};
  }
  repaired = withoutFlatFaces(std::move(repaired));
  const Eigen::Index skinFaces = repaired.mesh.faces.rows();
  if (skinFaces == 0) {
    throw DefectiveSurface("The surface encloses no volume: open a model that is a solid body.");
  }
  return {std::move(repaired), skinFaces, false};
}

std::vector<double> requireVolumes(const Points& vertices, const Components& components,
                                   double diagonal) {
  const double least = kLeastVolume * std::pow(diagonal, 3);
  std::vector<double> volumes;
  for (const Faces& component : components) {
    volumes.push_back(signedVolume(vertices, component));
    if (!(std::abs(volumes.back()) > least)) {
      throw DefectiveSurface(
          "The surface, or a component of it, encloses no volume: use Cleaning and "
          "Repairing > Remove Isolated pieces (wrt Diameter), or open a model that "
          "is a solid body.");
    }
  }
  return volumes;
}

/// Faces of bodies, outward, and of the cavities in them, oriented into them.
struct NestedParts {
  std::vector<Faces> bodies, cavities;
  int flipped = 0; ///< that faced the wrong way
};

NestedParts nestedParts(const Points& vertices, Components components,
                        const std::vector<double>& volumes, bool hasLids) {
  const std::vector<int> depths = nestingDepths(vertices, components);
  NestedParts parts;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (depths[c] > 1) {
      throw DefectiveSurface(
          "A part of the model lies loose inside of a cavity of another one: remove "
          "it (Mesh Layer > Split in Connected Components), then run again.");
    }
    const bool isCavity = depths[c] == 1;
    if (isCavity && hasLids) {
      throw InvalidInput("A part of the open surface lies inside of another one: remove it (Mesh "
                         "Layer > Split in Connected Components), then run again.");
    }
    if ((volumes[c] < 0.0) != isCavity) {
      flip(components[c]);
      ++parts.flipped;
    }
    (isCavity ? parts.cavities : parts.bodies).push_back(std::move(components[c]));
  }
  return parts;
}

} // namespace

Faces Solid::skin() const {
  if (isLid_.empty()) return faces();
  Faces skin(faces().rows(), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < skin.rows(); ++f) {
    if (isLid_[static_cast<std::size_t>(f)] == 0) skin.row(kept++) = faces().row(f);
  }
  return skin.topRows(kept);
}

std::vector<int> Solid::rim() const {
  constexpr char kOfSkin = 1;
  constexpr char kOfLid = 2;
  std::vector<int> rim;
  if (isLid_.empty()) return rim;
  std::vector<char> uses(static_cast<std::size_t>(vertices().rows()), 0);
  for (Eigen::Index f = 0; f < faces().rows(); ++f) {
    const char use = isLid_[static_cast<std::size_t>(f)] != 0 ? kOfLid : kOfSkin;
    for (const int v : faces().row(f)) uses[static_cast<std::size_t>(v)] |= use;
  }
  for (std::size_t v = 0; v < uses.size(); ++v) {
    if (uses[v] == (kOfSkin | kOfLid)) rim.push_back(static_cast<int>(v));
  }
  return rim;
}

Solid makeSolid(TriangleMesh input, bool closeOpenings, const Mat3& rotation,
                const Repairs& before) {
  requireFiniteTriangles(input);
  ClosedSurface surface = closedSurface(std::move(input), closeOpenings);
  TriangleMesh& mesh = surface.repaired.mesh;
  const Points& x = mesh.vertices;
  checkpoint();
  Solid solid;
  solid.diagonal_ = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
  Components components;
  std::vector<int> order;
  inParallel([&] { components = connectedComponents(x.rows(), mesh.faces); },
             [&] { order = orderInSpace(x, mesh.faces, rotation, solid.diagonal_); });
  checkpoint();
  const bool isOne = components.size() == 1;
  const std::vector<double> volumes = requireVolumes(x, components, solid.diagonal_);
  // Which component is inside of which one is known only where they do not cross.
  solid.mayCross_ = !surface.hasLids && isOne;
  if (!solid.mayCross_) requireNone(crossingFacesOf(x, mesh.faces, order), surface.skinFaces);

  NestedParts parts = nestedParts(x, std::move(components), volumes, surface.hasLids);
  if (isOne && !surface.hasLids) {
    solid.mesh_ = {std::move(mesh.vertices), std::move(parts.bodies.front())};
    solid.spatialFaceOrder_ = std::move(order);
  } else {
    Submesh body = submesh(x, joined(parts.bodies));
    solid.cavities_ = submesh(x, joined(parts.cavities)).mesh;
    if (surface.hasLids) {
      solid.isLid_ = marksOf(body, mesh.faces.bottomRows(mesh.faces.rows() - surface.skinFaces));
    }
    solid.mesh_ = std::move(body.mesh);
    // Of several components the faces were renumbered, and cavities must not show.
    solid.spatialFaceOrder_ =
        isOne ? std::move(order)
              : orderInSpace(solid.mesh_.vertices, solid.mesh_.faces, rotation, solid.diagonal_);
  }
  solid.repairs_ = surface.repaired.repairs;
  solid.repairs_ += before;
  solid.repairs_.flippedComponents += parts.flipped;
  solid.repairs_.replacedCavities += static_cast<int>(parts.cavities.size());
  return solid;
}

void requireNoCrossings(const Solid& solid) {
  if (!solid.mayCross_) return;
  requireNone(crossingFacesOf(solid.vertices(), solid.faces(), solid.spatialFaceOrder_),
              solid.faces().rows());
}

void requireNoCrossings(const Solid& solid, const TriangleTree& posed, double apart) {
  if (!solid.mayCross_) return;
  requireNone(selfIntersectingFaces(solid.vertices(), solid.faces(), posed,
                                    {solid.spatialFaceOrder_, apart}),
              solid.faces().rows());
}

Solid withoutCrossings(Solid solid) {
  requireNoCrossings(solid);
  solid.mayCross_ = false;
  return solid;
}

} // namespace massprops
