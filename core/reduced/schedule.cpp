#include "core/reduced/schedule.h"

#include "core/reduced/moving_surface.h"

namespace massprops {

Schedule scheduleFor(Eigen::Index vertexCount, int basisSize, bool mayCopy) {
  // Seconds a vertex were measured on one machine; only their ratios count.
  const auto n = static_cast<double>(vertexCount);
  const auto copied = static_cast<double>(movingSize(vertexCount, basisSize));
  const auto carrier = static_cast<double>(carrierSize(vertexCount, basisSize));
  const double moving = mayCopy ? std::min(n, 0.8 * copied) : n;
  const double check = 7e-7 * n;
  const double copy = mayCopy ? 7e-7 * n + 1.2e-6 * copied : 0.0;
  const double skeleton = 2.7e-5 * carrier + 6e-7 * n;
  const double directions = 2.3e-6 * moving;
  const double search = 1.25e-5 * moving + 6e-7 * n;
  const double total = check + copy + skeleton + directions + search;
  const auto percent = [&](double seconds) {
    return static_cast<int>(Schedule::kEnd * seconds / total);
  };
  return {percent(check), percent(check + copy), percent(check + copy + skeleton),
          percent(check + copy + skeleton + directions)};
}

} // namespace massprops
