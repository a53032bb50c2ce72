#include "core/physics/inclination.h"

#include "core/physics/hydrostatics.h"
#include "core/physics/immersion.h"
#include "core/physics/moments.h"

#include <utility>

namespace massprops {

FloatingBody floatingBody(Points vertices, Faces faces, const Vec3& centre, double displaced,
                          Points rims) {
  const Moments whole = moments(vertices, faces, false);
  return {
      std::move(vertices),           std::move(faces), centre, displaced, std::move(rims), whole[0],
      whole.segment<3>(1) / whole[0]};
}

bool sinks(const FloatingBody& body) {
  return body.displaced >= (1.0 + kNeutral) * body.volume;
}

bool isUnderWater(const FloatingBody& body) {
  return body.displaced > (1.0 - kNeutral) * body.volume;
}

Inclination inclined(const FloatingBody& body, const Vec3& up) {
  Inclination result{up, 0.0, body.centre - body.middle, 0.0, Mat3::Zero(), true};
  if (isUnderWater(body)) {
    result.level = (body.vertices * up).maxCoeff();
  } else {
    result.level = levelFor(body.vertices, body.faces, up, body.displaced);
    const Displacement d = displacement(body.vertices, body.faces, up, result.level);
    result.arm = body.centre - d.centre;
    result.stiffness = d.waterplaneMoment / body.displaced;
  }
  result.energy = result.arm.dot(up);
  result.isDry = body.rims.rows() == 0 || (body.rims * up).minCoeff() > result.level;
  return result;
}

double inclinedEnergy(const FloatingBody& body, const Vec3& up) {
  if (isUnderWater(body)) return (body.centre - body.middle).dot(up);
  // level − B·up is the mean depth.
  const Immersion immersion(body.vertices, body.faces, up);
  const double level = immersion.levelFor(body.displaced);
  return body.centre.dot(up) - level + immersion.below(level).depths / body.displaced;
}

Horizontal horizontal(const Vec3& up) {
  Horizontal axes;
  axes.col(0) = up.unitOrthogonal();
  axes.col(1) = up.cross(axes.col(0));
  return axes;
}

} // namespace massprops
