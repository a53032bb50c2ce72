#include "core/answer/delivery.h"

#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"

#include <utility>

namespace massprops {

Delivery deliver(const Solid& solid, const PosedModel& posed, const CavityTask& task,
                 const CavityResult& cavity, const std::vector<int>& vertexOf,
                 const std::function<Points(const Points&)>& representable) {
  Delivery result;
  if (cavity.status != CavityStatus::Found) return result;
  const std::vector<int> places = placesInSolid(posed, vertexOf);
  Points positions = representable(toModel(posed.frame, placed(cavity.inner, places)));
  Faces faces = cavity.cavity.faces;
  if (posed.open) {
    // The strips end in the very points of the model.
    const Eigen::Index n = posed.vertices.rows();
    positions.bottomRows(n) = solid.vertices();
    faces = withoutLids(faces, n);
  }
  Submesh inner = submesh(positions, placed(faces, places));
  result.inner = std::move(inner.mesh);
  if (result.inner.faces.rows() > 0) flip(result.inner.faces);
  result.innerWall = placed(cavity.inspection.wall, places)(inner.vertexOf) * posed.frame.length;
  if (task.model.outer || posed.cavities.faces.rows() > 0) {
    result.outer = TriangleMesh{
        representable(toModel(posed.frame, placed(cavity.outer, posed.vertexOf))), solid.faces()};
  }
  return result;
}

} // namespace massprops
