#include "core/model/shell_orientation.h"

#include "core/base/triangle.h"
#include "core/mesh/connectivity.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

struct Neighbour {
  int face;
  bool agrees; ///< both run along the edge in opposite directions
};

struct Adjacency {
  std::vector<std::vector<Neighbour>> of;
  std::vector<char> endsAtManyFaces; ///< for every face
  bool isCoherent = true;            ///< as many faces run along every edge as against it
};

Adjacency adjacencyOf(const Faces& faces) {
  struct Side {
    int low, high, face;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(at(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = faces(f, k);
      const int b = faces(f, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.low, s.high, s.face) < std::tie(t.low, t.high, t.face);
  });
  Adjacency result;
  result.of.resize(at(faces.rows()));
  result.endsAtManyFaces.assign(at(faces.rows()), 0);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    int balance = 0;
    for (; end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;
         ++end) {
      balance += sides[end].forward ? 1 : -1;
    }
    if (end - i > 1 && balance != 0) result.isCoherent = false;
    if (end - i == 2) {
      const bool agrees = balance == 0;
      result.of[at(sides[i].face)].push_back({sides[i + 1].face, agrees});
      result.of[at(sides[i + 1].face)].push_back({sides[i].face, agrees});
    } else if (end - i > 2) {
      for (std::size_t j = i; j < end; ++j) result.endsAtManyFaces[at(sides[j].face)] = 1;
    }
    i = end;
  }
  return result;
}

/// Patches of faces that are connected across edges of two faces.
struct Patches {
  std::vector<std::vector<int>> faces;
  std::vector<char> isTurned; ///< for every face, so that each patch agrees with most of itself
};

Patches patchesOf(const TriangleMesh& mesh, const Adjacency& adjacency) {
  Patches result;
  result.isTurned.assign(at(mesh.faces.rows()), 0);
  std::vector<char> isKnown(at(mesh.faces.rows()), 0);
  for (Eigen::Index seed = 0; seed < mesh.faces.rows(); ++seed) {
    if (isKnown[at(seed)] != 0) continue;
    std::vector<int> patch{static_cast<int>(seed)};
    isKnown[at(seed)] = 1;
    double area[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const int f = patch[i];
      area[at(result.isTurned[at(f)])] += areaNormal(mesh.vertices, mesh.faces, f).norm();
      for (const Neighbour& next : adjacency.of[at(f)]) {
        if (isKnown[at(next.face)] != 0) continue;
        isKnown[at(next.face)] = 1;
        const bool isTurned = (result.isTurned[at(f)] != 0) == next.agrees;
        result.isTurned[at(next.face)] = isTurned ? 1 : 0;
        patch.push_back(next.face);
      }
    }
    if (area[1] > area[0]) {
      for (const int f : patch) result.isTurned[at(f)] ^= 1;
    }
    result.faces.push_back(std::move(patch));
  }
  return result;
}

/// Inside as most of three rays along different axes say it: one may leave through a hole.
class InsideOfMost {
public:
  explicit InsideOfMost(const TriangleMesh& mesh) {
    Points points = mesh.vertices;
    for (std::size_t k = 0; k < 3; ++k) {
      turned_[k] = points;
      trees_[k] = std::make_unique<const TriangleTree>(turned_[k], mesh.faces);
      inside_[k] = std::make_unique<const PointInMesh>(*trees_[k]);
      points << turned_[k].rightCols(2), turned_[k].col(0);
    }
  }

  bool contains(Vec3 p) const {
    int votes = 0;
    for (const auto& turned : inside_) {
      votes += turned->contains(p) ? 1 : 0;
      p = Vec3(p.y(), p.z(), p.x());
    }
    return votes > 1;
  }

private:
  Points turned_[3]; ///< the axes in another order
  std::unique_ptr<const TriangleTree> trees_[3];
  std::unique_ptr<const PointInMesh> inside_[3];
};

/// Whether much of the patch's area has the inside in front of it.
bool facesInward(const TriangleMesh& mesh, std::vector<int> patch, const InsideOfMost& inside,
                 double step) {
  // The largest faces tell most.
  constexpr std::size_t kMostFaces = 15;
  const auto area = [&](int f) { return areaNormal(mesh.vertices, mesh.faces, f).norm(); };
  std::stable_sort(patch.begin(), patch.end(), [&](int f, int g) { return area(f) > area(g); });
  patch.resize(std::min(patch.size(), kMostFaces));
  double votes = 0.0;
  double all = 0.0;
  for (const int f : patch) {
    const Vec3 normal = areaNormal(mesh.vertices, mesh.faces, f).stableNormalized();
    const Vec3 middle = (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
                         mesh.vertices.row(mesh.faces(f, 2)))
                            .transpose() /
                        3.0;
    const bool before = inside.contains(middle + step * normal);
    const bool behind = inside.contains(middle - step * normal);
    if (before != behind) votes += before ? area(f) : -area(f);
    all += area(f);
  }
  constexpr double kMuch = 0.3;
  return votes > kMuch * all;
}

} // namespace

MendedMesh orientedShells(const TriangleMesh& input, const MendingTask& /*task*/) {
  MendedMesh result{input};
  TriangleMesh& mesh = result.mesh;
  if (mesh.faces.rows() == 0) return result;
  const Adjacency adjacency = adjacencyOf(mesh.faces);
  if (adjacency.isCoherent) return result;
  const Patches patches = patchesOf(mesh, adjacency);
  const auto turn = [&](int f) { std::swap(mesh.faces(f, 1), mesh.faces(f, 2)); };
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (patches.isTurned[at(f)] != 0) turn(static_cast<int>(f));
  }
  const TriangleMesh before = mesh;
  const InsideOfMost inside(before);
  const double step = 10.0 * placeTolerance(mesh.vertices);
  for (const std::vector<int>& patch : patches.faces) {
    const bool isConcerned = std::any_of(patch.begin(), patch.end(), [&](int f) {
      return adjacency.endsAtManyFaces[at(f)] != 0 || patches.isTurned[at(f)] != 0;
    });
    if (isConcerned && facesInward(before, patch, inside, step)) {
      for (const int f : patch) turn(f);
    }
  }
  std::size_t turned = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (mesh.faces(f, 1) != input.faces(f, 1)) ++turned;
  }
  if (turned > 0) result.done = counted(turned, "face", "faces") + " turned over";
  return result;
}

} // namespace massprops
