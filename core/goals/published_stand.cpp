#include "core/goals/published_stand.h"

#include "core/goals/tipping.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The centre of mass keeps off the area's border by this share.
constexpr double kMargin = 0.1;

struct Edge {
  Vec2 normal;  ///< unit, outwards
  double limit; ///< of the centre of mass along the normal
};

class PublishedStandGoal final : public Goal {
public:
  PublishedStandGoal(ContactArea area, double lengthUnit, const Weights& weights)
      : area_(std::move(area)), lengthUnit_(lengthUnit), weight_(weights.centerOfMass) {
    if (area_.radii) return;
    const std::vector<Vec2> normals = edgeNormals(area_.polygon);
    for (std::size_t e = 0; e < normals.size(); ++e)
      edges_.push_back({normals[e], (1.0 - kMargin) * normals[e].dot(area_.polygon[e])});
    sides_ = polygonSides(normals);
  }

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3 c = lengthUnit_ * body.centerOfMass;
    GoalValue f;
    f.value = weight_ * (c.x() * c.x() + c.y() * c.y() + c.z());
    f.gradient = weight_ * lengthUnit_ * Eigen::RowVector3d(2.0 * c.x(), 2.0 * c.y(), 1.0) *
                 massPropertyGradients(body).centerOfMass;
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

private:
  const Edge& worstEdge(const PolygonSide& side, const Vec2& c) const {
    std::size_t worst = side.first;
    const auto beyond = [&](std::size_t e) { return edges_[e].normal.dot(c) - edges_[e].limit; };
    for (std::size_t e = side.first + 1; e < side.last; ++e) {
      if (beyond(e) > beyond(worst)) worst = e;
    }
    return edges_[worst];
  }

  ContactArea area_;
  std::vector<Edge> edges_; ///< of a polygon
  std::vector<PolygonSide> sides_;
  double lengthUnit_;
  double weight_;
};

} // namespace

std::unique_ptr<Goal> makePublishedStandGoal(const ContactArea& area, double lengthUnit,
                                             const Weights& weights) {
  return std::make_unique<PublishedStandGoal>(area, lengthUnit, weights);
}

} // namespace massprops
