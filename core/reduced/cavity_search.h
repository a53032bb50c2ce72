// Optimise, inspect, tighten the bounds where something is wrong, and go on.
#pragma once

#include "core/base/types.h"
#include "core/check/inspection.h"
#include "core/goals/goals.h"
#include "core/mesh/decimation.h"
#include "core/model/open_surface.h"
#include "core/optimum/optimal_bound.h"
#include "core/reduced/cavity.h"
#include "core/reduced/offset_problem.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace massprops {

struct CavityTask {
  /// Working frame, the outer surface while it rests, whose openings, if any, have no lids here.
  const TriangleTree& surface;
  /// What moves inwards: that surface with its lids, or a coarse copy of it.
  const Points& vertices;
  const Faces& faces;
  const OffsetField& field;
  const HarmonicBasis& basis; ///< on the proxy, when there is one
  const SparseMatrix& L;      ///< needed where smoothness has a weight
  const Vector& mass;         ///< lumped, total 1
  const Goal& goal;
  Weights weights = {};
  Moments solidMoments = Moments::Zero(); ///< of the outer surface
  Moments inputMoments = Moments::Zero(); ///< of the input, existing cavities taken off
  double fillDensity = 0.0;               ///< as a multiple of the material's density
  double wall = 0.0;                      ///< working length
  OffsetBounds inner = {};
  /// Empty: the outer surface rests. Otherwise it is what moves inwards, too, no copy.
  std::optional<OffsetBounds> outer = {};
  std::optional<OptimalBound> limit = {}; ///< empty: not known
  /// Empty, or what `goal` becomes when the outer surface has moved to these positions.
  std::function<std::unique_ptr<Goal>(const Points&)> goalFor = {};
  /// Rounds working positions to those that can be delivered, still in the working frame.
  std::function<Points(const Points&)> deliverable = {};
  /// Null: the basis lives on the vertices themselves.
  const Interpolation* interpolation = nullptr;
  /// That the basis lives on; null with the former.
  const DecimatedMesh* proxy = nullptr;
  /// Null: the surface is closed. Otherwise the outer surface rests, and is what moves inwards.
  const OpenSurface* open = nullptr;
};

enum class CavityStatus {
  Found,  ///< surfaces that passed inspection; without a cavity where only the outer one moves
  NoRoom, ///< the wall leaves no room for any
  NoGain, ///< there is one, but the solid body serves the goal at least as well
};

struct CavityResult {
  CavityStatus status = CavityStatus::NoRoom;
  /// Delivered positions in the working frame, a row a vertex of what moves; of an open surface's
  /// cavity twice as many.
  Points inner;
  Points outer;         ///< of the outer surface, moved or not
  CavitySurface cavity; ///< over `inner`; no faces: nothing can be hollowed
  Vector innerOffsets, outerOffsets;
  Inspection inspection;
  int evaluations = 0;
  int rounds = 0;
  std::string stopReason;
  double secondsOptimization = 0.0;
  double secondsInspection = 0.0;
};

/// Of the delivered outer surface, its lids included, in the working frame.
Moments outerMoments(const CavityTask& task, const CavityResult& result);

/// Counts the work that went into `other` to that of `result`.
void addEffort(const CavityResult& other, CavityResult& result);

/// The cavity that serves the goal best among those that pass inspection. Where a cavity crosses
/// itself or comes too near to the outer surface the bounds close in, and what is left without room
/// becomes solid; after a bounded number of rounds all that still fails becomes solid, so that
/// what is returned is clean or empty. Where nothing is left, it starts again with offsets nearer
/// to the least ones. `progress`: called with the share of the work that is done, 0…1; may be
/// empty.
CavityResult searchCavity(const CavityTask& task, const std::function<void(double)>& progress);

/// Whether a cavity with the least offsets passes inspection, without optimising anything. Where
/// it does, `searchCavity` finds one, too.
bool leavesRoom(const CavityTask& task);

} // namespace massprops
