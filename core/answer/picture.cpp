#include "core/answer/picture.h"

#include "core/answer/cutaway.h"
#include "core/base/circle.h"
#include "core/goals/verdict.h"
#include "core/mesh/components.h"
#include "core/model/posed_model.h"
#include "core/reduced/cavity_search.h"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace massprops {
namespace {

/// Centres of mass nearer to one vertical than this, in diagonals, say nothing about the cut.
constexpr double kApart = 5e-3;

Vec2 widestDirection(const Points& vertices) {
  Vec2 widest = Vec2::UnitX();
  double width = 0.0;
  for (int i = 0; i < kAround / 2; ++i) {
    const Vec2 u = onCircle(i);
    const Vector along = vertices.leftCols<2>() * u;
    const double extent = along.maxCoeff() - along.minCoeff();
    if (extent <= width) continue;
    width = extent;
    widest = u;
  }
  return widest;
}

/// Empty where the cut fails.
std::optional<Picture> drawn(const PosedModel& posed, const CavityTask& task,
                             const Verdict& verdict, const CavityResult& cavity) {
  const Moments massAfter =
      shellMoments(outerMoments(task, cavity), moments(cavity.inner, cavity.cavity.faces), 1.0,
                   task.model.fillings.front().density);
  const Vec3 before = massProperties(task.inputMoments).centerOfMass;
  const Vec3 after = massProperties(massAfter).centerOfMass;

  const Vec2 lean = (before - after).head<2>();
  const Vec2 along = lean.norm() > kApart ? lean : widestDirection(cavity.outer);
  // Who looks at the front, -y where z is up and +z where y is up, looks at the cut.
  Vec3 normal = Vec3(along.y(), -along.x(), 0.0).normalized();
  if (normal.x() < normal.y()) normal *= -1.0;
  Picture picture;
  // The strips of an open surface end on the outer one.
  const Eigen::Index n = task.open != nullptr ? cavity.outer.rows() : cavity.inner.rows();
  const Submesh material = submesh(stacked(cavity.inner.topRows(n), cavity.outer),
                                   shellOf(task.surface.faces(), cavity.cavity.faces, n));
  const auto cavityVertices = std::count_if(material.vertexOf.begin(), material.vertexOf.end(),
                                            [&](int v) { return v < n; });
  std::optional<ColouredMesh> half = cutaway(material.mesh, cavityVertices, after, normal);
  if (!half) return std::nullopt;
  picture.cutOpen = std::move(*half);

  Annotations annotations(cavity.outer);
  annotations.addBall(before, kBeforeColour);
  annotations.addBall(after, kAfterColour);
  picture.marksName = "centre of mass";
  const std::string drawn = verdict.draw(task.inputMoments, massAfter, annotations);
  if (!drawn.empty()) picture.marksName += " and " + drawn;
  picture.marks = annotations.mesh();

  for (ColouredMesh* part : {&picture.cutOpen, &picture.marks}) {
    part->mesh.vertices = toModel(posed.frame, part->mesh.vertices);
  }
  return picture;
}

} // namespace

PictureResult pictureOf(const PosedModel& posed, const CavityTask& task, const Verdict& verdict,
                        const CavityResult& cavity) {
  try {
    std::optional<Picture> picture = drawn(posed, task, verdict, cavity);
    if (picture) return {std::move(picture), ""};
    return {std::nullopt, "could not be drawn: the body cannot be cut along the plane through its "
                          "centre of mass"};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // CGAL's own words name its source files.
    return {std::nullopt, "could not be drawn: cutting the body open failed"};
  }
}

} // namespace massprops
