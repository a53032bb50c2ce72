#include "core/goals/stand.h"

#include "core/base/angles.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The centre of mass keeps off the area's border by this share, for print and ground are not
/// exact.
constexpr double kMargin = 0.1;
/// Constraints of a contact polygon: the solver's time grows with them. One with more edges has one
/// for all neighbouring edges that turn by no more than a full turn through this number.
constexpr std::size_t kMostSides = 64;

struct Edge {
  Vec2 normal;  ///< unit, outwards
  double limit; ///< of the centre of mass along the normal
};

/// Neighbouring edges, from `first` to before `last`.
struct Side {
  std::size_t first, last;
};

/// The area less its margin, about its centre.
ContactArea withinMargin(const ContactArea& area) {
  return scaled(area, 1.0 / (1.0 - kMargin));
}

std::vector<Edge> edgesOf(const std::vector<Vec2>& polygon) {
  std::vector<Edge> edges;
  edges.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
    edges.push_back({normal, (1.0 - kMargin) * normal.dot(polygon[i])});
  }
  return edges;
}

std::vector<Side> sidesOf(const std::vector<Edge>& edges) {
  const double turn = edges.size() > kMostSides ? 2.0 * kPi / kMostSides : 0.0;
  std::vector<Side> sides;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const bool isNext = turn == 0.0 || sides.empty() ||
                        edges[sides.back().first].normal.dot(edges[e].normal) < std::cos(turn);
    if (isNext) sides.push_back({e, e});
    sides.back().last = e + 1;
  }
  return sides;
}

/// A horizontal direction in which the body may tip over.
struct Direction {
  Vec2 unit;
  double extent; ///< of the contact area
};

/// Outward normals of the polygon's sides, and directions all round for corners and ellipses.
std::vector<Direction> tippingDirections(const ContactArea& area, const std::vector<Edge>& edges,
                                         const std::vector<Side>& sides) {
  constexpr int kAround = 72;
  std::vector<Direction> directions;
  directions.reserve(sides.size() + kAround);
  const auto add = [&](const Vec2& unit) { directions.push_back({unit, extent(area, unit)}); };
  for (const Side& side : sides) add(edges[(side.first + side.last) / 2].normal);
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * kPi * i / kAround;
    add({std::cos(angle), std::sin(angle)});
  }
  return directions;
}

class StandGoal final : public Goal {
public:
  StandGoal(ContactArea area, const Weights& weights)
      : area_(std::move(area)), weight_(weights.centerOfMass) {
    if (!area_.radii) edges_ = edgesOf(area_.polygon);
    sides_ = sidesOf(edges_);
    directions_ = tippingDirections(area_, edges_, sides_);
  }

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
      const auto rows = static_cast<Eigen::Index>(sides_.size());
      g.values.resize(rows + 1);
      g.gradients.resize(rows + 1, 10);
      for (Eigen::Index row = 0; row < rows; ++row) {
        const Edge& edge = worstEdge(sides_[static_cast<std::size_t>(row)], c.head<2>());
        g.values[row] = edge.normal.dot(c.head<2>()) - edge.limit;
        g.gradients.row(row) = edge.normal.transpose() * gradient.topRows<2>();
      }
    }
    const Eigen::Index last = g.values.size() - 1;
    g.values[last] = -c.z();
    g.gradients.row(last) = -gradient.row(2);
    return g;
  }

  bool usesInertia() const override { return false; }

  /// The tipping angle is at least atan t where extent(u) − u·c ≥ t c_z for every horizontal u.
  VerdictBounds verdictBounds(const Moments& massMoments, double level) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3& c = body.centerOfMass;
    const auto gradient = massPropertyGradients(body).centerOfMass;
    const auto rows = static_cast<Eigen::Index>(directions_.size());
    VerdictBounds bounds{{Vector(rows), MomentGradients(rows, 10)}, Vector::Constant(rows, c.z())};
    for (Eigen::Index r = 0; r < rows; ++r) {
      const Direction& u = directions_[static_cast<std::size_t>(r)];
      bounds.constraints.values[r] = u.unit.dot(c.head<2>()) + level * c.z() - u.extent;
      bounds.constraints.gradients.row(r) =
          u.unit.transpose() * gradient.topRows<2>() + level * gradient.row(2);
    }
    return bounds;
  }

private:
  const Edge& worstEdge(const Side& side, const Vec2& c) const {
    std::size_t worst = side.first;
    const auto beyond = [&](std::size_t e) { return edges_[e].normal.dot(c) - edges_[e].limit; };
    for (std::size_t e = side.first + 1; e < side.last; ++e) {
      if (beyond(e) > beyond(worst)) worst = e;
    }
    return edges_[worst];
  }

  ContactArea area_;
  std::vector<Edge> edges_; ///< of a polygon
  std::vector<Side> sides_;
  std::vector<Direction> directions_;
  double weight_;
};

class StandVerdict final : public Verdict {
public:
  StandVerdict(ContactArea area, double lengthUnit)
      : area_(std::move(area)), lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override { return angle(massMoments) > 0.0; }

  std::string worstViolation(const Moments& massMoments) const override {
    const Vec3 c = massProperties(massMoments).centerOfMass;
    const double outside = -signedDistance(withinMargin(area_), c.head<2>());
    return -c.z() > outside
               ? "the centre of mass lies " + toString(-c.z() * lengthUnit_) + " below the ground"
               : "the centre of mass lies " + toString(outside * lengthUnit_) +
                     " outside of the contact area less its safety margin of a tenth";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    report.add("tip_angle_" + suffix, angle(massMoments));
    report.add("stands_" + suffix, isReached(massMoments));
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
  double lengthUnit_;
};

} // namespace

std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights) {
  return std::make_unique<StandGoal>(area, weights);
}

std::unique_ptr<Verdict> makeStandVerdict(const ContactArea& area, double lengthUnit) {
  return std::make_unique<StandVerdict>(area, lengthUnit);
}

} // namespace massprops
