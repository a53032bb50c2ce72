#include "core/model/manifold_split.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// A half-edge as connectivity.h numbers them, with its edge.
struct Side {
  int low, high;
  int halfEdge;
  bool forward; ///< from `low` to `high`
};

std::vector<Side> sidesOf(const Faces& faces) {
  std::vector<Side> sides;
  sides.reserve(at(faces.size()));
  for (int h = 0; h < static_cast<int>(faces.size()); ++h) {
    const int a = faces.data()[h];
    const int b = faces.data()[nextHalfEdge(h)];
    sides.push_back({std::min(a, b), std::max(a, b), h, a < b});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.low, s.high, s.halfEdge) < std::tie(t.low, t.high, t.halfEdge);
  });
  return sides;
}

/// Faces of one edge in pairs that bound a wedge of material: seen along the edge,
/// counter-clockwise from a face that runs against it, behind which the material begins, to one
/// that runs along it. Faces that are left are with −1. The same for both halves of an edge, so
/// that a vertex between them parts it.
std::vector<std::pair<int, int>> wedges(const TriangleMesh& mesh, const Side* begin,
                                        const Side* end) {
  const Vec3 origin = mesh.vertices.row(begin->low).transpose();
  Vec3 axis = (mesh.vertices.row(begin->high).transpose() - origin).stableNormalized();
  // Upwards, wherever the numbers begin.
  const bool isTurned = std::tuple(axis.z(), axis.y(), axis.x()) < std::tuple(0.0, 0.0, 0.0);
  if (isTurned) axis = -axis;
  const Vec3 u = axis.unitOrthogonal();
  const Vec3 w = axis.cross(u);
  struct Ray {
    double angle;
    bool closes;
    int halfEdge;
  };
  std::vector<Ray> rays;
  for (const Side* side = begin; side != end; ++side) {
    const int apex = mesh.faces.data()[previousHalfEdge(side->halfEdge)];
    const Vec3 d = mesh.vertices.row(apex).transpose() - origin;
    constexpr double kSame = 1e-7; // faces that lie on each other keep their order
    const double angle = kSame * std::round(std::atan2(d.dot(w), d.dot(u)) / kSame);
    rays.push_back({angle, side->forward != isTurned, side->halfEdge});
  }
  std::stable_sort(rays.begin(), rays.end(),
                   [](const Ray& r, const Ray& s) { return r.angle < s.angle; });
  // As brackets in a circle: twice round, so that one that opens at the end is closed.
  std::vector<std::pair<int, int>> pairs;
  std::vector<std::size_t> open;
  std::vector<char> isPaired(rays.size(), 0);
  for (std::size_t i = 0; i < 2 * rays.size(); ++i) {
    const std::size_t r = i % rays.size();
    if (isPaired[r] != 0) continue;
    if (!rays[r].closes) {
      if (i < rays.size()) open.push_back(r);
    } else if (!open.empty()) {
      isPaired[open.back()] = isPaired[r] = 1;
      pairs.emplace_back(rays[open.back()].halfEdge, rays[r].halfEdge);
      open.pop_back();
    }
  }
  for (std::size_t r = 0; r < rays.size(); ++r) {
    if (isPaired[r] == 0) pairs.emplace_back(rays[r].halfEdge, -1);
  }
  return pairs;
}

/// Corners that stay together at one vertex.
class CornerSets {
public:
  explicit CornerSets(Eigen::Index corners)
      : rank_(at(corners)), parent_(at(corners)), sets_(rank_.data(), parent_.data()) {
    for (int c = 0; c < static_cast<int>(corners); ++c) sets_.make_set(c);
  }

  /// Across an edge, which the half-edges run along in opposite directions.
  void join(int h, int g) {
    sets_.union_set(h, nextHalfEdge(g));
    sets_.union_set(nextHalfEdge(h), g);
  }

  CornerSets(const CornerSets&) = delete;
  CornerSets& operator=(const CornerSets&) = delete;

  int of(int corner) { return sets_.find_set(corner); }

private:
  std::vector<int> rank_, parent_;
  boost::disjoint_sets<int*, int*> sets_;
};

/// An edge of more than two faces and the half-edges that are paired there.
struct Pinch {
  int low, high;
  std::vector<std::pair<int, int>> pairs; ///< as of `wedges`
};

/// Lets the corners stay together that are connected across edges.
std::vector<Pinch> joinAcrossEdges(const TriangleMesh& mesh, CornerSets& sets) {
  std::vector<Pinch> pinches;
  const std::vector<Side> sides = sidesOf(mesh.faces);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].low == sides[i].low &&
           sides[end].high == sides[i].high) {
      ++end;
    }
    if (end - i == 2 && sides[i].forward != sides[i + 1].forward) {
      sets.join(sides[i].halfEdge, sides[i + 1].halfEdge);
    } else if (end - i > 1) {
      pinches.push_back(
          {sides[i].low, sides[i].high, wedges(mesh, sides.data() + i, sides.data() + end)});
      for (const auto& [h, g] : pinches.back().pairs) {
        if (g >= 0) sets.join(h, g);
      }
    }
    i = end;
  }
  return pinches;
}

/// Whether two pairs keep both ends in common, so that parting vertices does not part the edge.
bool staysPinched(const Pinch& pinch, const Faces& faces, CornerSets& sets) {
  std::vector<std::pair<int, int>> ends;
  for (const auto& pair : pinch.pairs) {
    const int h = pair.first;
    const int from = faces.data()[h] == pinch.low ? h : nextHalfEdge(h);
    const int to = from == h ? nextHalfEdge(h) : h;
    ends.emplace_back(sets.of(from), sets.of(to));
  }
  std::sort(ends.begin(), ends.end());
  return std::adjacent_find(ends.begin(), ends.end()) != ends.end();
}

std::vector<const Pinch*> tightOf(const std::vector<Pinch>& pinches, const Faces& faces,
                                  CornerSets& sets) {
  std::vector<const Pinch*> tight;
  for (const Pinch& pinch : pinches) {
    if (staysPinched(pinch, faces, sets)) tight.push_back(&pinch);
  }
  return tight;
}

/// Edges of these get a vertex in their middle, one in each face.
TriangleMesh withMiddles(const TriangleMesh& mesh, const std::vector<const Pinch*>& pinches) {
  std::map<std::pair<int, int>, int> middleOf;
  TriangleMesh result = mesh;
  auto rows = mesh.vertices.rows();
  result.vertices.conservativeResize(rows + static_cast<Eigen::Index>(pinches.size()), 3);
  for (const Pinch* pinch : pinches) {
    middleOf.emplace(std::pair(pinch->low, pinch->high), static_cast<int>(rows));
    result.vertices.row(rows++) =
        0.5 * (mesh.vertices.row(pinch->low) + mesh.vertices.row(pinch->high));
  }
  std::vector<Eigen::RowVector3i> faces;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    // The corners with the middles between them, cut into a fan from a middle.
    std::vector<int> ring;
    std::size_t first = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.faces(f, k);
      const int b = mesh.faces(f, (k + 1) % 3);
      ring.push_back(a);
      const auto found = middleOf.find(std::minmax(a, b));
      if (found == middleOf.end()) continue;
      first = ring.size();
      ring.push_back(found->second);
    }
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      faces.emplace_back(ring[first], ring[(first + i) % ring.size()],
                         ring[(first + i + 1) % ring.size()]);
    }
  }
  result.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    result.faces.row(static_cast<Eigen::Index>(i)) = faces[i];
  }
  return result;
}

/// From a vertex into the material behind these of its corners: a tenth of the shortest edge, at
/// least and at most so far.
Vec3 wayInward(const TriangleMesh& mesh, const std::vector<int>& corners, double least,
               double most) {
  Vec3 normal = Vec3::Zero();
  double shortest = std::numeric_limits<double>::infinity();
  for (const int c : corners) {
    normal += areaNormal(mesh.vertices, mesh.faces, c / 3).stableNormalized();
    const int v = mesh.faces.data()[c];
    const int next = mesh.faces.data()[nextHalfEdge(c)];
    shortest = std::min(shortest, (mesh.vertices.row(next) - mesh.vertices.row(v)).norm());
  }
  return -std::clamp(0.1 * shortest, least, most) * normal.stableNormalized();
}

MendedMesh splitOnce(const TriangleMesh& given) {
  TriangleMesh input = given;
  auto sets = std::make_unique<CornerSets>(input.faces.size());
  std::vector<Pinch> pinches = joinAcrossEdges(input, *sets);
  const std::size_t edges = pinches.size();
  const std::vector<const Pinch*> tight = tightOf(pinches, input.faces, *sets);
  if (!tight.empty()) {
    input = withMiddles(input, tight);
    sets = std::make_unique<CornerSets>(input.faces.size());
    pinches = joinAcrossEdges(input, *sets);
  }
  MendedMesh result{input};

  // A vertex for each set of corners: the first keeps the number.
  const VertexCorners corners = vertexCorners(input.vertices.rows(), input.faces);
  TriangleMesh& mesh = result.mesh;
  std::vector<Vec3> added;
  std::size_t vertices = 0;
  const double most = placeTolerance(input.vertices);
  // So that they are apart as floats.
  constexpr double kFloats = 2.5e-7;
  const double least = kFloats * input.vertices.cwiseAbs().maxCoeff();
  for (Eigen::Index v = 0; v < input.vertices.rows(); ++v) {
    std::vector<int> roots;
    for (const int c : corners.at(v)) roots.push_back(sets->of(c));
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    if (roots.size() < 2) continue;
    ++vertices;
    const Vec3 place = input.vertices.row(v).transpose();
    for (std::size_t r = 0; r < roots.size(); ++r) {
      const int number =
          r == 0 ? static_cast<int>(v)
                 : static_cast<int>(input.vertices.rows()) + static_cast<int>(added.size());
      std::vector<int> own;
      for (const int c : corners.at(v)) {
        if (sets->of(c) == roots[r]) own.push_back(c);
      }
      for (const int c : own) mesh.faces.data()[c] = number;
      const Vec3 moved = place + wayInward(input, own, least, most);
      if (r == 0) {
        mesh.vertices.row(v) = moved.transpose();
      } else {
        added.push_back(moved);
      }
    }
  }
  if (vertices == 0) return {given};
  const Eigen::Index rows = mesh.vertices.rows();
  mesh.vertices.conservativeResize(rows + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i) {
    mesh.vertices.row(rows + static_cast<Eigen::Index>(i)) = added[i].transpose();
  }
  result.distance = most;
  result.done = edges > 0
                    ? counted(edges, "non-manifold edge", "non-manifold edges") + " parted"
                    : counted(vertices, "non-manifold vertex", "non-manifold vertices") + " parted";
  return result;
}

} // namespace

MendedMesh splitToManifold(const TriangleMesh& given, const MendingTask& /*task*/) {
  MendedMesh result = splitOnce(given);
  // Where edges met that are parted now, others may still hold together.
  constexpr int kMore = 8;
  for (int round = 0; round < kMore && !result.done.empty(); ++round) {
    MendedMesh next = splitOnce(result.mesh);
    if (next.done.empty()) break;
    result.mesh = std::move(next.mesh);
    result.distance += next.distance;
  }
  return result;
}

} // namespace massprops
