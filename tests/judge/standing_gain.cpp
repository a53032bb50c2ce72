#include "judge/standing_gain.h"

#include "judge/checks.h"
#include "judge/enclosure.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

namespace massprops::testing {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

/// inwards·p − offset: how far p is within an edge of the hull.
struct Edge {
  Vec2 inwards; ///< unit
  double offset;
};

/// Of the hull of the lowest vertices; none where it has no area.
std::vector<Edge> edgesOfContact(const TriangleMesh& model, double floor) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const double height = model.vertices.col(2).maxCoeff() - floor;
  std::vector<Kernel::Point_2> lowest;
  for (const auto& p : model.vertices.rowwise())
    if (p.z() <= floor + 1e-6 * height) lowest.emplace_back(p.x(), p.y());
  std::vector<Kernel::Point_2> hull; // counterclockwise
  CGAL::convex_hull_2(lowest.begin(), lowest.end(), std::back_inserter(hull));
  std::vector<Edge> edges;
  if (hull.size() < 3) return edges;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Kernel::Vector_2 way = hull[(i + 1) % hull.size()] - hull[i];
    const Vec2 inwards = Vec2(-way.y(), way.x()).normalized();
    edges.push_back({inwards, inwards.dot(Vec2(hull[i].x(), hull[i].y()))});
  }
  return edges;
}

/// The tipping angle's tangent.
double firmness(const std::vector<Edge>& edges, double floor, const Vec3& centre) {
  double inside = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges)
    inside = std::min(inside, edge.inwards.dot(centre.head<2>()) - edge.offset);
  return inside / (centre.z() - floor);
}

/// Those that a ball of this radius reaches around one that is at least so deep.
std::vector<Cell> reached(const std::vector<Cell>& cells, double depth, double radius) {
  // Middles by cubes as wide as the radius: one that is near enough is next door.
  std::map<std::array<long, 3>, std::vector<Vec3>> places;
  const auto placeOf = [&](const Vec3& p) {
    return std::array<long, 3>{std::lround(p.x() / radius), std::lround(p.y() / radius),
                               std::lround(p.z() / radius)};
  };
  for (const Cell& cell : cells)
    if (cell.depth >= depth) places[placeOf(cell.middle)].push_back(cell.middle);
  const auto isReached = [&](const Vec3& p) {
    const std::array<long, 3> place = placeOf(p);
    for (int i = 0; i < 27; ++i) {
      const auto there =
          places.find({place[0] + i % 3 - 1, place[1] + i / 3 % 3 - 1, place[2] + i / 9 - 1});
      if (there == places.end()) continue;
      for (const Vec3& q : there->second)
        if ((p - q).norm() <= radius) return true;
    }
    return false;
  };
  std::vector<Cell> result;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(result),
               [&](const Cell& cell) { return isReached(cell.middle); });
  return result;
}

} // namespace

StandingGain standingGain(const TriangleMesh& model, double wall, double side) {
  const double floor = model.vertices.col(2).minCoeff();
  const std::vector<Edge> edges = edgesOfContact(model, floor);
  if (edges.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  const double half = std::sqrt(0.75) * side;
  const std::vector<Cell> cells =
      reached(cellsDeeperThan(model, wall, side), 1.5 * wall - half, 0.5 * wall + half);
  const auto moments = quadratureMoments(model);
  const Vec3 firstMoments(moments[1], moments[2], moments[3]);
  const double solid = firmness(edges, floor, firstMoments / moments[0]);
  double best = solid;
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
      best = std::max(best, firmness(edges, floor, first / volume));
    }
  }
  constexpr double kDegrees = 180.0 / kPi;
  return {std::atan(solid) * kDegrees, std::atan(best) * kDegrees};
}

} // namespace massprops::testing
