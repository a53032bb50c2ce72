#include "core/goals/goals.h"

#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// The centre of mass keeps off the area's border by this share, for print and ground are not
/// exact.
constexpr double kMargin = 0.1;
constexpr double kPi = 3.14159265358979323846;
/// Constraints of a contact polygon; one with more corners is replaced by an inscribed one.
constexpr std::size_t kMostEdges = 32;

std::vector<Vec2> inscribed(const std::vector<Vec2>& polygon) {
  if (polygon.size() <= kMostEdges) return polygon;
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < kMostEdges; ++i) {
    result.push_back(polygon[i * polygon.size() / kMostEdges]);
  }
  return result;
}

/// Outward normals of the polygon's edges, and directions all round for corners and ellipses.
std::vector<Vec2> tippingDirections(const std::vector<Vec2>& corners) {
  constexpr int kAround = 72;
  std::vector<Vec2> directions;
  directions.reserve(corners.size() + kAround);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    directions.emplace_back(Vec2(edge.y(), -edge.x()).normalized());
  }
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * kPi * i / kAround;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  return directions;
}

class StandGoal final : public Goal {
public:
  StandGoal(ContactArea area, const Weights& weights, double lengthUnit)
      : area_(std::move(area)), corners_(inscribed(area_.polygon)),
        directions_(tippingDirections(corners_)), weight_(weights.centerOfMass),
        lengthUnit_(lengthUnit) {}

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3& c = body.centerOfMass;
    const auto gradient = massPropertyGradients(body).centerOfMass;
    GoalValue f;
    f.value = weight_ * (c.x() * c.x() + c.y() * c.y() + c.z());
    f.gradient = weight_ * Eigen::RowVector3d(2.0 * c.x(), 2.0 * c.y(), 1.0) * gradient;
    return f;
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3& c = body.centerOfMass;
    const auto gradient = massPropertyGradients(body).centerOfMass;
    GoalConstraints g;
    if (area_.radii) {
      // (c_x/r_x)² + (c_y/r_y)² ≤ (1 − margin)², as a length of the smaller radius
      const Vec2 radii = *area_.radii;
      const double length = 0.5 * radii.minCoeff();
      const Vec2 scaledCentre = c.head<2>().cwiseQuotient(radii);
      g.values.resize(2);
      g.gradients.resize(2, 10);
      g.values[0] = length * (scaledCentre.squaredNorm() - (1.0 - kMargin) * (1.0 - kMargin));
      g.gradients.row(0) =
          length * 2.0 * scaledCentre.cwiseQuotient(radii).transpose() * gradient.topRows<2>();
    } else {
      // n_e·c ≤ (1 − margin) h_e for every edge e at distance h_e from the centre
      const auto edges = static_cast<Eigen::Index>(corners_.size());
      g.values.resize(edges + 1);
      g.gradients.resize(edges + 1, 10);
      for (std::size_t e = 0; e < corners_.size(); ++e) {
        const Vec2 p = corners_[e];
        const Vec2 edge = corners_[(e + 1) % corners_.size()] - p;
        const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
        const auto row = static_cast<Eigen::Index>(e);
        g.values[row] = normal.dot(c.head<2>()) - (1.0 - kMargin) * normal.dot(p);
        g.gradients.row(row) = normal.transpose() * gradient.topRows<2>();
      }
    }
    const Eigen::Index last = g.values.size() - 1;
    g.values[last] = -c.z();
    g.gradients.row(last) = -gradient.row(2);
    return g;
  }

  bool usesInertia() const override { return false; }

  bool isReached(const Moments& massMoments) const override { return angle(massMoments) > 0.0; }

  std::string worstViolation(const Moments& massMoments) const override {
    return "the centre of mass lies " +
           toString(largestViolation(*this, massMoments) * lengthUnit_) +
           " outside of the contact area less its safety margin of a tenth";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    report.add("tip_angle_" + suffix, angle(massMoments));
    report.add("stands_" + suffix, isReached(massMoments));
  }

  /// The tipping angle is at least atan t where extent(u) − u·c ≥ t c_z for every horizontal u.
  VerdictBounds verdictBounds(const Moments& massMoments, double level) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3& c = body.centerOfMass;
    const auto gradient = massPropertyGradients(body).centerOfMass;
    const auto rows = static_cast<Eigen::Index>(directions_.size());
    VerdictBounds bounds{{Vector(rows), MomentGradients(rows, 10)}, Vector::Constant(rows, c.z())};
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Vec2& u = directions_[static_cast<std::size_t>(r)];
      bounds.constraints.values[r] = u.dot(c.head<2>()) + level * c.z() - extent(area_, u);
      bounds.constraints.gradients.row(r) =
          u.transpose() * gradient.topRows<2>() + level * gradient.row(2);
    }
    return bounds;
  }

  std::string bestInWords(const Moments& massMoments) const override {
    return "the best possible tipping angle is " + toString(angle(massMoments)) + "\u00b0";
  }

  /// The contact area, and the centres of mass plumb above or beside it.
  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    std::vector<Vec3> corners;
    for (const Vec2& p : outline(area_)) corners.emplace_back(p.x(), p.y(), 0.0);
    annotations.addLoop(corners, kGroundColour);
    const auto addPlumbLine = [&](const Moments& body, Colour colour) {
      const Vec3 c = massProperties(body).centerOfMass;
      annotations.addLine(c, {c.x(), c.y(), 0.0}, colour);
    };
    addPlumbLine(before, kBeforeColour);
    addPlumbLine(after, kAfterColour);
    return "contact area";
  }

private:
  double angle(const Moments& massMoments) const {
    return tippingAngle(area_, massProperties(massMoments).centerOfMass);
  }

  ContactArea area_;
  std::vector<Vec2> corners_;
  std::vector<Vec2> directions_;
  double weight_;
  double lengthUnit_;
};

} // namespace

std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights,
                                    double lengthUnit) {
  return std::make_unique<StandGoal>(area, weights, lengthUnit);
}

} // namespace massprops
