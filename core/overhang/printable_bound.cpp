#include "core/overhang/printable_bound.h"

#include "core/base/parallel.h"
#include "core/contour/cavity_contour.h"
#include "core/overhang/ceiling.h"

#include <functional>
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
  Trial(Printable unfilled, SupportingFill fill)
      : fill_(std::move(fill)), found_(std::move(unfilled)) {}

  const Printable& found() const { return found_; }

  /// Rounds of filling and of finding the best body in what is left, until hardly anything is
  /// filled; `best`: such a body in a set.
  void improve(int rounds, const std::function<OptimalBound(const Printable&)>& best) {
    constexpr double kHardlyAnything = 3e-4; // of the cavity
    for (int round = 0; round < rounds && !isDone_; ++round) {
      const double share = fill_.add(found_.bound.worth);
      isDone_ = share < kHardlyAnything;
      if (share == 0.0) return;
      found_.set.fill = std::make_shared<const GridFunction>(fill_.function());
      found_.bound = best(found_);
    }
  }

  /// Puts columns below what hangs down.
  void stand(const std::vector<Vec3>& tips,
             const std::function<OptimalBound(const Printable&)>& best) {
    fill_.addColumns(tips);
    found_.set.fill = std::make_shared<const GridFunction>(fill_.function());
    found_.bound = best(found_);
    isDone_ = false;
  }

private:
  SupportingFill fill_;
  Printable found_;
  bool isDone_ = false;
};

/// As it is delivered, but for what polishing changes.
Ceiling ceilingOf(const Printable& found, const OverhangWishes& wishes) {
  const std::optional<CavityContour> cavity = cavityContour(found.set, found.bound.worth);
  if (!cavity || cavity->contour.mesh.faces.rows() == 0) return {};
  return ceilingOf(cavity->contour.mesh, wishes.toPrint, wishes.leastAngle, wishes.tipDepth);
}

} // namespace

Printable printable(const Goal& goal, const Weights& weights, const Moments& solid,
                    const Fillings& fillings, const RegionParts& behindWalls, const OpenedSet& set,
                    const OptimalBound& possible, const OverhangWishes& wishes,
                    const TriangleMesh* within) {
  const auto best = [&](const Printable& found) {
    const AdmissibleCells cells = cellsOf(partsWithin(found.set, behindWalls));
    return withBodyWithin(cells, found.bound, goal, weights, solid, fillings);
  };
  constexpr int kFirstRounds = 2; // they tell which spacing serves best
  constexpr int kRounds = 8;
  constexpr int kColumnRounds = 4;
  std::optional<Printable> first;
  // What is thicker is torn less, what is finer has shorter spans; both cost more.
  struct Attempt {
    double halfThickness, edge;
  };
  for (const Attempt& attempt : {Attempt{0.8, 0.2}, Attempt{1.0, 0.175}, Attempt{1.4, 0.15}}) {
    OverhangWishes tried = wishes;
    tried.halfThickness = attempt.halfThickness;
    tried.edge = attempt.edge;
    SupportingFill none(set, tried);
    Printable unfilled{possible, set};
    if (within != nullptr) {
      none.keepWithin(*within);
      unfilled.set.fill = std::make_shared<const GridFunction>(none.function());
      unfilled.bound = best(unfilled);
    }
    std::optional<Trial> chosen;
    for (const auto& [some, more] : {std::pair(0.0, 0.3), {0.2, 0.13}}) {
      std::optional<Trial> trials[2];
      const auto start = [&](std::optional<Trial>& trial, double spacing) {
        SupportingFill fill = none;
        if (spacing > 0.0) fill.allowPillars(spacing);
        trial.emplace(unfilled, std::move(fill));
        trial->improve(kFirstRounds, best);
      };
      inParallel([&, spacing = some] { start(trials[0], spacing); },
                 [&, spacing = more] { start(trials[1], spacing); });
      for (std::optional<Trial>& trial : trials) {
        if (!chosen || isBetter(trial->found().bound, chosen->found().bound))
          chosen.emplace(*std::move(trial));
      }
      if (chosen->found().set.fill == unfilled.set.fill)
        return chosen->found(); // nothing has to be carried
    }
    chosen->improve(kRounds, best);
    for (int round = 0; round < kColumnRounds; ++round) {
      const Ceiling ceiling = ceilingOf(chosen->found(), wishes);
      if (ceiling.tips.empty() && ceiling.widestSpan <= wishes.bridge) return chosen->found();
      if (ceiling.tips.empty()) break;
      chosen->stand(ceiling.tips, best);
      chosen->improve(kFirstRounds, best);
    }
    if (!first) first.emplace(chosen->found());
  }
  return *std::move(first);
}

} // namespace massprops
