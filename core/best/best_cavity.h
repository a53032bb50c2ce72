// The best possible cavity as a surface.
#pragma once

#include "core/contour/opened_set.h"
#include "core/reduced/cavity_search.h"

#include <functional>

namespace massprops {

/// What a cavity may take.
struct Deliverable {
  OpenedSet set;
  AdmissibleCells cells; ///< of it
};

/// What a cavity may take behind a wall, as finely as it is delivered: the finer, the narrower its
/// rooms. `behindWall`: all that lies there, `cells`: what these are.
Deliverable deliverableSet(const TriangleTree& surface, double wall, const RegionParts& behindWall,
                           const AdmissibleCells& cells);

/// Edge of cubes of which one corner at least is in any room as wide as the ball, in its widths.
constexpr double kResolves = 0.55;

/// Whether finer cubes than those of the set are tried where these lose too much.
enum class Cubes { AsFineAsItTakes, OfTheSet };

/// The part of what can be delivered on the positive side of the bound's quadric: its surface,
/// adjusted so that the body of these triangles keeps the constraints. Passed inspection, as with
/// `searchCavity`; status NoGain: the solid body serves the goal at least as well. The outer
/// surface rests. \pre there is a bound, the surface is closed
CavityResult bestPossibleCavity(const CavityTask& task, const OpenedSet& deliverable,
                                Cubes cubes = Cubes::AsFineAsItTakes);

/// As `largestWall`, for a best possible cavity.
double largestWallForBestPossible(const CavityTask& task,
                                  const std::function<void(double)>& progress);

} // namespace massprops
