#include "core/goals/filling_levels.h"

#include "core/base/bisection.h"
#include "core/base/infinity.h"
#include "core/base/tolerances.h"
#include "core/mesh/components.h"
#include "core/model/contact.h"
#include "core/physics/hydrostatics.h"

#include <algorithm>

namespace massprops {

FillingLevels::FillingLevels(const Points& vertices, const Faces& faces) {
  constexpr int kCuts = 96;
  for (const Submesh& own : componentMeshes(vertices, faces)) {
    Part part;
    const Points& corners = own.mesh.vertices;
    std::vector<Vec2> seen;
    for (Eigen::Index v = 0; v < corners.rows(); ++v) {
      seen.emplace_back(corners(v, 0), corners(v, 1));
    }
    part.outline = convexHull(seen);
    const double low = corners.col(2).minCoeff();
    const double high = corners.col(2).maxCoeff();
    part.cuts.push_back({low, 0.0, Vec3::Zero()});
    for (int i = 1; i <= kCuts; ++i) {
      const double height = low + (high - low) * i / kCuts;
      const Displacement below = displacement(corners, own.mesh.faces, Vec3::UnitZ(), height);
      part.cuts.push_back({height, below.volume, below.volume * below.centre});
    }
    parts_.push_back(std::move(part));
  }
}

double FillingLevels::worst(const Part& part, const TippingDirection& direction,
                            double tangent) const {
  double farthest = -kInfinity;
  for (const Vec2& p : part.outline) farthest = std::max(farthest, direction.unit.dot(p));
  double most = 0.0;
  for (std::size_t i = 1; i < part.cuts.size(); ++i) {
    const Cut& below = part.cuts[i - 1];
    const Cut& above = part.cuts[i];
    const auto valueOf = [&](const Cut& cut) {
      return direction.unit.dot(cut.first.head<2>()) + tangent * cut.first.z() -
             direction.extent * cut.volume;
    };
    const double height = tangent > 0.0 ? above.height : below.height;
    const double between = (above.volume - below.volume) *
                           std::max(0.0, farthest + tangent * height - direction.extent);
    most = std::max({most, valueOf(below) + between, valueOf(above)});
  }
  return most;
}

bool FillingLevels::stands(const TippingDirection& direction, const Moments& empty, double density,
                           double tangent) const {
  double sum =
      direction.unit.dot(empty.segment<2>(1)) + tangent * empty[3] - direction.extent * empty[0];
  for (const Part& part : parts_) sum += density * worst(part, direction, tangent);
  return sum <= 0.0;
}

bool FillingLevels::stands(const std::vector<TippingDirection>& directions, const Moments& empty,
                           double density, double tangent) const {
  return std::all_of(directions.begin(), directions.end(), [&](const TippingDirection& direction) {
    return stands(direction, empty, density, tangent);
  });
}

double FillingLevels::leastTangent(const std::vector<TippingDirection>& directions,
                                   const Moments& empty, double density) const {
  double least = levelReached(standingConditions(directions), empty);
  for (const TippingDirection& direction : directions) {
    const auto standsAt = [&](double tangent) {
      return stands(direction, empty, density, tangent);
    };
    if (standsAt(least)) continue;
    // The sum grows with the tangent.
    double low = least - 1.0;
    while (!standsAt(low)) low -= 2.0 * (least - low);
    least = lastThatHolds(low, least, kFeasibility, standsAt);
  }
  return least;
}

} // namespace massprops
