#include "core/prepared_model.h"

#include "core/base/interruption.h"
#include "core/base/option_pairs.h"
#include "core/base/tolerances.h"
#include "core/goals/registry.h"
#include "core/model/frame.h"
#include "core/model/mending.h"

#include <algorithm>

namespace massprops {
namespace {

/// With a foot and without one, or on two feet of different depth.
constexpr std::size_t kMostBodies = 2;

Points representable(const Options& options, const Points& points) {
  return options.representable ? options.representable(points) : points;
}

/// In single precision where that is far finer than what mending merges: so the same file becomes
/// the same solid whatever the host stores.
Points roundedForMending(const Points& points, bool inFloats, const Options& options) {
  return representable(options, inFloats ? Points(points.cast<float>().cast<double>()) : points);
}

double wallForMending(const TriangleMesh& mesh, const Options& options) {
  const bool isGiven = options.innerLowerBound && *options.innerLowerBound > 0.0;
  return isGiven ? *options.innerLowerBound : kDefaultWall * diagonalOf(mesh.vertices);
}

/// The mesh as a solid. \throw DefectiveSurface where it cannot be mended; InvalidInput as well
/// where it has an opening that is no defect
Solid mendedSolid(const TriangleMesh& mesh, const FeltWall& wall, const Options& options) {
  MendingTask task;
  task.wall = wall;
  task.rotation = rotationToUp(options.upAxis);
  task.keepsOpenings = options.openSurface;
  const bool inFloats = isFloatFineFor(mesh.vertices);
  task.representable = [&](const Points& points) {
    return roundedForMending(points, inFloats, options);
  };
  std::optional<Solid> solid = mended({task.representable(mesh.vertices), mesh.faces}, task);
  if (!solid) throw DefectiveSurface("The surface cannot be mended.");
  return *std::move(solid);
}

Stance stanceFor(const Solid& solid, const Options& options,
                 const std::optional<double>& betterDepth) {
  Stance stance;
  stance.radii = givenRadii(options);
  if (!needsFoot(solid, options)) return stance;
  stance.foot = options.foot;
  if (options.foot == FootCut::Given) stance.footDepth = options.footDepth;
  stance.betterDepth = betterDepth;
  return stance;
}

std::unique_ptr<PreparedBody> makeBody(const std::shared_ptr<const Solid>& solid,
                                       const Options& options, const Stance& stance) {
  if (stance.foot == FootCut::Never)
    return std::make_unique<PreparedBody>(solid, std::nullopt, std::nullopt, options.upAxis,
                                          stance);
  Footing footing = onFoot(*solid, options, stance.betterDepth);
  return std::make_unique<PreparedBody>(std::make_shared<const Solid>(std::move(footing.solid)),
                                        footing.foot, std::move(footing.lowest), options.upAxis,
                                        stance);
}

} // namespace

PreparedBody::PreparedBody(std::shared_ptr<const Solid> itsSolid, const std::optional<Foot>& foot,
                           std::optional<LowestPart> itsLowest, UpAxis up, const Stance& itsStance)
    : stance(itsStance), solid(std::move(itsSolid)), lowest(std::move(itsLowest)),
      posed(posedModel(*solid, up, stance.radii, foot)),
      surface(posed.vertices, posed.open ? posed.open->skin : posed.faces,
              TriangleTree::Order::Spatial),
      solidMoments(moments(posed.vertices, posed.faces)) {}

const std::string* PreparedModel::defect(const Options& options) const {
  const std::optional<std::string>& known = defects_[options.openSurface ? 1 : 0];
  return options.mend && known ? &*known : nullptr;
}

void PreparedModel::noteDefect(const Options& options, const std::string& defect) {
  defects_[options.openSurface ? 1 : 0] = defect;
}

void PreparedModel::prepareSolid(const Options& options,
                                 const std::function<void()>& beforeMending) {
  const bool isMended = defect(options) != nullptr;
  const std::tuple<bool, UpAxis, bool> key(options.openSurface, options.upAxis, isMended);
  const double wall = wallForMending(mesh_, options);
  if (solid_ && key == solidKey_ && (!isMended || mendedFor_.isLike(wall))) return;
  bodies_.clear(); // first: there is memory for one
  solid_.reset();
  if (isMended) {
    beforeMending();
    mendedFor_ = FeltWall(wall);
    solid_ = std::make_shared<const Solid>(mendedSolid(mesh_, mendedFor_, options));
  } else {
    solid_ = std::make_shared<const Solid>(
        makeSolid(mesh_, options.openSurface, rotationToUp(options.upAxis)));
  }
  solidKey_ = key;
}

PreparedBody& PreparedModel::body(const Options& options, const std::optional<double>& betterDepth,
                                  const std::function<void()>& beforeMending) {
  prepareSolid(options, beforeMending);
  requireSensible(options, solid_->diagonal());
  requireEnoughFunctions(options);
  checkpoint();
  const Stance stance = stanceFor(*solid_, options, betterDepth);
  const auto known = std::find_if(bodies_.begin(), bodies_.end(),
                                  [&](const auto& body) { return body->stance == stance; });
  if (known != bodies_.end()) {
    std::rotate(bodies_.begin(), known, known + 1);
  } else {
    if (bodies_.size() == kMostBodies) bodies_.pop_back();
    bodies_.insert(bodies_.begin(), makeBody(solid_, options, stance));
  }
  PreparedBody& body = *bodies_.front();
  takeWishes(options, body.posed);
  requireCompatible(options, body.posed.open.has_value());
  return body;
}

} // namespace massprops
