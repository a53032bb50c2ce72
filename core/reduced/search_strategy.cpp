#include "core/reduced/search_strategy.h"

#include "core/reduced/hollow_body.h"
#include "core/reduced/smooth_caps.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Above this gap another search, with other directions, is worth its time.
constexpr double kFarFromBound = 0.02;

bool isFarFromBound(const CavityTask& task, const CavityResult& cavity) {
  // With a weight on smoothness the best body is far from the bound by intention.
  if (!task.bound || cavity.status != CavityStatus::Found || task.weights.smoothness > 0.0) {
    return false;
  }
  return gapToBound(*task.bound, inputBody(task), hollowBody(task, cavity)) > kFarFromBound;
}

/// For the task's fillings as they are.
CavityResult bestOfSearches(const CavityTask& task, const Redirected& steeper,
                            const std::function<void(double)>& progress) {
  CavityResult best = searchCavity(task, progress);
  SearchEffort effort = best.effort;
  if (task.bound && isUseless(task, best)) {
    // What was trimmed off later may have been what the start near the bound lived on.
    CavityTask plain = task;
    plain.bound.reset();
    best = searchCavity(plain, progress);
    effort += best.effort;
  }
  best = withSmoothCaps(task, best);
  if (isFarFromBound(task, best)) {
    CavityTask redirected = steeper();
    redirected.model.fillings = task.model.fillings;
    const CavityResult steep = withSmoothCaps(redirected, searchCavity(redirected, progress));
    effort += steep.effort;
    if (servesBetter(task, steep, best)) best = steep;
  }
  best.effort = effort;
  return best;
}

} // namespace

bool isUseless(const CavityTask& task, const CavityResult& cavity) {
  return task.open == nullptr && cavity.status == CavityStatus::Found &&
         !servesBetter(task, hollowBody(task, cavity), inputBody(task));
}

std::optional<Filling> weakestFilling(const CavityTask& task, const CavityResult& cavity) {
  constexpr int kLevels = 48;
  // In the measure's unit, degrees.
  constexpr double kNoticeable = 0.02;
  const Fillings& known = task.model.fillings;
  if (known.size() < 2 || cavity.status != CavityStatus::Found) return std::nullopt;
  std::optional<double> least = hollowBody(task, cavity).measure;
  if (!least || cavity.cavity.faces.rows() == 0) return std::nullopt;
  *least -= kNoticeable;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const int v : cavity.cavity.faces.reshaped()) {
    low = std::min(low, cavity.inner(v, 2));
    high = std::max(high, cavity.inner(v, 2));
  }
  Fillings levels;
  for (int i = 1; i < kLevels; ++i) {
    levels.push_back({known.back().density, low + (high - low) * i / kLevels});
  }
  const std::vector<Moments> states =
      filledMoments(outerMoments(task, cavity), cavity.inner, cavity.cavity.faces, levels);
  std::optional<Filling> weakest;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double own = *task.goal.measure(states[i]);
    if (own >= *least) continue;
    least = own;
    weakest = levels[i];
  }
  return weakest;
}

CavityResult bestCavity(CavityTask& task, const Redirected& steeper,
                        const std::function<void(double)>& progress) {
  constexpr int kMostRepetitions = 4;
  Fillings& fillings = task.model.fillings;
  CavityResult best = bestOfSearches(task, steeper, progress);
  SearchEffort effort = best.effort;
  std::optional<Filling> weakest = weakestFilling(task, best);
  if (weakest && task.bound) fillings = task.bound->binding;
  if (weakest) fillings.push_back(*weakest);
  for (int i = 0; i < kMostRepetitions && weakest; ++i) {
    CavityResult other = bestOfSearches(task, steeper, progress);
    effort += other.effort;
    // Each is judged at its own weakest level, too.
    weakest = weakestFilling(task, other);
    if (weakest) fillings.push_back(*weakest);
    if (!servesBetter(task, other, best)) break;
    best = std::move(other);
  }
  if (isUseless(task, best)) best.status = CavityStatus::NoGain;
  best.effort = effort;
  return best;
}

double greatestWall(double tooThick, const std::function<bool(double)>& hasRoom,
                    const std::function<void(double)>& progress) {
  constexpr int kHalvings = 10;
  constexpr int kBisections = 3;
  int tried = 0;
  // Near its limit the search finds a cavity at one wall and none at a slightly thinner one, so
  // that a wall counts only when a thinner one works, too.
  const auto works = [&](double wall) {
    const bool result = hasRoom(wall) && hasRoom(0.99 * wall);
    if (progress) progress(static_cast<double>(++tried) / (kHalvings + kBisections));
    return result;
  };
  double found = 0.0;
  for (int i = 0; i < kHalvings && found == 0.0 && tooThick > 0.0; ++i) {
    const double half = 0.5 * tooThick;
    (works(half) ? found : tooThick) = half;
  }
  for (int i = 0; i < kBisections && found > 0.0; ++i) {
    const double middle = 0.5 * (found + tooThick);
    (works(middle) ? found : tooThick) = middle;
  }
  return found;
}

double largestWall(CavityTask task, const std::function<OffsetBounds(double)>& boundsFor,
                   const std::function<void(double)>& progress) {
  const OffsetBounds thinnest = boundsFor(0.0);
  const double tooThick =
      std::min(task.wall, thinnest.upper.cwiseProduct(task.model.field.clearance).maxCoeff());
  const auto hasRoom = [&](double wall) {
    task.wall = wall;
    task.model.inner = boundsFor(wall);
    return leavesRoom(task);
  };
  return greatestWall(tooThick, hasRoom, progress);
}

} // namespace massprops
