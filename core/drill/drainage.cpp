#include "core/drill/drainage.h"

#include "core/base/stopwatch.h"
#include "core/drill/hole_search.h"
#include "core/mesh/components.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace massprops {
namespace {

/// One closed cavity, and the holes for it.
struct Room {
  TriangleMesh mesh; ///< model coordinates, outward
  std::vector<DrillSite> sites;
};

TriangleMesh inModel(const DrainTask& task, const CavityResult& cavity) {
  return {task.representable(toModel(task.frame, cavity.inner)), cavity.cavity.faces};
}

Moments inWorking(const DrainTask& task, const TriangleMesh& mesh) {
  return moments(toWorking(task.frame, mesh.vertices), mesh.faces);
}

/// Of a point mass.
Moments lumpAt(const Vec3& p, double mass) {
  Moments m;
  m << 1.0, p, p.cwiseAbs2(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return mass * m;
}

/// How much a change of the body's mass matters to the goal.
double effect(const CavityTask& task, const Moments& body, const Moments& change) {
  const auto valueOf = [&](const Moments& mass) {
    return momentObjective(task.goal, task.weights, {mass}, mass[0] / task.model.solidMoments[0]);
  };
  const double violation =
      task.weights.constraints > 0.0
          ? largestViolation(task.goal, body + change) - largestViolation(task.goal, body)
          : 0.0;
  return std::abs(valueOf(body + change) - valueOf(body)) + std::abs(violation);
}

bool isWorthItsHoles(const DrainTask& task, const Moments& body, const Room& room) {
  if (room.sites.empty()) return false;
  Moments taken = Moments::Zero();
  for (const DrillSite& site : room.sites) {
    const Vec3 middle = 0.5 * (site.innerRim.colwise().mean() + site.outerRim.colwise().mean());
    const Vec3 working = toWorking(task.frame, Points(middle.transpose())).row(0).transpose();
    taken -= lumpAt(working, site.removed / std::pow(task.frame.length, 3));
  }
  const Moments filled = inWorking(task, room.mesh);
  return filled[0] > -taken[0] &&
         effect(task.search, body, filled) > effect(task.search, body, taken);
}

std::vector<Room> roomsOf(const DrainTask& task, const TriangleMesh& cavity) {
  const TriangleTree outer(task.outer.vertices, task.outer.faces);
  const Components components = connectedComponents(cavity.vertices.rows(), cavity.faces);
  const HoleWishes wishes{task.wishes.up, task.wishes.fewest, kToleratedPool};
  std::vector<Room> rooms;
  for (std::size_t c = 0; c < components.size(); ++c) {
    rooms.push_back({submesh(cavity.vertices, components[c]).mesh, {}});
    const TriangleMesh& mesh = rooms.back().mesh;
    Components others = components;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(c));
    const Faces otherFaces = joined(others);
    const auto otherTree = others.empty()
                               ? nullptr
                               : std::make_unique<const TriangleTree>(cavity.vertices, otherFaces);
    const TriangleTree tree(mesh.vertices, mesh.faces);
    rooms.back().sites = holesFor(
        {outer, tree, otherTree.get(), task.wishes.diameter, task.wishes.isKeptClear}, wishes);
  }
  return rooms;
}

/// Fills rooms that are not worth their holes, unless that would be all.
void fillUnworthy(const DrainTask& task, const Components& components, std::vector<Room>& rooms,
                  CavityResult& cavity, Drainage& result) {
  const Moments body = hollowBody(task.search, cavity).mass;
  std::vector<Room> kept;
  Components faces;
  for (std::size_t c = 0; c < rooms.size(); ++c) {
    if (!isWorthItsHoles(task, body, rooms[c])) continue;
    kept.push_back(std::move(rooms[c]));
    faces.push_back(components[c]);
  }
  if (kept.empty()) {
    result.unreached = static_cast<int>(components.size());
    return;
  }
  result.filled = static_cast<int>(components.size() - kept.size());
  rooms = std::move(kept);
  if (result.filled == 0) return;
  cavity.cavity.faces = joined(faces);
  std::vector<char> isUsed(cavity.cavity.solid.size(), 0);
  for (const int v : cavity.cavity.faces.reshaped()) {
    if (static_cast<std::size_t>(v) < isUsed.size()) isUsed[static_cast<std::size_t>(v)] = 1;
  }
  for (std::size_t v = 0; v < isUsed.size(); ++v) {
    if (isUsed[v] == 0) cavity.cavity.solid[v] = 1;
  }
  const TriangleTree outer(cavity.outer, task.search.surface.faces(), TriangleTree::Order::Spatial);
  cavity.inspection = inspect(cavity.inner, cavity.cavity.faces,
                              task.search.model.outer ? outer : task.search.surface,
                              task.search.wall, nullptr, task.search.stored);
}

/// Volumes of what stays, the largest first.
std::vector<double> poolsOf(const std::vector<Room>& rooms, const Vec3& up) {
  std::vector<double> volumes;
  for (const Room& room : rooms) {
    const TriangleTree tree(room.mesh.vertices, room.mesh.faces);
    std::vector<Outlet> outlets;
    for (const DrillSite& site : room.sites) outlets.push_back(outletAt(site, tree, up));
    for (const Pool& pool : standingPools(room.mesh, up, outlets)) volumes.push_back(pool.volume);
  }
  std::sort(volumes.rbegin(), volumes.rend());
  return volumes;
}

/// Leaves out holes that cannot be cut, one by one. Whether every room keeps one.
bool leaveOutUncut(const DrainTask& task, const TriangleMesh& cavity, std::vector<Room>& rooms) {
  for (Room& room : rooms) {
    const auto isUncut = [&](const DrillSite& site) {
      return !drilled(task.outer, room.mesh, {site.hole}, kPlugClearance, task.representable);
    };
    room.sites.erase(std::remove_if(room.sites.begin(), room.sites.end(), isUncut),
                     room.sites.end());
    if (room.sites.empty()) return false;
  }
  return cavity.faces.rows() > 0;
}

std::vector<Hole> holesOf(const std::vector<Room>& rooms) {
  std::vector<Hole> holes;
  for (const Room& room : rooms) {
    for (const DrillSite& site : room.sites) holes.push_back(site.hole);
  }
  return holes;
}

} // namespace

Drainage drainage(const DrainTask& task, CavityResult& cavity) {
  const Stopwatch time;
  Drainage result;
  const TriangleMesh all = inModel(task, cavity);
  std::vector<Room> rooms = roomsOf(task, all);
  const CavityResult before = cavity;
  fillUnworthy(task, connectedComponents(all.vertices.rows(), all.faces), rooms, cavity, result);
  if (result.unreached == 0) {
    result.holes = holesOf(rooms);
    if (!drillAgain(task, cavity, result) && leaveOutUncut(task, inModel(task, cavity), rooms)) {
      result.holes = holesOf(rooms);
      drillAgain(task, cavity, result);
    }
    if (result.drilled.plugs.empty()) {
      cavity = before;
      result = {};
      result.unreached = cavity.inspection.components;
    }
  }
  if (result.unreached == 0) {
    result.pools = poolsOf(rooms, task.wishes.up);
    result.poolsHanging = poolsOf(rooms, -task.wishes.up);
    result.openings.resize(static_cast<Eigen::Index>(result.holes.size()), 3);
    Eigen::Index row = 0;
    for (const Room& room : rooms) {
      for (const DrillSite& site : room.sites)
        result.openings.row(row++) = site.outerRim.colwise().mean();
      result.missing += std::max(0, task.wishes.fewest - static_cast<int>(room.sites.size()));
    }
  }
  result.seconds = time.seconds();
  return result;
}

bool drillAgain(const DrainTask& task, const CavityResult& cavity, Drainage& drainage) {
  const TriangleMesh inner = inModel(task, cavity);
  std::optional<DrilledBody> body =
      drilled(task.outer, inner, drainage.holes, kPlugClearance, task.representable);
  if (!body) return false;
  drainage.open =
      inWorking(task, body->body) - inWorking(task, task.outer) + inWorking(task, inner);
  drainage.plugged = drainage.open;
  for (const TriangleMesh& plug : body->plugs) drainage.plugged += inWorking(task, plug);
  drainage.drilled = std::move(*body);
  return true;
}

std::vector<char> nearHoles(const DrainTask& task, const CavityResult& cavity,
                            const Drainage& drainage) {
  const Points inner = toModel(task.frame, cavity.inner);
  std::vector<char> isNear(static_cast<std::size_t>(inner.rows()), 0);
  for (Eigen::Index v = 0; v < inner.rows(); ++v) {
    for (const Hole& hole : drainage.holes) {
      const Vec3 way = inner.row(v).transpose() - hole.centre;
      const double along = std::clamp(way.dot(hole.direction), 0.0, hole.length);
      if ((way - along * hole.direction).norm() < 2.0 * hole.radiusAt(hole.length))
        isNear[static_cast<std::size_t>(v)] = 1;
    }
  }
  return isNear;
}

} // namespace massprops
