#include "core/overhang/printable_bound.h"

#include "core/base/parallel.h"
#include "core/contour/cavity_contour.h"
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

OptimalBound bestWithin(const PrintableTask& task, const Printable& found) {
  const AdmissibleCells cells = cellsWithin(found.set, task.behindWalls);
  return withBodyWithin(cells, found.bound, task.goal, task.weights, task.solid, task.fillings);
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
    for (int round = 0; round < rounds && !isDone_; ++round) {
      const double share = fill_.add(found_.bound.worth);
      isDone_ = share < kHardlyAnything;
      if (share == 0.0) return;
      takeFill();
    }
  }

  /// Puts columns below what hangs down.
  void stand(const std::vector<Vec3>& tips) {
    fill_.addColumns(tips);
    takeFill();
    isDone_ = false;
  }

  /// As it is delivered, but for finer cubes and what polishing changes.
  Ceiling ceiling() const {
    const std::optional<CavityContour> cavity = cavityContour(found_.set, found_.bound.worth);
    if (!cavity || cavity->contour.mesh.faces.rows() == 0) return {};
    const OverhangWishes& wishes = task_.wishes;
    return ceilingOf(cavity->contour.mesh, wishes.toPrint, wishes.leastAngle, wishes.tipDepth);
  }

private:
  void takeFill() {
    isFilled_ = true;
    found_.set.fill = std::make_shared<const GridFunction>(fill_.function());
    found_.bound = bestWithin(task_, found_);
  }

  const PrintableTask& task_;
  SupportingFill fill_;
  Printable found_;
  bool isDone_ = false, isFilled_ = false;
};

constexpr int kFirstRounds = 2; // they tell which spacing serves best

} // namespace

Printable printable(const PrintableTask& task, const OpenedSet& set, const OptimalBound& possible) {
  constexpr int kRounds = 8;
  constexpr int kColumnRounds = 4;
  std::optional<Printable> first;
  // What is thicker is torn less, what is finer has shorter spans; both cost more.
  struct Attempt {
    double halfThickness, edge;
  };
  for (const Attempt& attempt : {Attempt{0.8, 0.2}, Attempt{1.0, 0.175}, Attempt{1.4, 0.15}}) {
    OverhangWishes tried = task.wishes;
    tried.halfThickness = attempt.halfThickness;
    tried.edge = attempt.edge;
    SupportingFill none(set, tried);
    Printable unfilled{possible, set};
    if (task.within != nullptr) {
      none.keepWithin(*task.within);
      unfilled.set.fill = std::make_shared<const GridFunction>(none.function());
      unfilled.bound = bestWithin(task, unfilled);
    }
    std::optional<Trial> chosen;
    for (const auto& [some, more] : {std::pair(0.0, 0.3), {0.2, 0.13}}) {
      std::optional<Trial> trials[2];
      const auto start = [&](std::optional<Trial>& trial, double spacing) {
        SupportingFill fill = none;
        if (spacing > 0.0) fill.allowPillars(spacing);
        trial.emplace(task, unfilled, std::move(fill));
        trial->improve(kFirstRounds);
      };
      inParallel([&, spacing = some] { start(trials[0], spacing); },
                 [&, spacing = more] { start(trials[1], spacing); });
      for (std::optional<Trial>& trial : trials) {
        if (!chosen || isBetter(trial->bound(), chosen->bound())) chosen.emplace(*std::move(trial));
      }
      if (!chosen->isFilled()) return chosen->found(); // nothing has to be carried
    }
    chosen->improve(kRounds);
    for (int round = 0; round < kColumnRounds; ++round) {
      const Ceiling ceiling = chosen->ceiling();
      if (ceiling.tips.empty() && ceiling.widestSpan <= task.wishes.bridge) return chosen->found();
      if (ceiling.tips.empty()) break;
      chosen->stand(ceiling.tips);
      chosen->improve(kFirstRounds);
    }
    if (!first) first.emplace(chosen->found());
  }
  return *std::move(first);
}

Printable withColumns(const PrintableTask& task, const Printable& printable,
                      const std::vector<Vec3>& tips) {
  Trial trial(task, printable, *printable.filled);
  trial.stand(tips);
  trial.improve(kFirstRounds);
  return trial.found();
}

} // namespace massprops
