#include "core/query/grid_function.h"

#include <algorithm>
#include <cstddef>

namespace massprops {

Sample GridFunction::at(const Vec3& x) const {
  const Eigen::Array3d place = ((grid.rotation * x - grid.origin) / grid.edge)
                                   .array()
                                   .max(0.0)
                                   .min((grid.counts - 1).cast<double>());
  const Eigen::Array3i low = place.cast<int>().min(grid.counts - 2);
  const Eigen::Array3d part = place - low.cast<double>();
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  for (int i = 0; i < 8; ++i) {
    const Eigen::Array3i step(i & 1, i >> 1 & 1, i >> 2);
    const Eigen::Array3i node = low + step;
    const double known =
        values[static_cast<std::size_t>(grid.nodeAt(node.x(), node.y(), node.z()))];
    const Eigen::Array3d sign = 2.0 * step.cast<double>() - 1.0;
    const Eigen::Array3d weight =
        step.cast<double>() * part + (1 - step).cast<double>() * (1.0 - part);
    value += known * weight.prod();
    gradient += known * Vec3(sign.x() * weight.y() * weight.z(), sign.y() * weight.z() * weight.x(),
                             sign.z() * weight.x() * weight.y());
  }
  const double steepness = gradient.norm();
  const Vec3 slope = steepness > 0.0 ? Vec3(gradient / steepness) : Vec3::UnitZ();
  return {grid.edge * value / std::max(steepness, 1.0), grid.rotation.transpose() * slope};
}

} // namespace massprops
