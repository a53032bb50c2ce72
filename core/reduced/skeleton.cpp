#include "core/reduced/skeleton.h"

#include "core/base/interruption.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/arena_allocator.h"

// The skeletonisation orders its edges by their address [CGAL issue 7511], and its mesh type takes
// its allocator from this macro: nodes from an arena have addresses in the order of their creation.
#define CGAL_ALLOCATOR(T) massprops::ArenaAllocator<T>
#include <CGAL/Polyhedron_3_fwd.h>
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) std::allocator<T>

#include "core/mesh/cgal_mesh.h"

#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Simple_cartesian.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace massprops {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
/// Of this file alone: another instantiation of the skeletonisation, with CGAL's own allocator,
/// would have the same name to the linker, which keeps one of them for both.
struct FlowKernel : Kernel {};

/// Which of the flow's targets, Voronoi poles, are inside of the contracted surface, in the order
/// that the flow asks in. Each of its steps asks twice at the same places, for the matrix and for
/// the right-hand side.
struct PoleAnswers {
  std::size_t poleCount = 0; ///< vertices with a number below have a pole
  std::vector<Vec3> poles;
  std::vector<char> isInside;
  std::size_t next = 0;
  bool isRepetition = true;
};
thread_local PoleAnswers poleAnswers;

template <class HalfedgeMesh>
TriangleMesh trianglesOf(const HalfedgeMesh& mesh) {
  TriangleMesh triangles{Points(static_cast<Eigen::Index>(num_vertices(mesh)), 3),
                         Faces(static_cast<Eigen::Index>(num_faces(mesh)), 3)};
  std::vector<int> placeOf;
  int place = 0;
  for (const auto vertex : vertices(mesh)) {
    if (vertex->id() >= placeOf.size()) placeOf.resize(vertex->id() + 1);
    placeOf[vertex->id()] = place;
    const auto& p = vertex->point();
    triangles.vertices.row(place++) << p.x(), p.y(), p.z();
  }
  Eigen::Index f = 0;
  for (const auto face : faces(mesh)) {
    auto edge = halfedge(face, mesh);
    for (int k = 0; k < 3; ++k, edge = next(edge, mesh)) {
      triangles.faces(f, k) = placeOf[target(edge, mesh)->id()];
    }
    ++f;
  }
  return triangles;
}

template <class HalfedgeMesh>
std::vector<Vec3> polesOf(const HalfedgeMesh& mesh, std::size_t poleCount) {
  std::vector<Vec3> poles;
  for (const auto vertex : vertices(mesh)) {
    if (vertex->is_fixed || vertex->id() >= poleCount) continue;
    poles.emplace_back(vertex->pole.x(), vertex->pole.y(), vertex->pole.z());
  }
  return poles;
}

/// A pole of points that are all but in a plane is no number, and outside.
template <class HalfedgeMesh>
std::vector<char> areInside(const std::vector<Vec3>& poles, const HalfedgeMesh& mesh) {
  const TriangleMesh surface = trianglesOf(mesh);
  if (!surface.vertices.allFinite()) {
    throw std::runtime_error("the mean curvature flow lost its way");
  }
  const TriangleTree tree(surface.vertices, surface.faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  const PointInMesh inside(tree);
  std::vector<char> answers(poles.size());
  constexpr Eigen::Index kChunk = 64;
  forChunks(static_cast<Eigen::Index>(poles.size()), kChunk, [&](const Chunk& chunk) {
    for (auto i = static_cast<std::size_t>(chunk.begin); i < static_cast<std::size_t>(chunk.end);
         ++i) {
      answers[i] = poles[i].allFinite() && inside.contains(poles[i]) ? 1 : 0;
    }
  });
  return answers;
}

} // namespace
} // namespace massprops

/// Takes the place of CGAL's own in the flow, which shoots rays for ever from poles that are no
/// numbers.
template <class HalfedgeMesh, class VertexPoints, class Tree>
class CGAL::Side_of_triangle_mesh<HalfedgeMesh, massprops::FlowKernel, VertexPoints, Tree> {
public:
  explicit Side_of_triangle_mesh(const HalfedgeMesh& mesh) {
    massprops::checkpoint(); // in every step of the flow
    known_.next = 0;
    known_.isRepetition = !known_.isRepetition;
    if (known_.isRepetition) return;
    known_.poles = massprops::polesOf(mesh, known_.poleCount);
    known_.isInside = massprops::areInside(known_.poles, mesh);
  }
  Bounded_side operator()(const massprops::FlowKernel::Point_3& pole) {
    const std::size_t i = known_.next++;
    const massprops::Vec3 asked(pole.x(), pole.y(), pole.z());
    if (asked.allFinite() && asked != known_.poles.at(i)) {
      throw std::logic_error("the mean curvature flow asks in another order");
    }
    return known_.isInside.at(i) != 0 ? ON_BOUNDED_SIDE : ON_UNBOUNDED_SIDE;
  }

private:
  massprops::PoleAnswers& known_ = massprops::poleAnswers;
};

namespace massprops {
namespace {

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh, FlowKernel>;

/// Edges that are shorter collapse while the flow contracts the surface, of the diagonal.
constexpr double kLeastEdge = 0.005;

/// The flow has ended when a step changes the area by less than this share of the first; the steps
/// after it move next to nothing.
constexpr double kSettled = 0.02;

/// How strongly a step of the flow holds vertices where they are, and how strongly the medial axis
/// draws them: four and ten times what CGAL takes. With CGAL's, coarse meshes lead to worse
/// cavities than fine ones; with these, to as good ones (benchmarks/results.md).
constexpr double kHold = 0.4;
constexpr double kDrawnToAxis = 2.0;

double diagonalOf(const Points& vertices) {
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

/// Of one component.
/// \throw std::runtime_error or CGAL::Failure_exception when the flow does not come to an end or
/// loses a vertex
Skeleton contracted(const Points& vertices, const Faces& faces, std::size_t bytesPerVertex) {
  const ArenaScope arena(bytesPerVertex * static_cast<std::size_t>(vertices.rows()));
  poleAnswers = {};
  poleAnswers.poleCount = static_cast<std::size_t>(vertices.rows());
  const auto mesh = surfaceMesh<Mesh>(vertices, faces);
  Skeletonization::Skeleton curves;
  {
    Skeletonization flow(mesh);
    flow.set_min_edge_length(kLeastEdge * diagonalOf(vertices));
    flow.set_area_variation_factor(kSettled);
    flow.set_quality_speed_tradeoff(kHold);
    flow.set_medially_centered_speed_tradeoff(kDrawnToAxis);
    flow.contract_until_convergence();
    flow.convert_to_skeleton(curves);
  }
  Skeleton result;
  result.points = Points::Constant(vertices.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  result.nodes.resize(static_cast<Eigen::Index>(boost::num_vertices(curves)), 3);
  for (const auto node : CGAL::make_range(boost::vertices(curves))) {
    const Kernel::Point_3& p = curves[node].point;
    const Vec3 point(p.x(), p.y(), p.z());
    result.nodes.row(static_cast<Eigen::Index>(node)) = point.transpose();
    for (const auto vertex : curves[node].vertices) {
      result.points.row(static_cast<Eigen::Index>(vertex)) = point.transpose();
    }
  }
  if (!result.points.allFinite()) {
    throw std::runtime_error("the mean curvature flow lost a vertex of this mesh");
  }
  result.segments.resize(static_cast<Eigen::Index>(boost::num_edges(curves)), 2);
  Eigen::Index row = 0;
  for (const auto edge : CGAL::make_range(boost::edges(curves))) {
    result.segments.row(row++) << static_cast<int>(boost::source(edge, curves)),
        static_cast<int>(boost::target(edge, curves));
  }
  return result;
}

Points halfWayThrough(const Points& vertices, const Faces& faces) {
  Points inward = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::RowVector3d normal = areaNormal(vertices, faces, f).transpose();
    for (const int v : faces.row(f)) inward.row(v) -= normal;
  }
  inward.rowwise().normalize();
  const TriangleTree tree(vertices, faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  const Vector half = 0.5 * chords(tree, vertices, inward).cwiseMin(diagonalOf(vertices));
  return vertices + half.asDiagonal() * inward;
}

/// The skeleton, or none where the flow fails. What else goes wrong, a lack of memory or a mistake
/// of this file, is no failure of the flow and passes.
std::optional<Skeleton> contractedOrNone(const TriangleMesh& component,
                                         std::size_t bytesPerVertex) {
  try {
    return contracted(component.vertices, component.faces, bytesPerVertex);
  } catch (const std::runtime_error&) { // among them `ArenaUsedUp`
    return std::nullopt;
  } catch (const CGAL::Failure_exception&) {
    return std::nullopt;
  }
}

void append(Skeleton& whole, const Points& nodes, const Segments& segments) {
  const Eigen::Index before = whole.nodes.rows();
  whole.nodes.conservativeResize(before + nodes.rows(), 3);
  whole.nodes.bottomRows(nodes.rows()) = nodes;
  whole.segments.conservativeResize(whole.segments.rows() + segments.rows(), 2);
  whole.segments.bottomRows(segments.rows()) = segments.array() + static_cast<int>(before);
}

} // namespace

Skeleton meanCurvatureSkeleton(const Points& vertices, const Faces& faces,
                               std::size_t flowBytesPerVertex) {
  Skeleton whole;
  whole.points.resize(vertices.rows(), 3);
  for (const Submesh& part : componentMeshes(vertices, faces)) {
    std::optional<Skeleton> skeleton = contractedOrNone(part.mesh, flowBytesPerVertex);
    if (!skeleton) {
      skeleton = Skeleton{halfWayThrough(part.mesh.vertices, part.mesh.faces), {}, {}};
      ++whole.failedComponents;
    }
    for (std::size_t i = 0; i < part.vertexOf.size(); ++i) {
      whole.points.row(part.vertexOf[i]) = skeleton->points.row(static_cast<Eigen::Index>(i));
    }
    append(whole, skeleton->nodes, skeleton->segments);
  }
  return whole;
}

} // namespace massprops
