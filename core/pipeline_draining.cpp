#include "core/pipeline_stages.h"

#include "core/base/tolerances.h"
#include "core/drill/adjustment.h"
#include "core/goals/registry.h"
#include "core/reduced/hollow_body.h"

#include <functional>
#include <utility>

namespace massprops {
namespace {

bool restsOnTheGround(GoalKind goal) {
  return standsOnContacts(goal) || goal == GoalKind::RollUpright || goal == GoalKind::Spin;
}

/// Of what is lowest along an axis, a share of the diagonal: it lies on the plate or the ground.
constexpr double kOnGround = 2.0 * kContactHeight;

/// Whether a point of the working frame touches the ground, or would as a part of the ellipse that
/// is given for the contact area.
bool isContact(const PosedModel& posed, const Vec3& p, double ground) {
  constexpr double kBelowEllipse = 0.02; // of the diagonal
  if (p.z() < ground + kOnGround) return true;
  return posed.contact.radii && p.z() < ground + kBelowEllipse &&
         signedDistance(posed.contact, p.head<2>()) > 0.0;
}

/// Holes open off the plate, what the print stands on, and what stays solid.
std::function<bool(const Vec3&)> keptClear(const Preparation& model, const Options& options,
                                           const Points& outer, const Vec3& up) {
  const PosedModel& posed = model.posed;
  const double plate = (outer * up).minCoeff() + kOnGround * posed.frame.length;
  const double ground = posed.vertices.col(2).minCoeff();
  const bool rests = restsOnTheGround(options.goal);
  const double depth = model.keptSolidTree ? solidDepthOf(posed, options) : 0.0;
  return [=, &posed, &model](const Vec3& p) {
    if (p.dot(up) < plate) return true;
    const Vec3 working = toWorking(posed.frame, Points(p.transpose())).row(0).transpose();
    if (rests && isContact(posed, working, ground)) return true;
    return model.keptSolidTree != nullptr &&
           model.keptSolidTree->nearest(working, depth * depth).face >= 0;
  };
}

TriangleMesh deliveredOuter(const Preparation& model, const Search& found,
                            const std::function<Points(const Points&)>& representable) {
  if (!found.task.model.outer) return {model.solid.vertices(), model.solid.faces()};
  const Points placedOuter = placed(found.cavity.outer, model.posed.vertexOf);
  return {representable(toModel(model.posed.frame, placedOuter)), model.solid.faces()};
}

/// What the cavity is adjusted to: where something must be exact, the print as it is used, with its
/// plugs; else the state in which it is worse off.
const Moments& decisive(const Options& options, const Search& found, const Drainage& drainage) {
  const bool isPlugged = goalEntry(options.goal).equalities > 0 || options.goal == GoalKind::Float;
  const Moments plugged = hollowBody(found.task, found.cavity).mass;
  const Goal& goal = found.task.goal;
  return isPlugged || largestViolation(goal, plugged) >=
                          largestViolation(goal, plugged - drainage.plugged + drainage.open)
             ? drainage.plugged
             : drainage.open;
}

} // namespace

void drain(const Preparation& model, const Options& options, Search& found) {
  const auto representable = [&](const Points& points) {
    return options.representable ? options.representable(points) : points;
  };
  const TriangleMesh outer = deliveredOuter(model, found, representable);
  const Vec3 up = rotationToUp(buildAxisOf(options)).transpose() * Vec3::UnitZ();
  const DrainTask task{found.task,
                       model.posed.frame,
                       outer,
                       representable,
                       {up, options.drainHoles, options.drainDiameter,
                        keptClear(model, options, outer.vertices, up)}};
  found.drainage = drainage(task, found.cavity);
  Drainage& drained = *found.drainage;
  if (drained.unreached > 0) return;
  // Large triangles at a hole may have corners that move, and then it takes out a little more.
  constexpr int kTimes = 3;
  Moments& attached = found.task.model.attached;
  for (int i = 0; i < kTimes; ++i) {
    attached = drained.plugged;
    attached = decisive(options, found, drained);
    CavityResult better =
        adjusted(found.task, found.cavity, nearHoles(task, found.cavity, drained));
    if (better.inner == found.cavity.inner || !drillAgain(task, better, drained)) break;
    found.cavity = std::move(better);
  }
  attached = drained.plugged;
}

} // namespace massprops
