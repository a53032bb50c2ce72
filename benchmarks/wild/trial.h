// One model, goal, wall and shape of cavity: what the library makes of it, judged by other code.
#pragma once

#include "core/base/options.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace massprops::wild {

struct Asked {
  const char* name;
  GoalKind goal;
  const char* verdict; ///< key of what the goal is judged by
  double small;        ///< a gain below this is judged by itself
  std::function<void(Options&, double diagonal)> change = [](Options&, double) {};
};

/// By name: where it says so the contact is an ellipse with half axes of a fiftieth of the
/// diagonal.
const std::vector<Asked>& goals();

struct Case {
  std::string path;
  const Asked* asked;
  double wallShare; ///< of the diagonal
  CavityShape shape;
};

enum class Outcome {
  Hollow,
  NothingFits,
  Refused,
  EnclosesNothing, ///< by its winding number: not counted
  Unreadable,      ///< not counted
  Failed           ///< an exception that is no refusal, a crash, too much time or memory
};

/// Plain bytes, for it goes from process to process.
struct Trial {
  Outcome outcome = Outcome::Failed;
  char reason[240] = ""; ///< of a refusal or failure, or what is broken
  char repairs[160] = "";
  bool isTurned = false; ///< only with +Y as up axis
  bool isShell = false;  ///< only with `open_surface`
  bool isWrapped = false;
  bool isSolved = false;
  bool isSmall = false; ///< the gain that is possible
  bool isBroken = false;
  bool isJudged = false;
  long faces = 0, innerFaces = 0;
  double before = 0.0, after = 0.0, limit = 0.0, gap = 0.0, violation = 0.0; ///< as reported
  double wall = 0.0;    ///< the least that was measured, in walls; 0: no cavity
  double deepest = 0.0; ///< where nothing fits: in walls, how deep a point may be
  double gain = std::numeric_limits<double>::infinity(); ///< likewise, of *Stand*, in degrees
  double volume = 0.0; ///< of the mended solid, by what the given triangles enclose; 0: unknown
  double moved = 0.0;  ///< by mending, in walls
  double cpu = 0.0, seconds = 0.0, checkSeconds = 0.0; ///< processor, wall; for checking the model
  double megabytes = 0.0;                              ///< above the model
};

/// A cavity that keeps what is promised, or none where other code agrees.
bool isServed(const Trial& trial);
/// Whether there is no cavity although a point may be half a wall deeper than the wall, so that a
/// room is as wide as a wall, and a twentieth of a degree can be gained where it is asked for.
bool isContradicted(const Trial& trial);

struct Limits {
  double seconds = 60.0; ///< of processor time
  double megabytes = 2048.0;
};

/// Limits this process while the library works; `tell` gets the trial before and after it is
/// judged.
void tryOut(const Case& c, const Limits& limits, const std::function<void(const Trial&)>& tell);

} // namespace massprops::wild
