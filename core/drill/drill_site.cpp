#include "core/drill/drill_site.h"

#include "core/base/angles.h"
#include "core/base/infinity.h"
#include "core/base/triangle.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Of the radius: how far the drill reaches beyond both surfaces.
constexpr double kBeyond = 0.25;
/// Of the radius: how far beside the rims the surfaces are looked at, within and without.
constexpr double kBeside = 0.5;

/// What a ray that starts in the cavity meets on its way out.
struct Way {
  double inner, outer; ///< lengths to the two surfaces
  Vec3 innerNormal, outerNormal;
  int innerFace;
};

class Probe {
public:
  Probe(const Workpiece& piece, const Vec3& direction, Demands demands)
      : piece_(piece), radius_(0.5 * piece.diameter), demands_(demands), direction_(direction),
        u_(direction.unitOrthogonal()), v_(direction.cross(u_)), step_(1e-6 * piece.diameter) {}

  std::optional<DrillSite> at(const Vec3& entry, const Vec3& normal) const {
    const double slope = normal.dot(direction_);
    if (slope < leastCosine()) return {};
    // Behind the lowest point where a cylinder would meet the tangent plane.
    const double back = radius_ * (kBeyond + std::sqrt(1.0 - slope * slope) / slope);
    if (!wayFrom(entry - back * direction_, direction_)) return {};
    const Vec3 behind = entry - back * direction_;
    double first = kInfinity;
    for (int i = 0; i < Hole::kSides; ++i) {
      const double inner = piece_.cavity.firstHit(behind + radius_ * spoke(i), direction_);
      if (!std::isfinite(inner)) return {};
      first = std::min(first, inner);
    }
    DrillSite site;
    site.hole = {behind + (first - kBeyond * radius_) * direction_, direction_, radius_, 0.0};
    return walkSides(site) && isMiddleClear(site) && isClearAround(site)
               ? std::optional(std::move(site))
               : std::nullopt;
  }

private:
  /// Of angles between drill and normals.
  double leastCosine() const { return demands_ == Demands::Clear ? 0.6 : 0.45; }

  Vec3 spoke(int i) const {
    const double angle = 2.0 * kPi * i / Hole::kSides;
    return std::cos(angle) * u_ + std::sin(angle) * v_;
  }
  Vec3 side(int i) const { return (direction_ + Hole::kWidening * spoke(i)).normalized(); }

  static Vec3 normalAt(const TriangleTree& surface, const Vec3& p, int& face) {
    face = surface.nearest(p).face;
    return areaNormal(surface.vertices(), surface.faces(), face).stableNormalized();
  }

  std::optional<Way> wayFrom(const Vec3& start, const Vec3& direction) const {
    Way way;
    way.inner = piece_.cavity.firstHit(start, direction);
    if (!std::isfinite(way.inner)) return {};
    way.outer = piece_.outer.firstHit(start, direction);
    if (!std::isfinite(way.outer) || way.outer <= way.inner) return {};
    way.innerNormal = normalAt(piece_.cavity, start + way.inner * direction, way.innerFace);
    if (way.innerNormal.dot(direction) < leastCosine()) return {};
    int face = -1;
    way.outerNormal = normalAt(piece_.outer, start + way.outer * direction, face);
    if (way.outerNormal.dot(direction) < leastCosine()) return {};
    // Nothing else on the way, and room outside for what flows out.
    const double wall = way.outer - way.inner;
    const Vec3 within = start + (way.inner + step_) * direction;
    if (piece_.cavity.firstHit(within, direction, wall) < wall) return {};
    if (piece_.others != nullptr && piece_.others->firstHit(within, direction, wall) < wall)
      return {};
    const double room = piece_.diameter;
    const Vec3 outside = start + (way.outer + step_) * direction;
    if (piece_.outer.firstHit(outside, direction, room) < room) return {};
    return way;
  }

  /// Whether the drill comes out where it may, in the middle too.
  bool isMiddleClear(const DrillSite& site) const {
    const auto isClear = [&](const Vec3& start) {
      const std::optional<Way> way = wayFrom(start, direction_);
      return way && !piece_.isKeptClear(start + way->outer * direction_);
    };
    if (!isClear(site.hole.centre)) return false;
    for (int i = 0; i < Hole::kSides; i += 2) {
      if (!isClear(site.hole.centre + kBeside * radius_ * spoke(i))) return false;
    }
    return true;
  }

  bool walkSides(DrillSite& site) const {
    site.innerRim.resize(Hole::kSides, 3);
    site.outerRim.resize(Hole::kSides, 3);
    Vec3 innerSum = Vec3::Zero();
    Vec3 outerSum = Vec3::Zero();
    std::vector<Way> ways;
    double walls = 0.0;
    double farthest = 0.0;
    for (int i = 0; i < Hole::kSides; ++i) {
      const Vec3 start = site.hole.centre + radius_ * spoke(i);
      const std::optional<Way> way = wayFrom(start, side(i));
      if (!way) return false;
      site.innerRim.row(i) = start + way->inner * side(i);
      site.outerRim.row(i) = start + way->outer * side(i);
      if (piece_.isKeptClear(site.outerRim.row(i).transpose())) return false;
      site.innerFaces.push_back(way->innerFace);
      innerSum += way->innerNormal;
      outerSum += way->outerNormal;
      walls += (way->outer - way->inner) / Hole::kSides;
      farthest = std::max(farthest, way->outer * side(i).dot(direction_));
      ways.push_back(*way);
    }
    const double leastAlike = demands_ == Demands::Clear ? 0.85 : 0.75;
    for (const Way& way : ways) {
      if (way.innerNormal.dot(innerSum.normalized()) < leastAlike ||
          way.outerNormal.dot(outerSum.normalized()) < leastAlike) {
        return false;
      }
    }
    site.hole.length = farthest + kBeyond * site.hole.radiusAt(farthest);
    const double mean = site.hole.radiusAt(0.5 * farthest);
    site.removed = kPi * mean * mean * walls;
    return true;
  }

  /// Whether the surfaces go on smoothly around both rims.
  bool isClearAround(const DrillSite& site) const {
    if (demands_ == Demands::Bare) return true;
    for (int i = 0; i < Hole::kSides; i += 2) {
      const Vec3 middle = 0.5 * (site.innerRim.row(i) + site.outerRim.row(i)).transpose();
      const double wall = (site.outerRim.row(i) - site.innerRim.row(i)).norm();
      const Vec3 beside = middle + kBeside * radius_ * spoke(i);
      const double limit = wall + piece_.diameter;
      const double out = piece_.outer.firstHit(beside, direction_, limit);
      const double in = piece_.cavity.firstHit(beside, -direction_, limit);
      if (out >= limit || in >= limit) return false;
      int face = -1;
      const Vec3 outerPoint = beside + out * direction_;
      if (normalAt(piece_.outer, outerPoint, face).dot(direction_) < leastCosine()) return false;
      if (normalAt(piece_.cavity, beside - in * direction_, face).dot(direction_) < leastCosine())
        return false;
      if (piece_.isKeptClear(outerPoint)) return false;
    }
    return true;
  }

  const Workpiece& piece_;
  double radius_;
  Demands demands_;
  Vec3 direction_, u_, v_;
  double step_; ///< past a surface
};

} // namespace

std::optional<DrillSite> drillSite(const Workpiece& piece, const Vec3& entry, const Vec3& normal,
                                   const Vec3& direction, Demands demands) {
  return Probe(piece, direction, demands).at(entry, normal);
}

Outlet outletAt(const DrillSite& site, const TriangleTree& cavity, const Vec3& up) {
  Eigen::Index lowest = 0;
  const double inner = (site.innerRim * up).minCoeff(&lowest);
  const double outer = (site.outerRim * up).minCoeff();
  Outlet outlet;
  outlet.level = std::max(inner, outer);
  double least = kInfinity;
  for (const int v : cavity.faces().row(site.innerFaces[static_cast<std::size_t>(lowest)])) {
    const double height = cavity.vertices().row(v).dot(up);
    if (height >= least) continue;
    least = height;
    outlet.vertex = v;
  }
  return outlet;
}

} // namespace massprops
