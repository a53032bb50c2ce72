#include "core/overhang/printable_bound.h"

#include "core/contour/cavity_surface.h"
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

  /// As it is delivered, but for what the walls and the constraints change.
  Ceiling ceiling() const {
    const std::optional<QuadricCut> cut = QuadricCut{found_.bound.worth, found_.region.edge};
    Contour contour = dualContour(BorderLattice(task_.set, found_.region, cut));
    removeSmallComponents(task_.set.ball, contour);
    if (contour.mesh.faces.rows() == 0) return {};
    const OverhangWishes& wishes = task_.wishes;
    return ceilingOf(contour.mesh, wishes.toPrint, wishes.leastAngle, wishes.tipDepth);
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
  constexpr int kFirstRounds = 2; // they tell which spacing serves best
  constexpr int kRounds = 8;
  constexpr int kColumnRounds = 4;
  std::optional<Printable> first;
  // What is thicker is torn less, what is finer has shorter spans; both cost more.
  for (const auto& [halfThickness, edge] : {std::pair(0.8, 0.2), {1.0, 0.175}, {1.4, 0.15}}) {
    OverhangWishes tried = task.wishes;
    tried.halfThickness = halfThickness;
    tried.edge = edge;
    const SupportingFill none(task.set, task.region.edge, tried);
    std::optional<Trial> best;
    for (const double spacing : {0.0, 0.3, 0.2, 0.13}) { // of the diagonal, between pillars
      SupportingFill fill = none;
      if (spacing > 0.0) fill.allowPillars(spacing);
      Trial trial(task, {possible, task.region}, std::move(fill));
      trial.improve(kFirstRounds);
      if (!trial.isFilled()) return trial.found(); // nothing has to be carried
      if (!best || isBetter(trial.bound(), best->bound())) best.emplace(std::move(trial));
    }
    best->improve(kRounds);
    for (int round = 0; round < kColumnRounds; ++round) {
      const Ceiling ceiling = best->ceiling();
      if (ceiling.tips.empty() && ceiling.widestSpan <= task.wishes.bridge) return best->found();
      if (ceiling.tips.empty()) break;
      best->stand(ceiling.tips);
      best->improve(kFirstRounds);
    }
    if (!first) first.emplace(best->found());
  }
  return *std::move(first);
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
