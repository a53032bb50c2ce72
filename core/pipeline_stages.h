// The stages of the story that pipeline.cpp tells.
#pragma once

#include "core/answer/print_margins.h"
#include "core/base/interruption.h"
#include "core/base/options.h"
#include "core/base/stopwatch.h"
#include "core/drill/drainage.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/optimum/certificate.h"
#include "core/optimum/optimal_bound.h"
#include "core/overhang/ceiling.h"
#include "core/pipeline.h"
#include "core/prepared_model.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/cavity_search.h"
#include "core/reduced/moving_surface.h"
#include "core/reduced/schedule.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace massprops {

/// Reports to the caller how far the run has come, which may then end it; never goes back.
class ProgressBar {
public:
  explicit ProgressBar(const Progress& progress) : progress_(progress) {}

  void show(int percent, const char* stage) {
    percent_ = std::max(percent_, percent);
    stage_ = stage;
    askNow();
  }
  /// What was shown last, once more.
  void showAgain() const {
    if (progress_) progress_(percent_, stage_);
  }

  /// The share of a stage that takes the bar from one percentage to another.
  std::function<void(double)> within(int from, int to, const char* stage) {
    return [=](double share) { show(from + static_cast<int>((to - from) * share), stage); };
  }

private:
  const Progress& progress_;
  int percent_ = 0;
  const char* stage_ = "";
};

/// What moves inwards, and what carries skeleton and basis: coarse copies, as far as the options
/// allow; or the whole surface, slow, which the copies are measured against.
enum class Resolution { Coarse, Full };

/// The model, checked and put upright, and what it is to do. Neither copied nor moved, for its
/// parts refer to each other.
struct Preparation {
  Preparation(PreparedBody& preparedBody, const Options& options, const Stopwatch& time);
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  PreparedBody& body;
  const Solid& solid;
  const PosedModel& posed;
  const Moments& solidMoments;                             ///< of the outer surface, working frame
  const TriangleMesh keptSolid;                            ///< working frame
  const std::unique_ptr<const TriangleTree> keptSolidTree; ///< null: there are none
  /// The outer surface where it keeps out what lies too near to what stays solid; else null.
  const std::unique_ptr<const TriangleTree> ownSurface;
  const TriangleTree& surface; ///< the outer one, working frame
  const std::unique_ptr<Goal> goal;
  const Schedule schedule;
  const double seconds; ///< all of this took
};

/// How far from selected faces all stays solid; working length.
double solidDepthOf(const PosedModel& posed, const Options& options);

/// \throw as `PreparedModel::body`
Preparation prepare(PreparedModel& model, const std::optional<double>& footDepth,
                    const Options& options, ProgressBar& bar);

/// Whether what is delivered is the best possible cavity: where it is defined, for a closed surface
/// that stays; else the offset surface.
bool isBestPossible(const Options& options, bool isOpen);

/// The best of all cavities within an outer surface.
struct Possible {
  std::shared_ptr<const Room> room;
  OptimalBound bound; ///< of all cells; its body is the best in what the ball reaches
  /// In which it is to serve the goal: where there is more than one, with every level of contents
  /// between the cells.
  Fillings states;
};

/// What moves inwards, if anything does, and what the best of all cavities could do.
struct Foundation {
  std::shared_ptr<const Coarsening> coarse;
  std::optional<Possible> possible; ///< empty: there is no room, or the surface is open or moves
  double secondsBound = 0.0, secondsCrossings = 0.0;
};

/// \throw DefectiveSurface when the model crosses itself
Foundation coarsen(const Preparation& model, const Options& options, ProgressBar& bar,
                   Resolution resolution = Resolution::Coarse);

/// Where no cavity reaches the goal amply on the foot as it was cut: the depth of one on which a
/// cavity does, or comes nearer to it. Empty: that foot is as good as any, or there is none.
std::optional<double> depthOfBetterFoot(const Preparation& model, const Foundation& foundation,
                                        const Options& options);

/// What was asked for, and the best answer.
struct Search {
  CavityTask task;
  CavityResult cavity;
  std::string shapeReason = {}; ///< why it has this shape
  /// Of the model, and of the outer surface as it has become.
  std::unique_ptr<Verdict> verdictBefore = {}, verdictAfter = {};
  double largestWall = 0.0; ///< working length; when the wanted one leaves no room
  double secondsLargestWall = 0.0;
  std::optional<Drainage> drainage = {};      ///< where holes are asked for and there is a cavity
  std::optional<PrintMargins> margins = {};   ///< where the goal is reached
  std::vector<Certificate> certificates = {}; ///< of all the goal's conditions, or none
  double secondsCertificate = 0.0, secondsMargins = 0.0;
};

/// The task refers to `model`, `foundation` and `options`, which must outlive it.
Search search(const Preparation& model, const Foundation& foundation, const Options& options,
              ProgressBar& bar);

/// The best possible cavity whose ceilings carry themselves. \pre overhang_angle is not 0
CavityResult carriedCavity(const Preparation& model, const Possible& possible,
                           const Options& options, CavityTask task);

/// Whether ceilings carry themselves, of a cavity in the working frame.
Ceiling ceilingOf(const Preparation& model, const Options& options, const TriangleMesh& cavity);

/// Holes for the cavity, which is filled where they are not worth it and adjusted to what they take
/// out.
void drain(const Preparation& model, const Options& options, Search& found);

/// The surfaces of the result, without report and picture.
Result deliver(const Preparation& model, const Foundation& foundation, const Search& found,
               const Options& options, ProgressBar& bar);

/// All keys of docs/report.md but `seconds_total`.
Report report(const Preparation& model, const Foundation& foundation, const Search& found,
              const Options& options);

/// The project for a slicer, the keys of the report that speak of it among them.
/// \throw std::runtime_error when its file cannot be written
void print(const Preparation& model, const Search& found, const Options& options, ProgressBar& bar,
           Result& result);

/// The picture, or a key of the report that says why there is none.
void draw(const Preparation& model, const Foundation& foundation, const Search& found,
          const Options& options, ProgressBar& bar, Result& result);

} // namespace massprops
