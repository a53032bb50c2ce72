#include "core/model/united_bodies.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/patches.h"
#include "core/mesh/signed_volume.h"
#include "core/model/crossing_refinement.h"
#include "core/model/manifold_split.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/triangle_tree.h"
#include "core/query/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// Whether as many faces run along every edge as against it.
bool isBalanced(const Faces& faces) {
  std::vector<std::array<int, 3>> sides;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(f, k);
      const int b = faces(f, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size();) {
    int sum = 0;
    std::size_t end = i;
    for (; end < sides.size() && sides[end][0] == sides[i][0] && sides[end][1] == sides[i][1];
         ++end) {
      sum += sides[end][2];
    }
    if (sum != 0) return false;
    i = end;
  }
  return true;
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

/// Whether the material ends at a patch, and whether that is certain.
struct PatchSide {
  bool isBoundary, isCertain;
};

/// Told in the middle of the patch's roundest large face.
PatchSide sideOf(const TriangleMesh& mesh, const std::vector<int>& patch,
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
  const double before = winding.at(middle + kBeside * widest * normal);
  const double behind = winding.at(middle - kBeside * widest * normal);
  constexpr double kFarFromAHalf = 0.3; // whole numbers, but near other surfaces
  const bool isClear =
      std::abs(before - 0.5) > kFarFromAHalf && std::abs(behind - 0.5) > kFarFromAHalf;
  return {before < 0.5 && behind >= 0.5, isClear && widest > placeTolerance(mesh.vertices)};
}

/// Turns the choice of narrow patches over, as long as fewer edges are left with more faces along
/// than against them: what is beside them cannot be told for certain.
void balance(const Faces& faces, const std::vector<std::vector<int>>& patches,
             const std::vector<char>& isCertain, std::vector<char>& isKept) {
  using Edge = std::pair<int, int>;
  std::vector<std::map<Edge, int>> borders(patches.size()); // how many more run along than against
  std::map<Edge, int> sum;                                  // of those that are kept
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (const int f : patches[p]) {
      for (int k = 0; k < 3; ++k) {
        const int a = faces(f, k);
        const int b = faces(f, (k + 1) % 3);
        borders[p][std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    for (auto edge = borders[p].begin(); edge != borders[p].end();) {
      edge = edge->second == 0 ? borders[p].erase(edge) : std::next(edge);
    }
    for (const auto& [edge, along] : borders[p]) sum[edge] += isKept[p] != 0 ? along : 0;
  }
  for (bool isChanged = true; isChanged;) { // each change lessens the sum of what is left
    isChanged = false;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      if (isCertain[p] != 0) continue;
      const int sign = isKept[p] != 0 ? -1 : 1;
      int gain = 0;
      for (const auto& [edge, along] : borders[p]) {
        gain += std::abs(sum[edge]) - std::abs(sum[edge] + sign * along);
      }
      if (gain <= 0) continue;
      for (const auto& [edge, along] : borders[p]) sum[edge] += sign * along;
      isKept[p] ^= 1;
      isChanged = true;
    }
  }
}

/// Components of bodies that do not cross: those that bound material from outside, and the cavities
/// right inside of them.
TriangleMesh withoutWhatIsInside(const TriangleMesh& mesh, std::size_t& inside) {
  std::vector<Submesh> components = componentMeshes(mesh.vertices, mesh.faces);
  if (components.size() < 2) return mesh;
  std::vector<Eigen::AlignedBox3d> boxes(components.size());
  std::vector<double> volumes;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const TriangleMesh& part = components[c].mesh;
    boxes[c].extend(Vec3(part.vertices.colwise().minCoeff().transpose()));
    boxes[c].extend(Vec3(part.vertices.colwise().maxCoeff().transpose()));
    volumes.push_back(signedVolume(part.vertices, part.faces));
  }
  std::vector<int> depth(components.size(), 0);
  for (std::size_t outer = 0; outer < components.size(); ++outer) {
    std::vector<std::size_t> candidates;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (c != outer && boxes[outer].contains(boxes[c])) candidates.push_back(c);
    }
    if (candidates.empty()) continue;
    TriangleMesh outward = components[outer].mesh;
    if (volumes[outer] < 0.0) flip(outward.faces);
    const TriangleTree tree(outward.vertices, outward.faces);
    const PointInMesh body(tree);
    for (const std::size_t c : candidates) {
      if (body.contains(components[c].mesh.vertices, components[c].mesh.faces)) ++depth[c];
    }
  }
  std::vector<TriangleMesh> kept;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (depth[c] == 0 || (depth[c] == 1 && volumes[c] < 0.0)) {
      kept.push_back(std::move(components[c].mesh));
    } else {
      ++inside;
    }
  }
  return inside == 0 ? mesh : assembled(kept);
}

/// The union of what crosses; nothing done where it cannot be had.
MendedMesh united(const TriangleMesh& input, const std::vector<int>& crossing,
                  const MendingTask& task) {
  const TriangleMesh bodies = outward(input, crossing);
  const TriangleMesh pieces = cutAlongCrossings(bodies, crossing);
  if (pieces.faces.rows() == 0) return {input};
  const WindingNumber winding(bodies.vertices, bodies.faces);
  const std::vector<std::vector<int>> patches = manifoldPatches(pieces.faces);
  std::vector<char> isKept;
  std::vector<char> isCertain;
  for (const std::vector<int>& patch : patches) {
    const PatchSide side = sideOf(pieces, patch, winding);
    isKept.push_back(side.isBoundary ? 1 : 0);
    isCertain.push_back(side.isCertain ? 1 : 0);
  }
  balance(pieces.faces, patches, isCertain, isKept);
  Faces kept(pieces.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (isKept[p] == 0) continue;
    for (const int f : patches[p]) kept.row(rows++) = pieces.faces.row(f);
  }
  kept.conservativeResize(rows, 3);
  if (rows == 0) return {input};
  MendedMesh result = splitToManifold(submesh(pieces.vertices, kept).mesh, task);
  result.done = counted(crossing.size(), "crossing face", "crossing faces") + " united";
  return result;
}

/// Faces that cross others, and edges that are open.
std::size_t faultsOf(const MendedMesh& result, const MendingTask& task) {
  const Points stored = task.representable(result.mesh.vertices);
  return selfIntersectingFaces(stored, result.mesh.faces).size() +
         countEdges(stored.rows(), result.mesh.faces).boundary;
}

/// Every component a little larger, each by another share, so that sides that lie in one plane but
/// for rounding do so no more.
TriangleMesh grown(const TriangleMesh& mesh) {
  constexpr double kMost = 1e-4;
  constexpr int kShares = 7;
  TriangleMesh result = mesh;
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), mesh.faces);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (number[at(v)] < 0) continue;
    if (boxes.size() <= at(number[at(v)])) boxes.resize(at(number[at(v)]) + 1);
    boxes[at(number[at(v)])].extend(Vec3(mesh.vertices.row(v).transpose()));
  }
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (number[at(v)] < 0) continue;
    const Vec3 centre = boxes[at(number[at(v)])].center();
    const double share = kMost * (1 + number[at(v)] % kShares) / kShares;
    result.vertices.row(v) += share * (mesh.vertices.row(v) - centre.transpose());
  }
  return result;
}

} // namespace

MendedMesh unitedBodies(const TriangleMesh& input, const MendingTask& task) {
  if (!isBalanced(input.faces)) return {input};
  MendedMesh result{input};
  const std::vector<int> crossing = selfIntersectingFaces(input.vertices, input.faces);
  if (!crossing.empty()) {
    result = united(input, crossing, task);
    if (faultsOf(result, task) > 0) {
      TriangleMesh larger = grown(input);
      const double moved = (larger.vertices - input.vertices).rowwise().norm().maxCoeff();
      larger.vertices = task.representable(larger.vertices);
      const std::vector<int> fewer = selfIntersectingFaces(larger.vertices, larger.faces);
      // Most are gone where bodies lay on each other; elsewhere it is the same once more.
      MendedMesh other{input};
      if (2 * fewer.size() < crossing.size()) other = united(larger, fewer, task);
      if (!other.done.empty() && faultsOf(other, task) < faultsOf(result, task)) {
        result = std::move(other);
        result.distance = std::max(result.distance, moved);
      }
    }
    if (result.done.empty()) return {input};
  }
  std::size_t inside = 0;
  result.mesh = withoutWhatIsInside(result.mesh, inside);
  if (inside > 0) {
    result.done += (crossing.empty() ? "" : ", ") + counted(inside, "component", "components") +
                   " inside of another left out";
  }
  return result;
}

} // namespace massprops
