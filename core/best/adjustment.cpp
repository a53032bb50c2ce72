#include "core/best/adjustment.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/reduced/displacement.h"
#include "core/reduced/hollow_body.h"

namespace massprops {
namespace {

bool isKept(const CavityTask& task, const Points& vertices, const Faces& faces) {
  const Points stored = task.deliverable ? task.deliverable(vertices) : vertices;
  return hollowBody(task, stored, faces).violation <= kFeasibility;
}

/// Inward normals of the vertices on one thing, 0 for the others.
Points inwards(const Contour& contour, On on) {
  Points directions = -vertexNormals(contour.mesh.vertices, contour.mesh.faces);
  for (Eigen::Index v = 0; v < directions.rows(); ++v) {
    if (contour.on[static_cast<std::size_t>(v)] != on) directions.row(v).setZero();
  }
  return directions;
}

/// By the least that keeps the constraints. Empty: they cannot be kept so, or something would have
/// to go outwards that may not.
std::optional<Points> displaced(const CavityTask& task, double farthest, const Contour& contour,
                                On on, int& evaluations) {
  constexpr int kRounds = 6;
  const Points& vertices = contour.mesh.vertices;
  Points directions = inwards(contour, on);
  const Moments outer = task.model.solidMoments + task.model.attached;
  DisplacementTask displacement{task.goal,
                                task.weights,
                                task.model.fillings,
                                outer,
                                task.model.solidMoments[0],
                                contour.mesh.faces,
                                directions,
                                farthest};
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

} // namespace

int adjustToConstraints(const CavityTask& task, double farthest, Contour& contour) {
  int evaluations = 0;
  if (task.weights.constraints == 0.0 || isKept(task, contour.mesh.vertices, contour.mesh.faces))
    return evaluations;
  for (const On on : {On::Cut, On::Wall}) {
    if (std::optional<Points> moved = displaced(task, farthest, contour, on, evaluations)) {
      contour.mesh.vertices = *std::move(moved);
      return evaluations;
    }
  }
  return evaluations;
}

} // namespace massprops
