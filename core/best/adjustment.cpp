#include "core/best/adjustment.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/goals/level_problem.h"
#include "core/reduced/displacement.h"
#include "core/reduced/hollow_body.h"

#include <optional>

namespace massprops {
namespace {

Body bodyWith(const CavityTask& task, const Points& vertices, const Faces& faces) {
  return hollowBody(task, task.deliverable ? task.deliverable(vertices) : vertices, faces);
}

/// Inward normals of the vertices on one thing, 0 for the others.
Points inwards(const Contour& contour, On on) {
  Points directions = -vertexNormals(contour.mesh.vertices, contour.mesh.faces);
  for (Eigen::Index v = 0; v < directions.rows(); ++v) {
    if (contour.on[static_cast<std::size_t>(v)] != on) directions.row(v).setZero();
  }
  return directions;
}

/// What moves vertices of the contour along the directions; refers to both.
DisplacementTask displacementOf(const CavityTask& task, const Moments& outer, double farthest,
                                const Contour& contour, const Points& directions) {
  return {task.goal,
          task.weights,
          task.model.fillings,
          outer,
          task.model.solidMoments[0],
          contour.mesh.faces,
          directions,
          farthest};
}

/// By the least that keeps the constraints. Empty: they cannot be kept so, or something would have
/// to go outwards that may not.
std::optional<Points> keepingConstraints(const CavityTask& task, const Moments& outer,
                                         double farthest, const Contour& contour, On on,
                                         int& evaluations) {
  constexpr int kRounds = 6;
  const Points& vertices = contour.mesh.vertices;
  Points directions = inwards(contour, on);
  DisplacementTask displacement = displacementOf(task, outer, farthest, contour, directions);
  displacement.movesLeast = true;
  for (int round = 0; round < kRounds && !directions.isZero(0.0); ++round) {
    Points moved = vertices;
    const Displaced done = displace(displacement, moved);
    evaluations += done.evaluations;
    if (done.violation > kFeasibility) return {};
    const Vector ways = (moved - vertices).cwiseProduct(directions).rowwise().sum();
    if (on == On::Cut || ways.minCoeff() >= 0.0) return moved;
    // What would go out of the walls stays.
    for (Eigen::Index v = 0; v < moved.rows(); ++v) {
      if (ways[v] < 0.0) directions.row(v).setZero();
    }
  }
  return {};
}

/// The cut where the goal's level is highest; stays where that serves no better.
int raiseLevel(const CavityTask& task, const Moments& outer, double farthest, Contour& contour) {
  const Points directions = inwards(contour, On::Cut);
  DisplacementTask displacement = displacementOf(task, outer, farthest, contour, directions);
  displacement.raisesLevel = true;
  TriangleMesh& mesh = contour.mesh;
  Points moved = mesh.vertices;
  const int evaluations = displace(displacement, moved).evaluations;
  if (!servesBetter(task, bodyWith(task, moved, mesh.faces),
                    bodyWith(task, mesh.vertices, mesh.faces)))
    return 0;
  mesh.vertices = std::move(moved);
  return evaluations;
}

} // namespace

int adjustOnTriangles(const CavityTask& task, double farthest, Contour& contour) {
  const Moments outer = task.model.solidMoments + task.model.attached;
  if (conditionsOfMeasure(task.goal, task.model.solidMoments))
    return raiseLevel(task, outer, farthest, contour);
  TriangleMesh& mesh = contour.mesh;
  if (task.weights.constraints == 0.0 ||
      bodyWith(task, mesh.vertices, mesh.faces).violation <= kFeasibility)
    return 0;
  int evaluations = 0;
  for (const On on : {On::Cut, On::Wall}) {
    if (auto moved = keepingConstraints(task, outer, farthest, contour, on, evaluations)) {
      mesh.vertices = *std::move(moved);
      return evaluations;
    }
  }
  return 0;
}

} // namespace massprops
