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
std::optional<Result> hollowedOnFoot(PreparedModel& model, std::optional<double>& footDepth,
                                     const Options& options, ProgressBar& bar) {
  // A solid that stands upright on its contact area, diagonal 1, and what it is to do.
  const Preparation prepared = prepare(model, footDepth, options, bar);
  // What moves inwards, its skeleton and harmonics; the best that any cavity could do.
  const Foundation foundation = coarsen(prepared, options, bar);
  // The foot was cut as little as it takes to stand at all: deeper, where that lets a cavity reach
  // the goal.
  if (!footDepth) {
    footDepth = depthOfBetterFoot(prepared, foundation, options);
    if (footDepth) return std::nullopt;
  }
  // What lies behind the walls on one side of the best quadric; or offsets that serve the goal
  // best, within bounds that close in until nothing crosses.
  const Search found = search(prepared, foundation, options, bar);
  // The surfaces in the model's own place, and everything measured on them.
  Result result = deliver(prepared, foundation, found, options, bar);
  result.report = report(prepared, foundation, found, options);
  if (options.showAnswer) draw(prepared, foundation, found, options, bar, result);
  if (!options.printFile.empty()) print(prepared, found, options, bar, result);
  return result;
}

/// \throw DefectiveSurface when the model is no solid
Result hollowed(PreparedModel& model, const Options& options, ProgressBar& bar) {
  std::optional<double> footDepth;
  std::optional<Result> result = hollowedOnFoot(model, footDepth, options, bar);
  if (!result) result = hollowedOnFoot(model, footDepth, options, bar);
  return *std::move(result);
}

/// A model that is no solid is mended first.
Result hollowedOrMended(PreparedModel& model, const Options& options, ProgressBar& bar) {
  if (model.defect(options) == nullptr) {
    try {
      return hollowed(model, options, bar);
    } catch (const DefectiveSurface& surface) {
      if (!options.mend) throw;
      model.noteDefect(options, surface.what());
    }
  }
  try {
    return hollowed(model, options, bar);
  } catch (const DefectiveSurface&) {
    throw DefectiveSurface(*model.defect(options)); // of the given model, which the user knows
  }
}

Result runOn(PreparedModel& model, const Options& options, ProgressBar& bar) {
  const Stopwatch total;
  const ThreadTeam team;
  try {
    if (!options.printFile.empty()) requireWritable(options.printFile);
    Result result = hollowedOrMended(model, options, bar);
    result.report.add("seconds_total", total.seconds());
    bar.show(100, "Done");
    return result;
  } catch (const std::logic_error& failure) {
    // Of CGAL, whose words do not say what to do.
    throw std::runtime_error(std::string("This mesh is too uneven to be calculated with: use "
                                         "Remeshing > Isotropic Explicit Remeshing, then run "
                                         "again. (") +
                             failure.what() + ")");
  }
}

} // namespace

Model::Model(TriangleMesh model) : prepared_(std::make_unique<PreparedModel>(std::move(model))) {}

Model::~Model() = default;

Result Model::run(const Options& options, const Progress& progress) {
  const std::lock_guard lock(running_);
  ProgressBar bar(progress);
  std::optional<Result> result;
  interruptibly([&] { bar.showAgain(); }, [&] { result.emplace(runOn(*prepared_, options, bar)); });
  return *std::move(result);
}

Result optimizeMassProperties(TriangleMesh model, const Options& options,
                              const Progress& progress) {
  return Model(std::move(model)).run(options, progress);
}

} // namespace massprops
