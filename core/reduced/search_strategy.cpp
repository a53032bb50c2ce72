#include "core/reduced/search_strategy.h"

#include "core/reduced/hollow_body.h"

#include <algorithm>

namespace massprops {

bool isUseless(const CavityTask& task, const CavityResult& cavity) {
  return task.open == nullptr && cavity.status == CavityStatus::Found &&
         !servesBetter(task, hollowBody(task, cavity), inputBody(task));
}

CavityResult bestCavity(CavityTask& task, const std::function<void(double)>& progress) {
  Fillings& fillings = task.model.fillings;
  if (task.bound && task.bound->binding.size() > fillings.size()) fillings = task.bound->binding;
  CavityResult result = searchCavity(task, progress);
  if (isUseless(task, result)) result.status = CavityStatus::NoGain;
  return result;
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
