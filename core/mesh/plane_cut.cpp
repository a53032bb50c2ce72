#include "core/mesh/plane_cut.h"

#include "core/mesh/components.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

using Loop = std::vector<int>;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// The least height of the triangle over its longest edge, squared: the greater the rounder.
double roundness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).squaredNorm() / (longest * longest);
}

/// The surface above the plane with the holes that the cut leaves.
class Opened {
public:
  Opened(const Points& vertices, const Faces& faces, double level)
      : given_(vertices.rows()), level_(level) {
    // Large ones are not to be copied again and again.
    Eigen::Index kept = 0;
    Eigen::Index clipped = 0;
    const auto isHigh = [&](int v) { return vertices(v, 2) > level ? 1 : 0; };
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      const int above = isHigh(faces(f, 0)) + isHigh(faces(f, 1)) + isHigh(faces(f, 2));
      ++(above == 3 ? kept : clipped);
      if (above == 0) --clipped;
    }
    kept_.reserve(at(kept));
    points_.reserve(at(given_ + 2 * clipped)); // two of each, if it had no neighbours
    for (Eigen::Index v = 0; v < given_; ++v) points_.emplace_back(vertices.row(v).transpose());
    for (Eigen::Index f = 0; f < faces.rows(); ++f) cut(faces.row(f), static_cast<int>(f));
  }

  /// Rounds the cut's points.
  void round(const std::function<Points(const Points&)>& representable) {
    Points cuts(static_cast<Eigen::Index>(points_.size()) - given_, 3);
    if (cuts.rows() == 0) return;
    for (Eigen::Index i = 0; i < cuts.rows(); ++i)
      cuts.row(i) = points_[at(given_ + i)].transpose();
    cuts = representable(cuts);
    for (Eigen::Index i = 0; i < cuts.rows(); ++i)
      points_[at(given_ + i)] = cuts.row(i).transpose();
  }

  /// Makes corners one that an edge shorter than `distance` joins, one of them cut.
  void merge(double distance) {
    std::vector<int> parent(points_.size());
    std::vector<int> rank(points_.size());
    boost::disjoint_sets<int*, int*> sets(rank.data(), parent.data());
    for (std::size_t v = 0; v < points_.size(); ++v) sets.make_set(static_cast<int>(v));
    const double limit = std::min(distance, kShareOfEdge * medianOfBorder());
    for (const Part& part : clipped_) {
      for (int k = 0; k < 3; ++k) {
        const int a = part.corners[k];
        const int b = part.corners[(k + 1) % 3];
        if ((isCut(a) || isCut(b)) && (points_[at(a)] - points_[at(b)]).norm() < limit) {
          sets.union_set(a, b);
        }
      }
    }
    // In its first cut corner.
    std::vector<int> representative(points_.size(), -1);
    for (int v = 0; v < static_cast<int>(points_.size()); ++v) {
      int& known = representative[at(sets.find_set(v))];
      if (known < 0 || (!isCut(known) && isCut(v))) known = v;
    }
    const auto place = [&](int v) { return representative[at(sets.find_set(v))]; };
    for (std::vector<Part>* parts : {&kept_, &clipped_}) {
      for (Part& part : *parts) part.corners = part.corners.unaryExpr(place).eval();
      const auto isFlat = [](const Part& part) {
        const Eigen::RowVector3i& f = part.corners;
        return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
      };
      parts->erase(std::remove_if(parts->begin(), parts->end(), isFlat), parts->end());
    }
    std::map<int, int> next;
    std::size_t steps = 0;
    for (const auto& [from, to] : next_) {
      if (place(from) == place(to)) continue;
      next[place(from)] = place(to);
      ++steps;
    }
    isSimple_ = steps == next.size();
    next_ = std::move(next);
  }

  /// Along which a cap's triangles run. No loops where they are not simple.
  std::vector<Loop> loops() const {
    std::vector<Loop> result;
    if (!isSimple_) return result;
    std::map<int, int> rest = next_;
    while (!rest.empty()) {
      Loop loop;
      for (auto step = rest.begin(); step != rest.end(); step = rest.find(loop.back())) {
        if (loop.empty()) loop.push_back(step->first);
        loop.push_back(step->second);
        rest.erase(step);
      }
      if (loop.back() != loop.front()) return {};
      loop.pop_back();
      if (loop.size() > 2) result.push_back(std::move(loop));
    }
    return result;
  }

  /// Length of the border's edges.
  double medianOfBorder() const {
    std::vector<double> lengths;
    for (const auto& [from, to] : next_) {
      lengths.push_back((points_[at(from)] - points_[at(to)]).norm());
    }
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
  }

  std::vector<Vec3>& points() { return points_; }

  /// With triangles that close it; nothing is left here.
  TriangleMesh closedBy(const std::vector<Eigen::RowVector3i>& caps) {
    Points vertices(static_cast<Eigen::Index>(points_.size()), 3);
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) vertices.row(v) = points_[at(v)].transpose();
    points_ = {};
    Faces faces(static_cast<Eigen::Index>(kept_.size() + clipped_.size() + caps.size()), 3);
    Eigen::Index row = 0;
    for (auto* parts : {&kept_, &clipped_}) {
      for (const Part& part : *parts) faces.row(row++) = part.corners;
      *parts = {};
    }
    for (const Eigen::RowVector3i& face : caps) faces.row(row++) = face;
    return submesh(vertices, faces).mesh;
  }

  /// But for those that close it.
  std::vector<int> facesOf() const {
    std::vector<int> result;
    for (const auto* parts : {&kept_, &clipped_}) {
      for (const Part& part : *parts) result.push_back(part.face);
    }
    return result;
  }

private:
  static constexpr double kShareOfEdge = 0.1;

  /// Of a face of the surface, or all of it.
  struct Part {
    Eigen::RowVector3i corners;
    int face;
  };

  bool isAbove(int v) const { return points_[at(v)].z() > level_; }
  bool isCut(int v) const { return v >= given_; }

  /// The same for both faces of the edge.
  int cutPoint(int a, int b) {
    const auto [known, isNew] =
        cutOf_.try_emplace(std::minmax(a, b), static_cast<int>(points_.size()));
    if (isNew) {
      const Vec3 p = points_[at(std::min(a, b))];
      const Vec3 q = points_[at(std::max(a, b))];
      Vec3 cut = p + (level_ - p.z()) / (q.z() - p.z()) * (q - p);
      cut.z() = level_;
      points_.push_back(cut);
    }
    return known->second;
  }

  void cut(const Eigen::RowVector3i& face, int f) {
    const int above = int(isAbove(face[0])) + int(isAbove(face[1])) + int(isAbove(face[2]));
    if (above == 3) kept_.push_back({face, f});
    if (above == 0 || above == 3) return;
    // The corner that is alone on its side comes first.
    int k = 0;
    while (isAbove(face[k]) != (above == 1)) ++k;
    const int a = face[k];
    const int b = face[(k + 1) % 3];
    const int c = face[(k + 2) % 3];
    const int onB = cutPoint(a, b);
    const int onC = cutPoint(a, c);
    if (above == 1) {
      clipped_.push_back({{a, onB, onC}, f});
      next_[onC] = onB;
      return;
    }
    next_[onB] = onC;
    // The quadrilateral onB, b, c, onC by its better diagonal.
    const auto worse = [&](int p, int q, int r, int s) {
      return std::min(roundness(points_[at(p)], points_[at(q)], points_[at(r)]),
                      roundness(points_[at(p)], points_[at(r)], points_[at(s)]));
    };
    if (worse(onB, b, c, onC) >= worse(b, c, onC, onB)) {
      clipped_.push_back({{onB, b, c}, f});
      clipped_.push_back({{onB, c, onC}, f});
    } else {
      clipped_.push_back({{b, c, onC}, f});
      clipped_.push_back({{b, onC, onB}, f});
    }
  }

  Eigen::Index given_; ///< number of vertices
  double level_;
  std::vector<Vec3> points_; ///< the given vertices, then those of the cut
  std::map<std::pair<int, int>, int> cutOf_;
  std::vector<Part> kept_, clipped_;
  std::map<int, int> next_; ///< along the border, as the caps run
  bool isSimple_ = true;
};

/// Faces of the triangulation within the polygons, the loops being their borders: marked by 1.
void markWithin(Triangulation& plane) {
  for (const auto face : plane.all_face_handles()) face->info() = -1;
  std::vector<Triangulation::Face_handle> open{plane.infinite_face()};
  plane.infinite_face()->info() = 0;
  while (!open.empty()) {
    const Triangulation::Face_handle face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Triangulation::Face_handle other = face->neighbor(k);
      if (other->info() >= 0) continue;
      other->info() = plane.is_constrained({face, k}) ? 1 - face->info() : face->info();
      open.push_back(other);
    }
  }
}

double distanceToBorder(const std::vector<Vec3>& points, const std::vector<Loop>& loops,
                        const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = points[at(loop[i])].head<2>();
      const Vec2 edge = points[at(loop[(i + 1) % loop.size()])].head<2>() - a;
      const double t = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - a - t * edge).squaredNorm());
    }
  }
  return std::sqrt(least);
}

/// Points of a lattice of triangles within the polygons, off their borders.
std::vector<Vec2> innerPoints(const Triangulation& plane, const std::vector<Vec3>& points,
                              const std::vector<Loop>& loops, double edge) {
  constexpr double kOffBorder = 0.7;
  Eigen::AlignedBox2d box;
  std::size_t corners = 0;
  for (const Loop& loop : loops) {
    corners += loop.size();
    for (const int v : loop) box.extend(Vec2(points[at(v)].head<2>()));
  }
  // No more of them than a few times the border's corners.
  constexpr double kMost = 4.0;
  const Vec2 size = box.sizes();
  const double step =
      std::max(edge, std::sqrt(size.prod() / (kMost * static_cast<double>(corners))));
  const double rise = 0.5 * std::sqrt(3.0) * step;
  std::vector<Vec2> inner;
  for (int j = 1; j * rise < size.y(); ++j) {
    for (int i = 0; (i + 0.5 * (j % 2)) * step < size.x(); ++i) {
      const Vec2 p = box.min() + Vec2((i + 0.5 * (j % 2)) * step, j * rise);
      const auto face = plane.locate({p.x(), p.y()});
      if (face->info() == 1 && distanceToBorder(points, loops, p) > kOffBorder * step) {
        inner.push_back(p);
      }
    }
  }
  return inner;
}

/// Triangles within the loops, facing down; inner points are added. Empty where the loops cross.
std::vector<Eigen::RowVector3i> capsOf(const std::vector<Loop>& loops, double level, double edge,
                                       std::vector<Vec3>& points,
                                       const std::function<Points(const Points&)>& representable) {
  Triangulation plane;
  std::vector<Eigen::RowVector3i> caps;
  try {
    const auto insert = [&](int v) {
      const auto vertex = plane.insert({points[at(v)].x(), points[at(v)].y()});
      vertex->info() = v;
      return vertex;
    };
    std::size_t corners = 0;
    std::vector<std::vector<Triangulation::Vertex_handle>> borders;
    for (const Loop& loop : loops) {
      borders.emplace_back();
      for (const int v : loop) borders.back().push_back(insert(v));
      corners += loop.size();
    }
    // No constraint may join a point to itself.
    if (plane.number_of_vertices() != corners) return {};
    for (const auto& border : borders) {
      for (std::size_t i = 0; i < border.size(); ++i) {
        plane.insert_constraint(border[i], border[(i + 1) % border.size()]);
      }
    }
    markWithin(plane);
    const std::vector<Vec2> inner = innerPoints(plane, points, loops, edge);
    Points rounded(static_cast<Eigen::Index>(inner.size()), 3);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      rounded.row(static_cast<Eigen::Index>(i)) << inner[i].transpose(), level;
    }
    if (!inner.empty()) rounded = representable(rounded);
    points.reserve(points.size() + inner.size());
    for (Eigen::Index i = 0; i < rounded.rows(); ++i) {
      points.emplace_back(rounded.row(i).transpose());
      insert(static_cast<int>(points.size()) - 1);
    }
    markWithin(plane);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  for (const auto face : plane.finite_face_handles()) {
    if (face->info() != 1) continue;
    caps.emplace_back(face->vertex(0)->info(), face->vertex(2)->info(), face->vertex(1)->info());
  }
  return caps;
}

} // namespace

std::optional<PlaneCut> cutAbove(const Points& vertices, const Faces& faces, double level,
                                 double merged,
                                 const std::function<Points(const Points&)>& representable) {
  Opened opened(vertices, faces, level);
  opened.round(representable);
  if (merged > 0.0) opened.merge(merged);
  const std::vector<Loop> loops = opened.loops();
  if (loops.empty()) return std::nullopt;
  const std::vector<Eigen::RowVector3i> caps =
      capsOf(loops, level, opened.medianOfBorder(), opened.points(), representable);
  if (caps.empty()) return std::nullopt;
  Eigen::AlignedBox<double, 1> heights;
  for (const Eigen::RowVector3i& face : caps) {
    for (const int v : face)
      heights.extend(Eigen::Matrix<double, 1, 1>(opened.points()[at(v)].z()));
  }
  std::vector<int> faceOf = opened.facesOf();
  faceOf.resize(faceOf.size() + caps.size(), -1);
  return PlaneCut{opened.closedBy(caps), std::move(faceOf), heights.sizes()[0]};
}

} // namespace massprops
