#include "core/contour/cavity_contour.h"

#include "core/base/triangle.h"
#include "core/contour/projection.h"
#include "core/contour/shape_guard.h"
#include "core/contour/slivers.h"
#include "core/contour/wall_keeping.h"
#include "core/mesh/components.h"
#include "core/mesh/decimation.h"
#include "core/mesh/signed_volume.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/self_intersection.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr double kSliver = 8.0; // degrees; a target that leaves room to what follows

/// The volume up to which parts of a cavity are dust: less than that of a cube as wide as the
/// ball that opens it, or of one twice as wide, where all such parts are next to nothing.
double volumeOfDust(std::vector<double> volumes, double ball) {
  constexpr double kSmall = 8.0;     // balls' cubes
  constexpr double kNothing = 0.002; // of the cavity
  const double cube = std::pow(ball, 3);
  std::sort(volumes.begin(), volumes.end());
  double most = 0.0;
  for (const double volume : volumes) {
    if (volume >= cube) most += kNothing * volume;
  }
  double dust = cube;
  for (const double volume : volumes) {
    if (volume < cube) continue;
    most -= volume;
    if (most < 0.0 || volume > kSmall * cube) break;
    dust = volume;
  }
  return dust;
}

/// Without dust, and without material that would lie loose in the cavity.
Contour withoutLooseParts(const Contour& contour, double ball) {
  const Points& vertices = contour.mesh.vertices;
  std::vector<Faces> parts = connectedComponents(vertices.rows(), contour.mesh.faces);
  std::vector<double> volumes;
  volumes.reserve(parts.size());
  for (const Faces& part : parts) volumes.push_back(signedVolume(vertices, part));
  const double dust = volumeOfDust(volumes, ball);
  std::vector<Faces> kept;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (volumes[i] > dust) kept.push_back(std::move(parts[i]));
  }
  Submesh some = submesh(vertices, joined(kept));
  return partOf(contour, std::move(some.mesh), some.vertexOf);
}

Contour thinnedOut(Contour contour, double distance) {
  constexpr double kLeastAngle = 15.0;
  const Points& vertices = contour.mesh.vertices;
  DecimationTarget target{vertices.rows(), 0, distance, kLeastAngle};
  target.leastFactor = 1.0;
  DecimatedMesh fewer = decimated(vertices, std::move(contour.mesh.faces), target);
  return partOf(contour, std::move(fewer.mesh), fewer.vertexOf);
}

constexpr double kFlat = 0.002; // walls

/// No more triangles than are wanted, or as few as cost next to nothing.
Contour withFewTriangles(double wall, const ContourUse& use, Contour contour) {
  constexpr double kCheap = 0.003; // of the volume
  constexpr double kMost = 0.01;   // of the volume, and of what is possible
  constexpr double kStep = 1.5;
  constexpr int kSteps = 6;
  if (contour.mesh.faces.rows() <= kEnoughTriangles) return contour;
  const auto volumeOf = [](const Contour& some) {
    return signedVolume(some.mesh.vertices, some.mesh.faces);
  };
  const double volume = volumeOf(contour);
  const double area = surfaceArea(contour.mesh.vertices, contour.mesh.faces);
  const double loss = use.loss ? use.loss(contour) : 0.0;
  double share = kFlat;
  for (int step = 0; step < kSteps && contour.mesh.faces.rows() > kEnoughTriangles; ++step) {
    share *= kStep;
    // Afterwards what stands out by so much moves inwards, in the worst case everything.
    if (share * wall * area > kMost * volume) break;
    Contour fewer = thinnedOut(contour, share * wall);
    if (std::abs(volumeOf(fewer) - volume) > kCheap * volume) break;
    if (use.loss && use.loss(fewer) > loss + kMost) break;
    contour = std::move(fewer);
  }
  return contour;
}

/// Puts vertices back to where they were until no faces cross each other. \pre they did not there
void putBackCrossing(const Points& before, Contour& contour) {
  // What is put back may cross its neighbours: in sheets that goes on for long, so that these are
  // put back, too, more of them each time.
  constexpr int kOnesAlone = 2;
  TriangleMesh& mesh = contour.mesh;
  for (int round = 0;; ++round) {
    const std::vector<int> crossing = selfIntersectingFaces(mesh.vertices, mesh.faces);
    if (crossing.empty()) return;
    std::vector<char> goesBack(static_cast<std::size_t>(before.rows()), 0);
    const auto mark = [&](Eigen::Index f) {
      for (const int v : mesh.faces.row(f)) goesBack[static_cast<std::size_t>(v)] = 1;
    };
    for (const int f : crossing) mark(f);
    for (int ring = kOnesAlone; ring <= round; ++ring) {
      const std::vector<char> within = goesBack;
      for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto corners = mesh.faces.row(f);
        if (std::any_of(corners.begin(), corners.end(),
                        [&](int v) { return within[static_cast<std::size_t>(v)] != 0; }))
          mark(f);
      }
    }
    for (Eigen::Index v = 0; v < before.rows(); ++v) {
      if (goesBack[static_cast<std::size_t>(v)] != 0) mesh.vertices.row(v) = before.row(v);
    }
  }
}

/// Few triangles, none of them a sliver, on the border but for vertices that would have to cross
/// something on their way there.
Contour smoothed(const Region& region, double edge, const ContourUse& use, Contour contour) {
  {
    const Points raw = contour.mesh.vertices;
    project(region, edge, contour);
    putBackCrossing(raw, contour);
  }
  removeSlivers(kSliver, contour);
  contour = thinnedOut(std::move(contour), kFlat * region.wall);
  contour = withFewTriangles(region.wall, use, std::move(contour));
  removeSlivers(kSliver, contour);
  return contour;
}

/// To the middle of their neighbours in `from`.
void moveToMiddles(const std::vector<int>& some, const VertexAdjacency& neighbours,
                   const Points& from, Points& vertices) {
  for (const int v : some) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    const IndexRange around = neighbours[static_cast<std::size_t>(v)];
    for (const int w : around) sum += from.row(w);
    vertices.row(v) = sum / static_cast<double>(around.size());
  }
}

/// Moves the corners of faces that cross each other to the middle of their neighbours, where the
/// walls allow it, until none do; the faces that still do. Where few cross that is quicker by far
/// than to make the surface again.
std::vector<int> untangle(ClearanceQuery& clearance, double wall, TriangleMesh& mesh) {
  constexpr int kRounds = 4;
  std::vector<int> crossing = selfIntersectingFaces(mesh.vertices, mesh.faces);
  for (int round = 0; round < kRounds && !crossing.empty(); ++round) {
    const VertexAdjacency neighbours = vertexAdjacency(mesh.vertices.rows(), mesh.faces);
    const Points before = mesh.vertices;
    std::vector<int> corners;
    for (const int f : crossing) {
      for (const int v : mesh.faces.row(f)) corners.push_back(v);
    }
    moveToMiddles(corners, neighbours, before, mesh.vertices);
    if (!keepWall(clearance, wall, mesh.faces, mesh.vertices).empty()) {
      mesh.vertices = before;
      break;
    }
    crossing = selfIntersectingFaces(mesh.vertices, mesh.faces);
  }
  return crossing;
}

/// Vertices that stay too near to the surface, where they are few, go to the middle of their
/// neighbours, too. Those that even then are too near, which are left where they were.
std::vector<int> keepWallOrSmooth(TriangleMesh& mesh, ClearanceQuery& clearance, double wall) {
  constexpr int kRounds = 2;
  constexpr std::size_t kFew = 100;
  const Points unmoved = mesh.vertices;
  std::vector<int> thin = keepWall(clearance, wall, mesh.faces, mesh.vertices);
  for (int round = 0; round < kRounds && !thin.empty() && thin.size() < kFew; ++round) {
    const VertexAdjacency neighbours = vertexAdjacency(mesh.vertices.rows(), mesh.faces);
    const Points before = mesh.vertices;
    Points targets = before;
    moveToMiddles(thin, neighbours, before, targets);
    moveSoundly(targets, mesh.faces, mesh.vertices);
    std::vector<int> left = keepWall(clearance, wall, mesh.faces, mesh.vertices);
    if (left.size() >= thin.size()) {
      mesh.vertices = before;
      break;
    }
    thin = std::move(left);
  }
  for (const int v : thin) mesh.vertices.row(v) = unmoved.row(v);
  return thin;
}

/// Corners of triangles that come too near to the surface, and of those that cross each other.
struct Troubles {
  std::vector<Vec3> thin, crossing;

  bool areNone() const { return thin.empty() && crossing.empty(); }
};

Troubles troublesLeft(ClearanceQuery& clearance, double wall, Contour& contour) {
  TriangleMesh& mesh = contour.mesh;
  Troubles troubles;
  for (const int v : keepWallOrSmooth(mesh, clearance, wall))
    troubles.thin.emplace_back(mesh.vertices.row(v).transpose());
  if (!troubles.thin.empty()) return troubles;
  for (const int f : untangle(clearance, wall, mesh)) {
    for (const int v : mesh.faces.row(f))
      troubles.crossing.emplace_back(mesh.vertices.row(v).transpose());
  }
  return troubles;
}

} // namespace

std::optional<CavityContour> cavityContour(const OpenedSet& set,
                                           const std::optional<LayeredQuadric>& quadric,
                                           const ContourUse& use, const std::vector<Vec3>& solid) {
  ClearanceQuery fresh(set.surface);
  // Vertices on the border shall not count as too near for their last digits.
  constexpr double kMore = 3e-4;
  const Region region{set.surface,   (1.0 + kMore) * set.wall, set.opening, quadric, set.edge,
                      set.fill.get()};
  std::optional<BorderLattice> lattice;
  // What the cubes are too large for becomes solid, too.
  std::vector<std::vector<Vec3>> takenOut{solid};
  constexpr int kRounds = 9;
  for (int round = 0; round < kRounds; ++round) {
    if (!lattice) {
      lattice = borderLattice(region, set.edge);
      for (const std::vector<Vec3>& points : takenOut) takeOut(points, *lattice);
    }
    Contour raw = dualContour(*lattice);
    // A large one takes as much memory as all that follows, and is seldom needed again.
    constexpr std::size_t kLarge = 200000; // corners
    if (lattice->corners.size() > kLarge) lattice.reset();
    raw = withoutLooseParts(raw, set.ball);
    if (raw.mesh.faces.rows() == 0) return CavityContour{{}, set.edge, fresh};
    Contour contour = smoothed(region, set.edge, use, std::move(raw));
    ClearanceQuery clearance(set.surface);
    keepWallNearly(clearance, set.wall, contour.mesh.faces, contour.mesh.vertices);
    if (use.isWorthIt && !use.isWorthIt(contour))
      return CavityContour{std::move(contour), set.edge, std::move(clearance), false};
    const Troubles troubles = troublesLeft(clearance, set.wall, contour);
    if (troubles.areNone())
      return CavityContour{std::move(contour), set.edge, std::move(clearance)};
    for (const std::vector<Vec3>& points : {troubles.thin, troubles.crossing}) {
      if (lattice) takeOut(points, *lattice);
      takenOut.push_back(points);
    }
  }
  return {};
}

} // namespace massprops
