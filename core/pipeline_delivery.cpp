#include "core/answer/delivery.h"
#include "core/answer/hollowing_report.h"
#include "core/answer/host_rounding.h"
#include "core/answer/skeleton_marks.h"
#include "core/mesh/components.h"
#include "core/model/frame.h"
#include "core/pipeline_stages.h"
#include "core/print/print_project.h"
#include "core/print/whole_file.h"

#include <filesystem>
#include <string>
#include <utility>

namespace massprops {
namespace {

Points representable(const Options& options, const Points& points) {
  return options.representable ? options.representable(points) : points;
}

/// Least distances of the cavity, the strips of an open surface apart.
double leastDistance(const PosedModel& posed, const CavityResult& cavity,
                     const TriangleTree& other) {
  const Eigen::Index n = cavity.inner.rows();
  const Faces& faces = cavity.cavity.faces;
  return ClearanceQuery(other)
      .measure(cavity.inner, posed.open ? withoutStrips(faces, n / 2) : faces, 0.0)
      .least;
}

} // namespace

Result deliver(const Preparation& model, const Foundation& foundation, const Search& found,
               const Options& options, ProgressBar& bar) {
  constexpr int kFound = 97;
  bar.show(kFound, "Report");
  Result result;
  Delivery delivery =
      deliver(model.solid, model.posed, found.task, found.cavity, foundation.coarse->vertexOf,
              [&](const Points& points) { return representable(options, points); });
  result.inner = std::move(delivery.inner);
  result.innerWall = std::move(delivery.innerWall);
  result.outer = std::move(delivery.outer);
  if (found.drainage && !found.drainage->holes.empty()) {
    result.drilled = found.drainage->drilled.body;
    result.plugs = assembled(found.drainage->drilled.plugs);
  }
  return result;
}

Report report(const Preparation& model, const Foundation& foundation, const Search& found,
              const Options& options) {
  const Coarsening& coarse = *foundation.coarse;
  Stages stages;
  stages.repairs = model.solid.repairs();
  if (found.cavity.status != CavityStatus::Found) stages.repairs.replacedCavities = 0; // they stay
  if (model.keptSolidTree && found.cavity.status == CavityStatus::Found) {
    stages.leastWall = leastDistance(model.posed, found.cavity, model.body.surface);
    stages.solidDepth = leastDistance(model.posed, found.cavity, *model.keptSolidTree);
  }
  if (options.overhangAngle > 0.0 && found.cavity.status == CavityStatus::Found) {
    stages.ceiling = ceilingOf(model, options, {found.cavity.inner, found.cavity.cavity.faces});
  }
  stages.skeletonFailures = coarse.skeleton.failedComponents;
  stages.largestWall = found.largestWall;
  stages.rounding = roundingStep(options.representable, model.solid.vertices());
  stages.shapeReason = found.shapeReason;
  stages.secondsCheck = model.seconds + foundation.secondsCrossings;
  stages.secondsCopy = coarse.secondsCopy;
  stages.secondsSkeleton = coarse.secondsSkeleton;
  stages.secondsBasis = coarse.secondsBasis;
  stages.secondsLimit = foundation.secondsBound;
  stages.secondsLargestWall = found.secondsLargestWall;
  stages.drainage = found.drainage ? &*found.drainage : nullptr;
  stages.margins = found.margins;
  stages.secondsMargins = found.secondsMargins;
  stages.certificates = found.certificates;
  stages.secondsCertificate = found.secondsCertificate;
  return hollowingReport(model.posed, found.task, {*found.verdictBefore, *found.verdictAfter},
                         found.cavity, options, stages);
}

void print(const Preparation& model, const Search& found, const Options& options, ProgressBar& bar,
           Result& result) {
  bar.show(98, "Project for the slicer");
  const Solid& solid = model.solid;
  const bool isFound = found.cavity.status == CavityStatus::Found;
  PrintJob job;
  job.isOpen = model.posed.open.has_value();
  job.wall = model.posed.wall * model.posed.frame.length;
  job.outer =
      isFound && result.outer ? *result.outer : submesh(solid.vertices(), solid.skin()).mesh;
  job.cavity = isFound ? result.inner : solid.cavities();
  const std::string name = std::filesystem::u8path(options.printFile).stem().u8string();
  const PrintProject project = printProject(job, options, name);
  describe(project, result.report);
  writeWhole(options.printFile,
             [&](const std::string& path) { writeArchive(path, filesOf(project, result.report)); });
}

void draw(const Preparation& model, const Foundation& foundation, const Search& found,
          const Options& options, ProgressBar& bar, Result& result) {
  if (found.cavity.status != CavityStatus::Found) return;
  bar.show(97, "Picture of the answer");
  PictureResult drawn = pictureOf(model.posed, found.task, *found.verdictAfter, found.cavity);
  result.picture = std::move(drawn.picture);
  if (!result.picture) {
    result.report.add("picture", drawn.failure);
    return;
  }
  if (isBestPossible(options, model.posed.open.has_value())) return;
  const Coarsening& coarse = *foundation.coarse;
  ColouredMesh& skeleton = result.picture->skeleton;
  skeleton = skeletonMarks(coarse.moving->carrier.mesh, coarse.skeleton);
  skeleton.mesh.vertices = toModel(model.posed.frame, skeleton.mesh.vertices);
}

} // namespace massprops
