// Holes for all cavities of a body, cut, with what that does to its mass.
#pragma once

#include "core/drill/cutting.h"
#include "core/model/frame.h"
#include "core/physics/moments.h"
#include "core/reduced/cavity_search.h"

#include <functional>
#include <vector>

namespace massprops {

/// What is asked of the holes; model coordinates.
struct DrainWishes {
  Vec3 up = Vec3::UnitZ(); ///< unit, in the build pose
  int fewest = 1;          ///< for every cavity
  double diameter = 0.0;   ///< of the narrowest part of a hole
  /// Whether no hole may open at a point of the outer surface.
  std::function<bool(const Vec3&)> isKeptClear;
};

/// Outer and inner surface joined by holes; model coordinates unless said otherwise.
struct Drainage {
  std::vector<Hole> holes;
  Points openings; ///< middles of the holes' outer rims, a row each
  DrilledBody drilled;
  /// What holes, and holes with plugs in them, add to the body's mass moments; working frame.
  Moments open = Moments::Zero(), plugged = Moments::Zero();
  /// Volumes of what stays in the build pose, and in a print that hangs from the plate, the
  /// largest first.
  std::vector<double> pools, poolsHanging;
  int filled = 0;    ///< cavities not worth their holes, or too narrow for a drill
  int missing = 0;   ///< holes that are wished for, but have no place
  int unreached = 0; ///< all cavities, where none can be drilled or cut: nothing was done then
  double seconds = 0.0;
};

struct DrainTask {
  const CavityTask& search;
  const Frame& frame;
  const TriangleMesh& outer; ///< as it is delivered, outward
  /// Rounds points of the model's coordinates to what the caller can store.
  std::function<Points(const Points&)> representable;
  DrainWishes wishes;
};

/// Clearance of plugs all round, and the largest pool that may stay without a hole of its own;
/// millimetres. Stereolithography keeps parts apart that are to fit from 0.125 mm on [MakeLab];
/// beyond 0.15 mm they sit loosely [HyCube].
constexpr double kPlugClearance = 0.15;
constexpr double kToleratedPool = 100.0;

/// Holes for the cavity, whose components that are not worth them are filled: where doing so
/// changes the goal's objective and constraints less than the holes would, or where no drill fits.
/// \pre the cavity was found and has a component
Drainage drainage(const DrainTask& task, CavityResult& cavity);

/// The same holes through the walls of a cavity that has changed a little; false, and nothing done,
/// where they do not fit.
bool drillAgain(const DrainTask& task, const CavityResult& cavity, Drainage& drainage);

/// For every row of `cavity.inner` whether it lies near a hole.
std::vector<char> nearHoles(const DrainTask& task, const CavityResult& cavity,
                            const Drainage& drainage);

} // namespace massprops
