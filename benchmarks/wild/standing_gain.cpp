#include "wild/standing_gain.h"

#include "judge/checks.h"
#include "judge/enclosure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace massprops::wild {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Counterclockwise, by Andrew's two chains.
std::vector<Vec2> hullOf(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vec2> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t begin = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= begin + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// In radians, negative outside of the hull.
double tippingAngle(const std::vector<Vec2>& hull, double floor, const Vec3& centre) {
  double angle = 0.5 * kPi;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 way = hull[(i + 1) % hull.size()] - hull[i];
    const double inside = cross(way, centre.head<2>() - hull[i]) / way.norm();
    angle = std::min(angle, std::atan2(inside, centre.z() - floor));
  }
  return angle;
}

} // namespace

double standingGain(const TriangleMesh& model, double wall) {
  const double floor = model.vertices.col(2).minCoeff();
  const double height = model.vertices.col(2).maxCoeff() - floor;
  std::vector<Vec2> lowest;
  for (const auto& p : model.vertices.rowwise())
    if (p.z() <= floor + 1e-6 * height) lowest.emplace_back(p.x(), p.y());
  const std::vector<Vec2> hull = hullOf(lowest);
  const std::vector<testing::Cell> cells = testing::cellsDeeperThan(model, wall, 0.5 * wall);
  const auto moments = testing::quadratureMoments(model);
  const Vec3 firstMoments(moments[1], moments[2], moments[3]);
  const double before = tippingAngle(hull, floor, firstMoments / moments[0]);
  double best = before;
  constexpr int kDirections = 2000;
  std::vector<std::size_t> order(cells.size());
  std::vector<double> along(cells.size());
  for (int i = 0; i < kDirections; ++i) {
    // On a spiral from pole to pole, evenly by area.
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double turn = kPi * (1.0 + std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    const Vec3 direction(r * std::cos(turn), r * std::sin(turn), z);
    for (std::size_t k = 0; k < cells.size(); ++k) along[k] = direction.dot(cells[k].middle);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return along[a] > along[b]; });
    double volume = moments[0];
    Vec3 first = firstMoments;
    for (const std::size_t k : order) {
      volume -= cells[k].volume;
      first -= cells[k].volume * cells[k].middle;
      best = std::max(best, tippingAngle(hull, floor, first / volume));
    }
  }
  return (best - before) * 180.0 / kPi;
}

} // namespace massprops::wild
