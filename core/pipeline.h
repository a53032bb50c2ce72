// The whole story: a solid model and a goal in, an optimised cavity and its proof out.
#pragma once

#include "core/answer/picture.h"
#include "core/base/options.h"
#include "core/base/report.h"
#include "core/base/types.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

namespace massprops {

/// Called from the calling thread, often, with 0 ≤ percent ≤ 100, never decreasing, and a short
/// stage name. What it throws ends the run at once and is thrown by it.
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
Result optimizeMassProperties(TriangleMesh model, const Options& options,
                              const Progress& progress = {});

class PreparedModel;

/// A model for several runs. What the options of a run have in common with those of the last one is
/// not found out again: the solid and its tree for another goal or wall, where a cavity may be for
/// another goal with the same wall, skeleton and harmonics for any.
class Model {
public:
  /// As above.
  explicit Model(TriangleMesh model);
  ~Model();
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// The same, byte for byte but for times, as the first run on the model; one at a time, others
  /// wait. \pre `options.representable` rounds alike in all runs. \throw as above; the model can
  /// be used again
  Result run(const Options& options, const Progress& progress = {});

private:
  std::mutex running_;
  std::unique_ptr<PreparedModel> prepared_;
};

} // namespace massprops
