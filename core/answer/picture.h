// The answer as meshes: the body cut open, what it is judged by, and the skeleton.
#pragma once

#include "core/mesh/annotations.h"

#include <optional>
#include <string>

namespace massprops {

class Verdict;
struct CavityResult;
struct CavityTask;
struct PosedModel;

/// In model coordinates.
struct Picture {
  /// Half of the material, cut along the vertical plane through the centres of mass before and
  /// after or, where these lie above each other, along the body's greatest width.
  ColouredMesh cutOpen;
  /// The centres of mass before and after, and what the goal draws.
  ColouredMesh marks;
  std::string marksName; ///< "centre of mass and contact area"
  /// The model's mean curvature skeleton with correspondences (skeleton_marks.h).
  ColouredMesh skeleton;
};

struct PictureResult {
  std::optional<Picture> picture;
  std::string failure; ///< why there is none; empty where there is one
};

/// What cannot be drawn is no reason to lose the cavity: only std::bad_alloc is thrown.
/// Without the skeleton. `verdict`: for the outer surface of the result. \pre the search found
/// something
PictureResult pictureOf(const PosedModel& posed, const CavityTask& task, const Verdict& verdict,
                        const CavityResult& cavity);

} // namespace massprops
