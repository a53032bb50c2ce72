#include "core/model/seams.h"

#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"
#include "core/model/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// A face may have more than one edge to cut, or to turn.
constexpr int kRounds = 8;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

using Edge = std::pair<int, int>;

Edge edgeOf(const Faces& faces, Eigen::Index f, int k) {
  return std::minmax(faces(f, k), faces(f, (k + 1) % 3));
}

/// Half-edges, as connectivity.h numbers them, whose edge has no other face.
std::vector<int> borderOf(const Faces& faces) {
  std::vector<std::pair<Edge, int>> edges;
  edges.reserve(at(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      edges.emplace_back(edgeOf(faces, f, k), static_cast<int>(3 * f + k));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<int> border;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool hasBefore = i > 0 && edges[i - 1].first == edges[i].first;
    const bool hasAfter = i + 1 < edges.size() && edges[i + 1].first == edges[i].first;
    if (!hasBefore && !hasAfter) border.push_back(edges[i].second);
  }
  std::sort(border.begin(), border.end());
  return border;
}

std::vector<int> verticesOf(const Faces& faces, const std::vector<int>& border) {
  std::vector<int> vertices;
  for (const int h : border) {
    vertices.push_back(faces.data()[h]);
    vertices.push_back(faces.data()[nextHalfEdge(h)]);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Vertices in cubes, to find those near a place.
class Cubes {
public:
  Cubes(const Points& points, double size) : points_(points), size_(size) {}

  void add(int v) { cubes_[key(cubeOf(points_.row(v).transpose()))].push_back(v); }

  /// Calls visit(v) for every vertex in the cubes that the box meets.
  template <class Visit>
  void forNear(const Vec3& low, const Vec3& high, const Visit& visit) const {
    const Cube from = cubeOf(low);
    const Cube to = cubeOf(high);
    for (std::int64_t x = from[0]; x <= to[0]; ++x) {
      for (std::int64_t y = from[1]; y <= to[1]; ++y) {
        for (std::int64_t z = from[2]; z <= to[2]; ++z) {
          const auto found = cubes_.find(key({x, y, z}));
          if (found == cubes_.end()) continue;
          for (const int v : found->second) visit(v);
        }
      }
    }
  }

private:
  using Cube = std::array<std::int64_t, 3>;
  Cube cubeOf(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p[0] / size_)),
            static_cast<std::int64_t>(std::floor(p[1] / size_)),
            static_cast<std::int64_t>(std::floor(p[2] / size_))};
  }
  static std::int64_t key(const Cube& c) {
    return (c[0] * 73856093) ^ (c[1] * 19349663) ^ (c[2] * 83492791);
  }

  const Points& points_;
  double size_;
  std::unordered_map<std::int64_t, std::vector<int>> cubes_;
};

/// Every border vertex becomes the first one within the tolerance. Returns how many did.
std::size_t mergeNear(TriangleMesh& mesh, double tolerance) {
  const std::vector<int> vertices = verticesOf(mesh.faces, borderOf(mesh.faces));
  Cubes kept(mesh.vertices, tolerance);
  std::vector<int> becomes(at(mesh.vertices.rows()));
  for (std::size_t v = 0; v < becomes.size(); ++v) becomes[v] = static_cast<int>(v);
  std::size_t merged = 0;
  for (const int v : vertices) {
    const Vec3 p = mesh.vertices.row(v).transpose();
    const Vec3 reach = Vec3::Constant(tolerance);
    int first = v;
    kept.forNear(p - reach, p + reach, [&](int other) {
      const bool isNear = (mesh.vertices.row(other).transpose() - p).norm() <= tolerance;
      if (isNear) first = std::min(first, other);
    });
    if (first == v) {
      kept.add(v);
    } else {
      becomes[at(v)] = first;
      ++merged;
    }
  }
  mesh.faces = mesh.faces.unaryExpr([&](int v) { return becomes[at(v)]; });
  return merged;
}

struct Split {
  double share; ///< of the way along the half-edge
  int vertex;
};

/// Cuts faces at vertices of the border that lie on their border edges. Returns how many vertices.
std::size_t splitAtTJunctions(TriangleMesh& mesh, double tolerance) {
  const std::vector<int> border = borderOf(mesh.faces);
  if (border.empty()) return 0;
  double longest = 0.0;
  double sum = 0.0;
  const auto end = [&](int h) { return Vec3(mesh.vertices.row(mesh.faces.data()[h]).transpose()); };
  for (const int h : border) {
    const double length = (end(nextHalfEdge(h)) - end(h)).norm();
    longest = std::max(longest, length);
    sum += length;
  }
  // A cube for each few vertices, and not many cubes along the longest edge.
  const double mean = sum / static_cast<double>(border.size());
  constexpr double kMostCubes = 50.0;
  const double size = std::max({mean, longest / kMostCubes, 2.0 * tolerance});
  Cubes cubes(mesh.vertices, size);
  for (const int v : verticesOf(mesh.faces, border)) cubes.add(v);

  std::vector<Eigen::RowVector3i> added;
  std::size_t count = 0;
  std::vector<char> isCut(at(mesh.faces.rows()), 0);
  for (const int h : border) {
    if (isCut[at(h / 3)] != 0) continue; // another round has it
    const int a = mesh.faces.data()[h];
    const int c = mesh.faces.data()[nextHalfEdge(h)];
    const int d = mesh.faces.data()[previousHalfEdge(h)];
    const Vec3 from = end(h);
    const Vec3 way = end(nextHalfEdge(h)) - from;
    const double length = way.norm();
    std::vector<Split> splits;
    const Vec3 reach = Vec3::Constant(tolerance);
    cubes.forNear(from.cwiseMin(from + way) - reach, from.cwiseMax(from + way) + reach, [&](int v) {
      if (v == a || v == c || v == d) return;
      const Vec3 p = mesh.vertices.row(v).transpose() - from;
      const double along = p.dot(way) / length;
      if (!(along > tolerance && along < length - tolerance)) return;
      if ((p - along / length * way).norm() <= tolerance) splits.push_back({along, v});
    });
    if (splits.empty()) continue;
    std::sort(splits.begin(), splits.end(), [](const Split& p, const Split& q) {
      return std::make_pair(p.share, p.vertex) < std::make_pair(q.share, q.vertex);
    });
    splits.erase(std::unique(splits.begin(), splits.end(),
                             [](const Split& p, const Split& q) { return p.vertex == q.vertex; }),
                 splits.end());
    isCut[at(h / 3)] = 1;
    count += splits.size();
    mesh.faces.row(h / 3) << a, splits.front().vertex, d;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      added.emplace_back(splits[i].vertex, i + 1 < splits.size() ? splits[i + 1].vertex : c, d);
    }
  }
  const Eigen::Index rows = mesh.faces.rows();
  mesh.faces.conservativeResize(rows + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i) {
    mesh.faces.row(rows + static_cast<Eigen::Index>(i)) = added[i];
  }
  return count;
}

/// The corner of a face without area that lies between the other two.
int middleCorner(const TriangleMesh& mesh, int f) {
  int best = 0;
  double longest = -1.0;
  for (int k = 0; k < 3; ++k) {
    const double length = (mesh.vertices.row(mesh.faces(f, (k + 1) % 3)) -
                           mesh.vertices.row(mesh.faces(f, (k + 2) % 3)))
                              .norm();
    if (length > longest) {
      longest = length;
      best = k;
    }
  }
  return best;
}

void leaveOut(const std::vector<char>& goes, Faces& faces) {
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (goes[at(f)] != 0) continue;
    const Eigen::RowVector3i face = faces.row(f);
    faces.row(kept++) = face;
  }
  faces.conservativeResize(kept, 3);
}

/// Turns the longest edge of faces without area into the neighbour's other diagonal; a face without
/// a neighbour there goes. Returns how many went.
std::size_t removeFlat(TriangleMesh& mesh) {
  std::size_t removed = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> flat = facesWithoutArea(mesh.vertices, mesh.faces);
    if (flat.empty()) break;
    std::map<Edge, std::vector<int>> around; // of the longest edges
    for (const int f : flat) {
      around[edgeOf(mesh.faces, f, (middleCorner(mesh, f) + 1) % 3)] = {};
    }
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto found = around.find(edgeOf(mesh.faces, f, k));
        if (found != around.end()) found->second.push_back(static_cast<int>(f));
      }
    }
    std::vector<char> isTouched(at(mesh.faces.rows()), 0);
    std::vector<char> goes(at(mesh.faces.rows()), 0);
    std::size_t now = 0;
    for (const int f : flat) {
      const int k = middleCorner(mesh, f);
      const int middle = mesh.faces(f, k);
      const std::vector<int>& faces = around[edgeOf(mesh.faces, f, (k + 1) % 3)];
      if (isTouched[at(f)] != 0) continue;
      if (faces.size() == 1) {
        isTouched[at(f)] = goes[at(f)] = 1;
        ++now;
        continue;
      }
      if (faces.size() != 2) continue;
      const int other = faces[0] == f ? faces[1] : faces[0];
      if (other == f || isTouched[at(other)] != 0) continue;
      const Edge edge = edgeOf(mesh.faces, f, (k + 1) % 3);
      Eigen::RowVector3i one = mesh.faces.row(other);
      Eigen::RowVector3i two = one;
      bool hasMiddle = false;
      for (int i = 0; i < 3; ++i) {
        hasMiddle = hasMiddle || mesh.faces(other, i) == middle;
        if (one[i] == edge.first) one[i] = middle;
        if (two[i] == edge.second) two[i] = middle;
      }
      isTouched[at(f)] = isTouched[at(other)] = 1;
      ++now;
      if (hasMiddle) { // both are flat, one on the other
        goes[at(f)] = goes[at(other)] = 1;
        continue;
      }
      mesh.faces.row(other) = one;
      mesh.faces.row(f) = two;
    }
    leaveOut(goes, mesh.faces);
    removed += now;
    if (now == 0) break;
  }
  return removed;
}

} // namespace

MendedMesh joinedSeams(const TriangleMesh& input, const MendingTask& /*task*/) {
  MendedMesh result{input};
  TriangleMesh& mesh = result.mesh;
  const double tolerance = placeTolerance(mesh.vertices);
  std::size_t merged = 0;
  std::size_t junctions = 0;
  const std::size_t border = borderOf(mesh.faces).size();
  if (border > 0) {
    TriangleMesh near = mesh;
    merged = mergeNear(near, tolerance);
    if (merged > 0) near = mergedAndCompacted(near).mesh;
    // Fewer openings, and not because the surface is gone.
    const bool isBetter = merged > 0 && borderOf(near.faces).size() < border;
    if (isBetter) {
      mesh = std::move(near);
    } else {
      merged = 0;
    }
    for (int round = 0; round < kRounds; ++round) {
      const std::size_t now = splitAtTJunctions(mesh, tolerance);
      junctions += now;
      if (now == 0) break;
    }
  }
  const std::size_t flat = removeFlat(mesh);
  mesh = mergedAndCompacted(mesh).mesh;
  const auto append = [&](std::size_t n, const char* singular, const char* plural,
                          const char* what) {
    if (n == 0) return;
    result.done += (result.done.empty() ? "" : ", ") + counted(n, singular, plural) + what;
  };
  append(merged, "vertex", "vertices", " merged with a near one");
  append(junctions, "T-junction", "T-junctions", " closed");
  append(flat, "face", "faces", " without area turned over");
  if (merged + junctions > 0) result.distance = tolerance;
  return result;
}

} // namespace massprops
