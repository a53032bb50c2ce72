#include "core/base/angles.h"
#include "core/best/best_cavity.h"
#include "core/overhang/printable_bound.h"
#include "core/overhang/supporting_fill.h"
#include "core/pipeline_stages.h"

#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Working frame.
OverhangWishes overhangWishes(const PosedModel& posed, const Options& options) {
  constexpr double kMore = 5.0; // degrees
  OverhangWishes wishes;
  wishes.toPrint = rotationToUp(buildAxisOf(options)) * posed.frame.rotation.transpose();
  wishes.leastAngle = options.overhangAngle / kDegrees;
  wishes.angle = (options.overhangAngle + kMore) / kDegrees;
  wishes.bridge = kBridge / posed.frame.length;
  wishes.tipDepth = kTipDepth / posed.frame.length;
  return wishes;
}

} // namespace

Ceiling ceilingOf(const Preparation& model, const Options& options, const TriangleMesh& cavity) {
  const OverhangWishes wishes = overhangWishes(model.posed, options);
  return ceilingOf(cavity, wishes.toPrint, wishes.leastAngle, wishes.tipDepth);
}

CavityResult carriedCavity(const Preparation& model, const Possible& possible,
                           const Options& options, CavityTask task) {
  constexpr int kRounds = 4; // columns are put below what hangs down in triangles nevertheless
  const OverhangWishes wishes = overhangWishes(model.posed, options);
  const PrintableTask printing{*model.goal,
                               options.weights,
                               model.solidMoments,
                               possible.states,
                               possible.room->set,
                               possible.room->region,
                               kCells,
                               wishes};
  CavityResult best;
  std::size_t fewest = 0;
  SearchEffort effort;
  const Stopwatch time;
  std::optional<Printable> found = printable(printing, possible.bound);
  for (int round = 0; round < kRounds; ++round) {
    task.bound = found->bound;
    CavityResult cavity = bestPossibleCavity(task, possible.room->set, found->region);
    effort += cavity.effort;
    const bool isFound = cavity.status == CavityStatus::Found;
    const std::vector<Vec3> tips =
        isFound ? ceilingOf(model, options, {cavity.inner, cavity.cavity.faces}).tips
                : std::vector<Vec3>{};
    if (round == 0 || (isFound && tips.size() < fewest)) {
      best = std::move(cavity);
      fewest = tips.size();
    }
    if (tips.empty() || !found->filled || round + 1 == kRounds) break;
    found.emplace(withColumns(printing, *found, tips));
  }
  effort.secondsOptimization = time.seconds() - effort.secondsInspection;
  best.effort = effort;
  return best;
}

} // namespace massprops
