// The whole story: a solid model and a goal in, an optimised cavity and its proof out.
#pragma once

#include "core/answer/picture.h"
#include "core/base/options.h"
#include "core/base/report.h"
#include "core/base/types.h"

#include <functional>
#include <optional>

namespace massprops {

/// Called from the calling thread with 0 ≤ percent ≤ 100, never decreasing, and a short stage name.
using Progress = std::function<void(int percent, const char* stage)>;

struct Result {
  /// Closed surfaces that bound the cavity, normals pointing into the cavity, so that outer and
  /// inner surface together bound the material. Without vertices and faces when nothing can be
  /// hollowed. Same coordinates as the input.
  TriangleMesh inner;
  /// Distance of every vertex of `inner` from the outer surface.
  Vector innerWall;
  /// The outer surface when it is not the input's: mended, cut flat for a foot, moved, for
  /// `Options::outerUpperBound` > 0, without the cavities that the input had already, or with
  /// components flipped that faced the wrong way.
  std::optional<TriangleMesh> outer;
  /// For `Options::drainHoles`, where the cavities could be drilled: outer and inner surface joined
  /// by the holes, closed, outward; and the plugs that fit into them, in their places.
  std::optional<TriangleMesh> drilled, plugs;
  /// For `Options::showAnswer`, where there is a cavity or a moved outer surface.
  std::optional<Picture> picture;
  Report report;
};

/// Finds the cavity that makes `model` reach `options.goal`. [MAB15]
/// `model`: closed, manifold, coherently oriented components that do not cross; any units, any
/// place. Small defects are mended (repair.h) and reported, others where `options.mend` is on
/// (mending.h).
/// Same input, same options: same output, bit for bit.
/// \throw InvalidInput when the model is not such a surface or an option is absurd;
/// std::runtime_error when a stage fails on it, with what to do about it. A goal out of
/// reach is no error: it is in the report.
Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress = {});

} // namespace massprops
