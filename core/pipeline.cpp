#include "core/pipeline.h"

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/pipeline_stages.h"
#include "core/print/whole_file.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace massprops {
namespace {

/// Empty: another depth of the foot serves better, which is known from then on.
/// \throw DefectiveSurface when the model is no solid
std::optional<Result> hollowedOnFoot(const TriangleMesh& model, Known& known,
                                     const Options& options, ProgressBar& bar) {
  // A solid that stands upright on its contact area, diagonal 1, and what it is to do.
  const Preparation prepared = prepare(model, options, bar, Resolution::Coarse, known);
  // What moves inwards, its skeleton and harmonics; the best that any cavity could do.
  const Foundation foundation = coarsen(prepared, options, bar);
  // The foot was cut as little as it takes to stand at all: deeper, where that lets a cavity reach
  // the goal.
  if (!known.footDepth) {
    known.footDepth = depthOfBetterFoot(prepared, foundation, options);
    if (known.footDepth) return std::nullopt;
  }
  // Offsets that serve the goal best, within bounds that close in until nothing crosses; where they
  // fall short, what lies behind the walls on one side of the best quadric.
  const Search found = search(prepared, foundation, options, bar);
  // The surfaces in the model's own place, and everything measured on them.
  Result result = deliver(prepared, foundation, found, options, bar);
  result.report = report(prepared, foundation, found, options);
  if (options.showAnswer) draw(prepared, foundation, found, options, bar, result);
  if (!options.printFile.empty()) print(prepared, found, options, bar, result);
  return result;
}

/// \throw DefectiveSurface when the model is no solid
Result hollowed(const TriangleMesh& model, Known known, const Options& options, ProgressBar& bar) {
  std::optional<Result> result = hollowedOnFoot(model, known, options, bar);
  if (!result) result = hollowedOnFoot(model, known, options, bar);
  return *std::move(result);
}

/// A model that is no solid is mended first.
Result hollowedOrMended(const TriangleMesh& model, const Options& options, ProgressBar& bar) {
  std::string defect;
  try {
    return hollowed(model, {}, options, bar);
  } catch (const DefectiveSurface& surface) {
    if (!options.mend) throw;
    defect = surface.what();
  }
  try {
    return hollowed(model, {mend(model, options, bar), {}}, options, bar);
  } catch (const DefectiveSurface&) {
    throw DefectiveSurface(defect); // of the given model, which the user knows
  }
}

Result run(const TriangleMesh& model, const Options& options, const Progress& progress) {
  const Stopwatch total;
  const ThreadTeam team;
  ProgressBar bar(progress);
  if (!options.printFile.empty()) requireWritable(options.printFile);
  Result result = hollowedOrMended(model, options, bar);
  result.report.add("seconds_total", total.seconds());
  bar.show(100, "Done");
  return result;
}

} // namespace

Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress) {
  try {
    return run(model, options, progress);
  } catch (const std::logic_error& failure) {
    // Of CGAL, whose words do not say what to do.
    throw std::runtime_error(std::string("This mesh is too uneven to be calculated with: use "
                                         "Remeshing > Isotropic Explicit Remeshing, then run "
                                         "again. (") +
                             failure.what() + ")");
  }
}

} // namespace massprops
