#include "core/answer/delivery.h"

#include "core/answer/wall_at_vertices.h"
#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"

#include <utility>

namespace massprops {
namespace {

Vector wallOf(const CavityTask& task, const CavityResult& cavity) {
  return task.model.outer
             ? wallAtVertices(cavity.inner,
                              {cavity.outer, task.surface.faces(), TriangleTree::Order::Spatial},
                              cavity.inspection)
             : wallAtVertices(cavity.inner, task.surface, cavity.inspection);
}

/// Whether the input and the cavity bound the material together.
bool inputServes(const Solid& solid, const PosedModel& posed, const CavityTask& task) {
  const Repairs& repairs = solid.repairs();
  return !task.model.outer && !posed.foot && repairs.replacedCavities == 0 &&
         repairs.flippedComponents == 0 && repairs.mended.empty();
}

/// \param vertices of the solid, moved or not
TriangleMesh skinOf(const Solid& solid, Points vertices) {
  if (solid.isLid().empty()) return {std::move(vertices), solid.faces()};
  return submesh(vertices, solid.skin()).mesh;
}

/// The cavity alone.
Delivery offsetSurface(const Solid& solid, const PosedModel& posed, const CavityTask& task,
                       const CavityResult& cavity, const std::vector<int>& vertexOf,
                       const std::function<Points(const Points&)>& representable) {
  std::vector<int> places = placesInSolid(posed, vertexOf);
  // Those of a finer copy are no vertices of the model; those of caps come last.
  if (!posed.open) {
    for (auto v = static_cast<int>(places.size()); v < cavity.inner.rows(); ++v)
      places.push_back(v);
  }
  Points positions = representable(toModel(posed.frame, placed(cavity.inner, places)));
  Faces faces = cavity.cavity.faces;
  if (posed.open) {
    // The strips end in the very points of the model.
    const Eigen::Index n = posed.vertices.rows();
    positions.bottomRows(n) = solid.vertices();
    faces = withoutLids(faces, n);
  }
  Submesh inner = submesh(positions, placed(faces, places));
  return {std::move(inner.mesh),
          placed(wallOf(task, cavity), places)(inner.vertexOf) * posed.frame.length, std::nullopt};
}

} // namespace

Delivery deliver(const Solid& solid, const PosedModel& posed, const CavityTask& task,
                 const CavityResult& cavity, const std::vector<int>& vertexOf,
                 const std::function<Points(const Points&)>& representable) {
  Delivery result;
  if (cavity.status != CavityStatus::Found) {
    // What stands is the body with its foot, hollow or not.
    if (posed.foot) {
      result.outer = assembled({skinOf(solid, solid.vertices()), solid.cavities()});
    }
    return result;
  }
  if (!cavity.isContour) {
    result = offsetSurface(solid, posed, task, cavity, vertexOf, representable);
  } else {
    // Vertices of what was filled are left out.
    Submesh inner = submesh(representable(toModel(posed.frame, cavity.inner)), cavity.cavity.faces);
    result.inner = std::move(inner.mesh);
    result.innerWall = wallOf(task, cavity)(inner.vertexOf) * posed.frame.length;
  }
  flip(result.inner.faces);
  if (inputServes(solid, posed, task)) return result;
  result.outer =
      skinOf(solid, task.model.outer
                        ? representable(toModel(posed.frame, placed(cavity.outer, posed.vertexOf)))
                        : solid.vertices());
  return result;
}

} // namespace massprops
