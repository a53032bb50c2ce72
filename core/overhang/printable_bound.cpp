#include "core/overhang/printable_bound.h"

#include "core/contour/dual_contour.h"
#include "core/optimum/admissible_cells.h"
#include "core/overhang/ceiling.h"

#include <memory>
#include <optional>
#include <utility>

namespace massprops {
namespace {

bool isBetter(const OptimalBound& a, const OptimalBound& b) {
  if (a.violation > OptimalBound::kReachable || b.violation > OptimalBound::kReachable)
    return a.violation < b.violation;
  return a.measure && b.measure ? *a.measure > *b.measure : a.objective < b.objective;
}

/// A body and what is filled for it.
class Trial {
public:
  /// `found`: with nothing filled but what `fill` has already.
  Trial(const PrintableTask& task, Printable found, SupportingFill fill)
      : task_(task), fill_(std::move(fill)), found_(std::move(found)) {}

  Printable found() const {
    Printable result = found_;
    if (isFilled_) result.filled = std::make_shared<const SupportingFill>(fill_);
    return result;
  }
  const OptimalBound& bound() const { return found_.bound; }
  bool isFilled() const { return isFilled_; }

  /// Rounds of filling and of finding the best body in what is left, until hardly anything is
  /// filled.
  void improve(int rounds) {
    constexpr double kHardlyAnything = 3e-4; // of the cavity
    for (int round = 0; round < rounds; ++round) {
      const double share = fill_.add(found_.bound.worth);
      if (share > 0.0) takeFill();
      if (share < kHardlyAnything) return;
    }
  }

  /// Puts columns below what hangs down.
  void stand(const std::vector<Vec3>& tips) {
    fill_.addColumns(tips);
    takeFill();
  }

private:
  void takeFill() {
    isFilled_ = true;
    found_.region = within(fill_.function(), task_.region);
    const AdmissibleCells cells = admissibleCells(found_.region, Admissible::Reached, task_.cells);
    found_.bound = withBodyWithin(cells, std::move(found_.bound), task_.goal, task_.weights,
                                  task_.solid, task_.fillings);
  }

  const PrintableTask& task_;
  SupportingFill fill_;
  Printable found_;
  bool isFilled_ = false;
};

} // namespace

Printable printable(const PrintableTask& task, const OptimalBound& possible) {
  constexpr int kRounds = 6;
  const SupportingFill none(task.set, task.region.edge, task.wishes);
  std::optional<Trial> best;
  for (const double spacing : {0.0, 0.2}) { // of the diagonal, between pillars; 0: walls carry
    SupportingFill fill = none;
    if (spacing > 0.0) fill.allowPillars(spacing);
    Trial trial(task, {possible, task.region}, std::move(fill));
    trial.improve(kRounds);
    if (!trial.isFilled()) return trial.found(); // nothing has to be carried
    if (!best || isBetter(trial.bound(), best->bound())) best.emplace(std::move(trial));
  }
  return best->found();
}

Printable withColumns(const PrintableTask& task, const Printable& printable,
                      const std::vector<Vec3>& tips) {
  constexpr int kRounds = 2;
  Trial trial(task, printable, *printable.filled);
  trial.stand(tips);
  trial.improve(kRounds);
  return trial.found();
}

} // namespace massprops
