#include "core/model/contact.h"

#include "core/base/angles.h"
#include "core/base/tolerances.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// About one of its corners: far from the origin the terms would cancel.
double signedArea(const std::vector<Vec2>& polygon) {
  const Vec2& base = polygon.front();
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice += cross(polygon[i] - base, polygon[i + 1] - base);
  }
  return 0.5 * twice;
}

Vec2 centroid(const std::vector<Vec2>& polygon) {
  const Vec2& base = polygon.front();
  Vec2 sum = Vec2::Zero();
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - base;
    const Vec2 b = polygon[i + 1] - base;
    sum += cross(a, b) * (a + b) / 3.0;
    twice += cross(a, b);
  }
  return base + sum / twice;
}

/// What of a convex polygon is at least that far to the left of the line; `along`: unit.
std::vector<Vec2> leftOf(const std::vector<Vec2>& polygon, const Vec2& start, const Vec2& along,
                         double distance) {
  const auto excess = [&](const Vec2& p) { return cross(along, p - start) - distance; };
  std::vector<Vec2> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double atA = excess(a);
    const double atB = excess(b);
    if (atA >= 0.0) rest.push_back(a);
    if ((atA < 0.0) != (atB < 0.0)) rest.emplace_back(a + atA / (atA - atB) * (b - a));
  }
  return rest;
}

/// Inside of the polygon the normal of the edge whose line is nearest, outside the direction from
/// the nearest point.
Vec2 weakestDirection(const std::vector<Vec2>& polygon, const Vec2& c) {
  double inside = std::numeric_limits<double>::infinity();
  double outside = std::numeric_limits<double>::infinity();
  Vec2 normal = Vec2::UnitX();
  Vec2 away = Vec2::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& p = polygon[i];
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - p;
    const double within = cross(edge, c - p) / edge.norm();
    if (within < inside) {
      inside = within;
      normal = Vec2(edge.y(), -edge.x()).normalized();
    }
    const double t = std::clamp(edge.dot(c - p) / edge.squaredNorm(), 0.0, 1.0);
    const Vec2 offset = c - p - t * edge;
    if (offset.norm() < outside) {
      outside = offset.norm();
      away = offset;
    }
  }
  return inside >= 0.0 || outside == 0.0 ? normal : Vec2(away / outside);
}

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// Smooth in the direction's angle: a scan brackets the minimum, golden sections refine it.
Vec2 weakestDirectionOfEllipse(const ContactArea& ellipse, const Vec2& c) {
  const auto marginAt = [&](double angle) {
    return extent(ellipse, direction(angle)) - direction(angle).dot(c);
  };
  constexpr int kSamples = 720;
  const double step = 2.0 * kPi / kSamples;
  double best = 0.0;
  for (int i = 1; i < kSamples; ++i) {
    if (marginAt(i * step) < marginAt(best)) best = i * step;
  }
  double low = best - step;
  double high = best + step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-12) {
    const double p = high - golden * (high - low);
    const double q = low + golden * (high - low);
    (marginAt(p) < marginAt(q) ? high : low) = marginAt(p) < marginAt(q) ? q : p;
  }
  return direction(0.5 * (low + high));
}

} // namespace

std::vector<Vec2> convexHull(const std::vector<Vec2>& points) {
  std::vector<Kernel::Point_2> input;
  input.reserve(points.size());
  for (const Vec2& p : points) input.emplace_back(p.x(), p.y());
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(input.begin(), input.end(), std::back_inserter(hull));
  std::vector<Vec2> result;
  result.reserve(hull.size());
  for (const Kernel::Point_2& p : hull) result.emplace_back(p.x(), p.y());
  return result;
}

GroundContact contactOf(const std::vector<Vec2>& touching, double ground, double diagonal) {
  std::vector<Vec2> hull = convexHull(touching);
  const double smallestArea = std::pow(kContactHeight * diagonal, 2);
  const bool flat = hull.size() >= 3 && signedArea(hull) > smallestArea;
  Vec2 centre = Vec2::Zero();
  if (flat) {
    centre = centroid(hull);
  } else {
    for (const Vec2& p : touching) centre += p / static_cast<double>(touching.size());
  }
  GroundContact contact;
  contact.centre << centre, ground;
  if (flat) {
    for (Vec2& corner : hull) corner -= centre;
    contact.area.polygon = std::move(hull);
  }
  return contact;
}

GroundContact groundContact(const Points& upright, const std::optional<Vec2>& radii,
                            const std::optional<double>& height) {
  const double ground = upright.col(2).minCoeff();
  const double diagonal = (upright.colwise().maxCoeff() - upright.colwise().minCoeff()).norm();
  std::vector<Vec2> touching;
  for (Eigen::Index v = 0; v < upright.rows(); ++v) {
    if (upright(v, 2) <= ground + height.value_or(kContactHeight * diagonal)) {
      touching.emplace_back(upright(v, 0), upright(v, 1));
    }
  }
  GroundContact contact = contactOf(touching, ground, diagonal);
  contact.area.radii = radii;
  return contact;
}

void requireArea(const ContactArea& area) {
  if (!area.polygon.empty() || area.radii) return;
  throw InvalidInput("The model touches the ground only in a point or along a line, so it has "
                     "nothing to stand on: turn it upright, choose another up_axis, cut it flat by "
                     "foot and foot_depth, or set radius_x and radius_y to the size of its "
                     "contact area, then run again.");
}

ContactArea scaled(const ContactArea& area, double length) {
  ContactArea result = area;
  for (Vec2& corner : result.polygon) corner /= length;
  if (result.radii) *result.radii /= length;
  return result;
}

double sizeOf(const ContactArea& area) {
  if (area.radii) return kPi * area.radii->prod();
  return area.polygon.empty() ? 0.0 : signedArea(area.polygon);
}

double inradius(const ContactArea& area) {
  if (area.radii) return area.radii->minCoeff();
  if (area.polygon.empty()) return 0.0;
  // No circle within is of a larger size.
  double low = 0.0;
  double high = std::sqrt(sizeOf(area) / kPi) * (1.0 + 1e-9);
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holdsCircle(area, middle) ? low : high) = middle;
  }
  return low;
}

bool holdsCircle(const ContactArea& area, double radius) {
  if (area.radii) return area.radii->minCoeff() >= radius;
  const std::vector<Vec2>& polygon = area.polygon;
  std::vector<Vec2> centres = polygon;
  for (std::size_t i = 0; i < polygon.size() && !centres.empty(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    centres = leftOf(centres, polygon[i], edge / edge.norm(), radius);
  }
  return !centres.empty();
}

double extent(const ContactArea& area, const Vec2& u) {
  if (area.radii) return area.radii->cwiseProduct(u).norm();
  double farthest = area.polygon.front().dot(u);
  for (const Vec2& corner : area.polygon) farthest = std::max(farthest, corner.dot(u));
  return farthest;
}

std::vector<Vec2> outline(const ContactArea& area) {
  if (!area.radii) return area.polygon;
  constexpr int kCorners = 64;
  std::vector<Vec2> corners;
  corners.reserve(kCorners);
  for (int i = 0; i < kCorners; ++i) {
    corners.emplace_back(area.radii->cwiseProduct(direction(2.0 * kPi * i / kCorners)));
  }
  return corners;
}

Vec2 weakestDirection(const ContactArea& area, const Vec2& c) {
  return area.radii ? weakestDirectionOfEllipse(area, c) : weakestDirection(area.polygon, c);
}

double signedDistance(const ContactArea& area, const Vec2& c) {
  const Vec2 u = weakestDirection(area, c);
  return extent(area, u) - u.dot(c);
}

double tippingAngle(const ContactArea& area, const Vec3& centre) {
  return std::atan2(signedDistance(area, centre.head<2>()), centre.z()) * 180.0 / kPi;
}

} // namespace massprops
