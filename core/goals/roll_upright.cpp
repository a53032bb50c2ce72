#include "core/goals/roll_upright.h"

#include "core/base/angles.h"
#include "core/base/tolerances.h"
#include "core/goals/tipping.h"
#include "core/physics/rolling_metacentres.h"
#include "core/physics/stable_poses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace massprops {
namespace {

/// A swaying body rolls over steps this high, in diagonals: those of the facets of a round foot.
constexpr double kBarrier = 5e-4;
/// Verdict: a foot that is a facet of a round one leans by as much.
constexpr double kOnAFacet = 2.0; // degrees
/// Faces of the hull that are looked at for a proof, over all boxes of centres of mass: a second or
/// two.
constexpr std::ptrdiff_t kMostFaces = 6000000;
/// What holds the centres of mass is taken wider in such steps, in diagonals, while that will do as
/// well: it is proved in half of the time then, and by coarser means.
constexpr double kWidening = 2e-3;
constexpr int kWidenings = 5;

double tiltOf(const Vec3& down) {
  return std::acos(std::clamp(-down.z(), -1.0, 1.0)) * kDegrees;
}

StablePoses posesOf(const RollingHull& hull, const Moments& massMoments) {
  return stablePoses(hull, massProperties(massMoments).centerOfMass, kBarrier);
}

bool rollsUpright(const StablePoses& poses) {
  return poses.rests.size() == 1 && tiltOf(poses.down) < kOnAFacet;
}

Eigen::AlignedBox3d boundsOf(const Points& points) {
  return {Vec3(points.colwise().minCoeff().transpose()),
          Vec3(points.colwise().maxCoeff().transpose())};
}

class RollUprightGoal final : public Goal {
public:
  RollUprightGoal(const Points& outer, const Weights& weights)
      : hull_(rollingHull(outer)), metacentres_(rollingMetacentres(hull_.vertices)),
        weight_(weights.centerOfMass) {}

  /// c_z + log Σ exp(β (slope·c − height))/β: a smooth maximum.
  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3& c = body.centerOfMass;
    const Vector above = metacentres_.slopes * c.head<2>() - metacentres_.heights;
    const double highest = above.maxCoeff();
    const Vector shares = (kTippingSharpness * (above.array() - highest)).exp();
    const double sum = shares.sum();
    Eigen::RowVector3d slope;
    slope << shares.transpose() * metacentres_.slopes / sum, 1.0;
    GoalValue f;
    f.value = weight_ * (c.z() + highest + std::log(sum) / kTippingSharpness);
    f.gradient = weight_ * slope * massPropertyGradients(body).centerOfMass;
    return f;
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }
  GoalConstraints inequalities(const Moments& /*massMoments*/) const override { return {}; }
  bool usesInertia() const override { return false; }

  std::optional<HalfSpaces> noneCan(const Moments& best,
                                    const std::function<HalfSpaces()>& centres) const override {
    if (rollsUpright(posesAt(massProperties(best).centerOfMass))) return std::nullopt;
    HalfSpaces set = centres();
    std::ptrdiff_t left = kMostFaces;
    std::optional<HalfSpaces> needed = settled(set, left);
    left = std::min(left, 4 * (kMostFaces - left));
    for (int i = 0; needed && i < kWidenings; ++i) {
      set.limits.array() += kWidening;
      std::optional<HalfSpaces> wider = settled(set, left);
      if (!wider) break;
      needed = std::move(wider);
    }
    return needed;
  }

private:
  /// Branch and bound over boxes of centres: each has nothing of the set, or keeps a resting pose
  /// that is not upright, or is cut in two. The half-spaces that this takes. `left`: of the faces
  /// that may be looked at.
  std::optional<HalfSpaces> settled(const HalfSpaces& set, std::ptrdiff_t& left) const {
    std::vector<Eigen::AlignedBox3d> boxes{boundsOf(hull_.vertices)};
    std::vector<Eigen::AlignedBox3d> outside;
    while (!boxes.empty()) {
      const Eigen::AlignedBox3d box = boxes.back();
      boxes.pop_back();
      if (set.miss(box)) {
        outside.push_back(box);
        continue;
      }
      left -= hull_.faces.rows();
      if (left < 0) return std::nullopt;
      if (keepsAnotherRest(box)) continue;
      if (set.contain(box.center()) && rollsUpright(posesAt(box.center()))) return std::nullopt;
      Eigen::Index axis = 0;
      box.sizes().maxCoeff(&axis);
      for (const bool isUpper : {false, true}) {
        Eigen::AlignedBox3d half = box;
        (isUpper ? half.min() : half.max())[axis] = box.center()[axis];
        boxes.push_back(half);
      }
    }
    return fewestThatMiss(set, std::move(outside));
  }

  /// One at least; again and again the half-space that misses most of the boxes that are left.
  static HalfSpaces fewestThatMiss(const HalfSpaces& set, std::vector<Eigen::AlignedBox3d> boxes) {
    std::vector<Eigen::Index> chosen;
    do {
      Eigen::VectorXi missed = Eigen::VectorXi::Zero(set.limits.size());
      for (const Eigen::AlignedBox3d& box : boxes) {
        missed.array() += (set.distancesTo(box).array() > 0.0).cast<int>();
      }
      Eigen::Index best = 0;
      missed.maxCoeff(&best);
      chosen.push_back(best);
      boxes.erase(std::remove_if(boxes.begin(), boxes.end(),
                                 [&](const auto& box) { return set.distancesTo(box)[best] > 0.0; }),
                  boxes.end());
    } while (!boxes.empty());
    HalfSpaces result{Points(chosen.size(), 3), Vector(chosen.size())};
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      result.normals.row(row) = set.normals.row(chosen[i]);
      result.limits[row] = set.limits[chosen[i]];
    }
    return result;
  }

  StablePoses posesAt(const Vec3& centre) const { return stablePoses(hull_, centre, kBarrier); }

  bool keepsAnotherRest(const Eigen::AlignedBox3d& box) const {
    // Higher than the barrier, whatever is rounded.
    const std::vector<HalfSpaces> wells =
        restingWells(hull_, box.center(), kBarrier + kFeasibility, kOnAFacet / kDegrees);
    return std::any_of(wells.begin(), wells.end(),
                       [&](const HalfSpaces& well) { return well.contain(box); });
  }

  RollingHull hull_;
  RollingMetacentres metacentres_;
  double weight_;
};

class RollUprightVerdict final : public Verdict {
public:
  RollUprightVerdict(ContactArea area, const Points& outer)
      : area_(std::move(area)), hull_(rollingHull(outer)) {
    if (!area_.radii && area_.polygon.empty()) area_.radii = Vec2(kFootInradius, kFootInradius);
  }

  bool isReached(const Moments& massMoments) const override {
    return rollsUpright(posesOf(hull_, massMoments));
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const StablePoses poses = posesOf(hull_, massMoments);
    return poses.rests.size() == 1
               ? "it comes to rest " + toString(tiltOf(poses.down)) + "\u00b0 off upright"
               : "it can come to rest on " + std::to_string(poses.rests.size()) +
                     " different faces instead of one";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const StablePoses poses = posesOf(hull_, massMoments);
    report.add("resting_faces_" + suffix, static_cast<int>(poses.rests.size()));
    report.add("rest_tilt_" + suffix, tiltOf(poses.down));
    report.add("rolls_upright_" + suffix, rollsUpright(poses));
  }

  /// What it stands on upright, and the centres of mass plumb above.
  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    std::vector<Vec3> corners;
    for (const Vec2& p : outline(area_)) corners.emplace_back(p.x(), p.y(), 0.0);
    annotations.addLoop(corners, kGroundColour);
    for (const auto& [moments, colour] :
         {std::pair(&before, kBeforeColour), std::pair(&after, kAfterColour)}) {
      const Vec3 c = massProperties(*moments).centerOfMass;
      annotations.addLine(c, {c.x(), c.y(), 0.0}, colour);
    }
    return "contact area";
  }

private:
  ContactArea area_;
  RollingHull hull_;
};

} // namespace

std::unique_ptr<Goal> makeRollUprightGoal(const Points& outer, const Weights& weights) {
  return std::make_unique<RollUprightGoal>(outer, weights);
}

std::unique_ptr<Verdict> makeRollUprightVerdict(const ContactArea& area, const Points& outer) {
  return std::make_unique<RollUprightVerdict>(area, outer);
}

} // namespace massprops
