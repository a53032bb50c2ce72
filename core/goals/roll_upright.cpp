#include "core/goals/roll_upright.h"

#include "core/base/angles.h"
#include "core/goals/published_stand.h"
#include "core/goals/stand.h"
#include "core/physics/stable_poses.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Radius of the disc that stands for an area that is a point, in diagonals.
constexpr double kPointRadius = 0.01;
/// A swaying body rolls over steps this high, in diagonals: those of the facets of a round foot.
constexpr double kBarrier = 5e-4;
/// Verdict: what the eye still takes for upright.
constexpr double kUpright = 2.0; // degrees

ContactArea areaOrDisc(ContactArea area) {
  if (!area.radii && area.polygon.empty()) area.radii = Vec2(kPointRadius, kPointRadius);
  return area;
}

class RollUprightVerdict final : public Verdict {
public:
  RollUprightVerdict(const ContactArea& area, const Points& outer, double lengthUnit)
      : stand_(makeStandVerdict(areaOrDisc(area), lengthUnit)), hull_(rollingHull(outer)) {}

  bool isReached(const Moments& massMoments) const override { return isReached(rest(massMoments)); }

  std::string worstViolation(const Moments& massMoments) const override {
    return stand_->worstViolation(massMoments);
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const StablePoses poses = rest(massMoments);
    return poses.count == 1 ? "it comes to rest " + toString(tilt(poses)) + "\u00b0 off upright"
                            : "it can come to rest on " + toString(poses.count) +
                                  " different faces instead of one";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const StablePoses poses = rest(massMoments);
    report.add("resting_faces_" + suffix, poses.count);
    report.add("rest_tilt_" + suffix, tilt(poses));
    report.add("rolls_upright_" + suffix, isReached(poses));
  }

  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    return stand_->draw(before, after, annotations);
  }

private:
  StablePoses rest(const Moments& massMoments) const {
    return stablePoses(hull_, massProperties(massMoments).centerOfMass, kBarrier);
  }
  static double tilt(const StablePoses& poses) {
    return std::acos(std::clamp(-poses.down.z(), -1.0, 1.0)) * kDegrees;
  }
  static bool isReached(const StablePoses& poses) {
    return poses.count == 1 && tilt(poses) < kUpright;
  }

  std::unique_ptr<Verdict> stand_;
  RollingHull hull_;
};

} // namespace

std::unique_ptr<Goal> makeRollUprightGoal(const ContactArea& area, const Weights& weights) {
  return makePublishedStandGoal(areaOrDisc(area), 1.0, weights);
}

std::unique_ptr<Verdict> makeRollUprightVerdict(const ContactArea& area, const Points& outer,
                                                double lengthUnit) {
  return std::make_unique<RollUprightVerdict>(area, outer, lengthUnit);
}

} // namespace massprops
