// Optimise, inspect, tighten the bounds where something is wrong, and go on.
#pragma once

#include "core/base/options.h"
#include "core/base/types.h"
#include "core/check/inspection.h"
#include "core/goals/goal.h"
#include "core/model/open_surface.h"
#include "core/optimum/optimal_bound.h"
#include "core/reduced/cavity.h"
#include "core/reduced/offset_problem.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace massprops {

struct CavityTask {
  /// Working frame, the outer surface while it rests, whose openings, if any, have no lids here.
  const TriangleTree& surface;
  const Goal& goal;
  /// What moves, within which bounds; the search works on a copy and chooses the cavity's faces.
  /// An outer surface that moves is what moves inwards, too, no copy.
  OffsetModel model;
  Weights weights = {};
  Moments inputMoments = Moments::Zero(); ///< of the input, existing cavities taken off
  double wall = 0.0;                      ///< working length
  std::optional<OptimalBound> bound = {}; ///< empty: not known
  /// Empty, or what `goal` becomes when the outer surface has moved to these positions.
  std::function<std::unique_ptr<Goal>(const Points&)> goalFor = {};
  /// Rounds working positions to those that can be delivered, still in the working frame.
  std::function<Points(const Points&)> deliverable = {};
  /// Empty, or the same where the caller gets them.
  std::function<Points(const Points&)> stored = {};
  /// Null: the surface is closed. Otherwise the outer surface rests, and is what moves inwards.
  const OpenSurface* open = nullptr;
};

enum class CavityStatus {
  Found,  ///< surfaces that passed inspection; without a cavity where only the outer one moves
  NoRoom, ///< the wall leaves no room for any
  NoGain, ///< there is one, but the solid body serves the goal at least as well
};

/// The work that a search took.
struct SearchEffort {
  int evaluations = 0;
  int rounds = 0;
  double secondsOptimization = 0.0;
  double secondsInspection = 0.0;

  SearchEffort& operator+=(const SearchEffort& other);
};

struct CavityResult {
  CavityStatus status = CavityStatus::NoRoom;
  CavityShape shape = CavityShape::Offset; ///< never Automatic
  /// Delivered positions in the working frame, of an offset surface a row a vertex of what moves,
  /// of an open surface's cavity twice as many.
  Points inner;
  Points outer;                      ///< of the outer surface, moved or not
  CavitySurface cavity;              ///< over `inner`; no faces: nothing can be hollowed
  Vector innerOffsets, outerOffsets; ///< of an offset surface
  /// Made of cubes: the rows of `inner` are the cavity's vertices, as it needs them.
  bool isContour = false;
  double edge = 0.0; ///< of the cubes, working length; 0: not known
  /// Null, or what remembers the distances from the outer surface, which rests.
  std::shared_ptr<ClearanceQuery> clearance;
  Inspection inspection;
  SearchEffort effort;
  std::string stopReason;
};

/// Of the delivered outer surface, its lids included, in the working frame, and of what the model
/// has attached.
Moments outerMoments(const CavityTask& task, const CavityResult& result);

/// The cavity that serves the goal best among those that pass inspection. Where a cavity crosses
/// itself or comes too near to the outer surface the bounds close in, and what is left without room
/// becomes solid; after a bounded number of rounds all that still fails becomes solid, so that
/// what is returned is clean or empty. Where the body is to serve the goal with contents at any
/// level, those that the bound's proof rests on become the task's fillings. Status NoGain: there is
/// a cavity, but the solid body serves the goal at least as well. `progress`: called with the share
/// of the work that is done, 0…1; may be empty.
CavityResult searchCavity(CavityTask& task, const std::function<void(double)>& progress);

} // namespace massprops
