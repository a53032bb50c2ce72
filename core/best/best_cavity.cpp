#include "core/best/best_cavity.h"

#include "core/base/stopwatch.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/best/moved_quadric.h"
#include "core/best/polish.h"
#include "core/best/uniform_wall.h"
#include "core/contour/cavity_contour.h"
#include "core/contour/inscribed_ball.h"
#include "core/contour/wall_keeping.h"
#include "core/optimum/admissible_cells.h"
#include "core/reduced/hollow_body.h"
#include "core/reduced/search_strategy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr double kLeastEdge = 1.0 / 1000.0; // of cubes

/// Next to very many triangles everything takes long, most of all cubes: there by so much more may
/// be left of what is possible as somewhat larger ones leave.
double leeway(const TriangleTree& surface) {
  constexpr Eigen::Index kVeryMany = 500000;
  constexpr double kMore = 1.25;
  return surface.faces().rows() > kVeryMany ? kMore : 1.0;
}

constexpr double kPower = 1.3; // of the cubes' edge, that the gap goes with

double leewayOfEdge(const TriangleTree& surface) {
  return std::pow(leeway(surface), 1.0 / kPower);
}

Points delivered(const CavityTask& task, const Points& working) {
  return task.deliverable ? task.deliverable(working) : working;
}

/// The wall that a cavity is made with so that rounding leaves the wanted one: points between those
/// of the surface, which are rounded already, tell how far points move.
double wallBeforeRounding(const CavityTask& task) {
  constexpr double kMore = 2.0; // than any of these
  const Points& vertices = task.surface.vertices();
  const Faces& faces = task.surface.faces();
  constexpr Eigen::Index kSome = 1000;
  const Eigen::Index step = faces.rows() / kSome + 1;
  Points middles((faces.rows() + step - 1) / step, 3);
  for (Eigen::Index i = 0; i < middles.rows(); ++i) {
    const auto corners = faces.row(i * step);
    middles.row(i) =
        (vertices.row(corners[0]) + vertices.row(corners[1]) + vertices.row(corners[2])) / 3.0;
  }
  return task.wall + kMore * (delivered(task, middles) - middles).rowwise().norm().maxCoeff();
}

constexpr double kSliver = 5.0; // degrees

/// Without the outer surface, which is large and the same for all.
CavityResult resultOf(Points inner, const Faces& faces, Inspection inspection) {
  CavityResult result;
  result.shape = CavityShape::BestPossible;
  result.isContour = true;
  result.status = CavityStatus::Found;
  result.inner = std::move(inner);
  result.cavity.faces = faces;
  result.inspection = std::move(inspection);
  return result;
}

/// Polished with the cut alone, a few times, for each goes a part of an edge's length at most. The
/// number of evaluations.
int adjustCut(const CavityTask& task, const LayeredQuadric& quadric, double edge,
              const std::vector<char>& held, const Contour& contour, Points& vertices) {
  constexpr int kTimes = 3;
  int evaluations = 0;
  for (int i = 0; i < kTimes; ++i) {
    const Polished polished =
        polish(task, quadric, Moving::CutAlone, edge, held, contour, vertices);
    evaluations += polished.evaluations;
    if (polished.violation <= kFeasibility && !polished.isFarthest) break;
    // A contour follows what is far from what is asked for.
    if (polished.violation > OptimalBound::kReachable && !task.bound->isReachable()) break;
  }
  return evaluations;
}

/// What is left of what is possible.
double gapOf(const CavityTask& task, const Body& body) {
  return gapToBound(*task.bound, inputBody(task), body);
}

/// Whether a cavity shall be adjusted. Where none keeps the constraints there is no end to what
/// would be tried for them, and steps along creases come of it.
bool isWorthMoving(const CavityTask& task, const Body& unmoved, const Body& moved) {
  constexpr double kMuch = 0.002; // of what is possible
  if (!servesBetter(task, moved, unmoved)) return false;
  return task.bound->isReachable() || moved.violation <= kFeasibility ||
         task.goal.insteadOfConstraints() || gapOf(task, unmoved) - gapOf(task, moved) > kMuch;
}

/// Where the vertices of a contour might go, and the body with the cavity that they make.
struct Candidate {
  Points vertices; ///< none: they stay where they are
  Body body;
};

class Polishing {
public:
  Polishing(const CavityTask& task, const LayeredQuadric& quadric, CavityContour found)
      : task_(task), quadric_(quadric), edge_(found.edge), found_(std::move(found.contour)),
        clearance_(std::move(found.clearance)) {}

  int evaluations() const { return evaluations_; }
  double secondsInspection() const { return secondsInspection_; }

  Candidate unmoved() const { return {Points(0, 3), bodyAt(found_.mesh.vertices)}; }

  /// With creases that move, which leave the walls' surface a little, and the constraints with it.
  /// Empty: the wall is not kept.
  std::optional<Candidate> withMovedCreases(double wall) {
    Points vertices = found_.mesh.vertices;
    evaluations_ +=
        polish(task_, quadric_, Moving::CutAndCreases, edge_, {}, found_, vertices).evaluations;
    if (!keepWall(clearance_, wall, found_.mesh.faces, vertices).empty()) return std::nullopt;
    return adjusted(std::move(vertices));
  }

  Candidate adjusted() { return adjusted(found_.mesh.vertices); }

  /// Inspected. Vertices whose faces do not pass go back to where the contour has them and stay
  /// there, while the others are adjusted anew.
  CavityResult passed(Points vertices) {
    const Points& home = found_.mesh.vertices;
    if (vertices.rows() == 0) vertices = home;
    return passed(std::move(vertices), home, [&](const std::vector<char>& held, Points& others) {
      adjust(held, others);
      return true;
    });
  }

  /// Of vertices that pass but do not keep the constraints, inspected; those whose faces do not
  /// pass any more stay where they are. Empty: they are too far from the constraints.
  std::optional<CavityResult> withdrawn(const Points& home) {
    const auto withdraw = [&](const std::vector<char>& held, Points& vertices) {
      vertices = home;
      return withdrawFromWalls(task_, edge_, held, found_, vertices);
    };
    Points vertices;
    if (!withdraw({}, vertices)) return std::nullopt;
    return passed(std::move(vertices), home, withdraw);
  }

private:
  /// Vertices whose faces do not pass, or have become slivers, go home, and `anew` is called with
  /// flags of all that did, until it gives up or nothing is new.
  template <class Anew>
  CavityResult passed(Points vertices, const Points& home, const Anew& anew) {
    constexpr int kRounds = 5;
    std::vector<char> held(static_cast<std::size_t>(vertices.rows()), 0);
    std::optional<CavityResult> clean; // but for slivers
    const auto isFeasible = [&](const CavityResult& result) {
      return hollowBody(task_, result).violation <= kFeasibility;
    };
    for (int round = 0;; ++round) {
      CavityResult result = inspectedAt(vertices);
      const bool isClean = result.inspection.isClean();
      if (round == kRounds || !holdFaulty(result.inspection, home, held, vertices)) {
        const bool isLess = !isClean || (clean && isFeasible(*clean) && !isFeasible(result));
        if (clean && isLess) return *std::move(clean);
        return result;
      }
      if (isClean) clean = result;
      if (!anew(held, vertices)) return clean ? *std::move(clean) : result;
    }
  }

  Body bodyAt(const Points& vertices) const {
    return hollowBody(task_, delivered(task_, vertices), found_.mesh.faces);
  }

  Candidate adjusted(Points vertices) {
    adjust({}, vertices);
    const Body body = bodyAt(vertices);
    return {std::move(vertices), body};
  }

  void adjust(const std::vector<char>& held, Points& vertices) {
    evaluations_ += adjustCut(task_, quadric_, edge_, held, found_, vertices);
  }

  CavityResult inspectedAt(const Points& vertices) {
    Points inner = delivered(task_, vertices);
    const Stopwatch time;
    Inspection inspection = inspect(inner, found_.mesh.faces, task_.surface, task_.wall, false,
                                    LookFirst::ForAll, &clearance_, task_.stored);
    secondsInspection_ += time.seconds();
    return resultOf(std::move(inner), found_.mesh.faces, std::move(inspection));
  }

  /// Whether it has an angle below 5° that it had not where it comes from.
  bool hasBecomeSliver(const Points& vertices, Eigen::Index f) const {
    const auto angle = [&](const Points& x) {
      const auto corner = [&](int k) { return x.row(found_.mesh.faces(f, k)).transpose(); };
      return leastAngle(corner(0), corner(1), corner(2));
    };
    return angle(vertices) < kSliver && angle(found_.mesh.vertices) >= kSliver;
  }

  /// Whether there was one that was not held yet.
  bool holdFaulty(const Inspection& inspection, const Points& home, std::vector<char>& held,
                  Points& vertices) const {
    const Faces& faces = found_.mesh.faces;
    std::vector<char> faulty(held.size(), 0);
    for (const int v : inspection.crossing) faulty[static_cast<std::size_t>(v)] = 1;
    for (const int v : inspection.thin) faulty[static_cast<std::size_t>(v)] = 1;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      if (!hasBecomeSliver(vertices, f)) continue;
      for (const int v : faces.row(f)) faulty[static_cast<std::size_t>(v)] = 1;
    }
    bool isNew = false;
    const auto isFaulty = [&](int v) { return faulty[static_cast<std::size_t>(v)] != 0; };
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      const auto corners = faces.row(f);
      if (std::none_of(corners.begin(), corners.end(), isFaulty)) continue;
      for (const int v : corners) {
        isNew = isNew || held[static_cast<std::size_t>(v)] == 0;
        held[static_cast<std::size_t>(v)] = 1;
        vertices.row(v) = home.row(v);
      }
    }
    return isNew;
  }

  const CavityTask& task_;
  const LayeredQuadric& quadric_;
  double edge_;
  const Contour found_; ///< passes the inspection
  ClearanceQuery clearance_;
  int evaluations_ = 0;
  double secondsInspection_ = 0.0;
};

/// The contour as the goal would have it, or as it was: what serves best of those that are clean,
/// for triangles that give way to the wall cost more in one than in another.
CavityResult polished(const CavityTask& task, const LayeredQuadric& quadric, double wall,
                      CavityContour found) {
  Polishing polishing(task, quadric, std::move(found));
  std::vector<Candidate> candidates;
  candidates.push_back(polishing.unmoved());
  const Body unmoved = candidates.front().body;
  if (auto moved = polishing.withMovedCreases(wall)) candidates.push_back(*std::move(moved));
  candidates.push_back(polishing.adjusted());
  candidates.erase(std::remove_if(candidates.begin() + 1, candidates.end(),
                                  [&](const Candidate& candidate) {
                                    return !isWorthMoving(task, unmoved, candidate.body);
                                  }),
                   candidates.end());
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [&](const Candidate& a, const Candidate& b) { return servesBetter(task, a.body, b.body); });
  // What passes at once serves better than what comes after it; what gave way may not.
  std::optional<CavityResult> best;
  Body bestBody;
  const Body solid = inputBody(task);
  const auto isWorthInspecting = [&](const Body& body) {
    constexpr double kNoticeable = 1e-3; // of what is possible
    if (bestBody.violation > kFeasibility) return servesBetter(task, body, bestBody);
    return gapToBound(*task.bound, solid, bestBody) - gapToBound(*task.bound, solid, body) >
           kNoticeable;
  };
  for (Candidate& candidate : candidates) {
    if (best && best->inspection.isClean() && !isWorthInspecting(candidate.body)) continue;
    CavityResult result = polishing.passed(std::move(candidate.vertices));
    const Body body = hollowBody(task, result);
    const bool isBetter =
        !best || (result.inspection.isClean() &&
                  (!best->inspection.isClean() || servesBetter(task, body, bestBody)));
    if (!isBetter) continue;
    best = std::move(result);
    bestBody = body;
  }
  if (bestBody.violation > kFeasibility && task.bound->isReachable()) {
    std::optional<CavityResult> withdrawn = polishing.withdrawn(best->inner);
    if (withdrawn && withdrawn->inspection.isClean() &&
        servesBetter(task, hollowBody(task, *withdrawn), bestBody))
      best = std::move(withdrawn);
  }
  best->effort.evaluations = polishing.evaluations();
  best->effort.secondsInspection = polishing.secondsInspection();
  best->stopReason = "the limit's cavity, adjusted on its triangles";
  return *std::move(best);
}

/// The set with another wall.
OpenedSet withWall(const OpenedSet& set, double wall) {
  OpenedSet result = openedSet(set.surface, wall, set.ball, set.edge);
  result.fill = set.fill;
  return result;
}

/// Whether there is room behind a wall, which is looked for when it is asked for first.
class Room {
public:
  Room(const TriangleTree& surface, double wall) : surface_(surface), wall_(wall) {}

  bool isThere() {
    if (!isThere_)
      isThere_ = wallWithRoomFor(largestInscribedBall(surface_, wall_).radius) >= wall_;
    return *isThere_;
  }

private:
  const TriangleTree& surface_;
  double wall_;
  std::optional<bool> isThere_;
};

/// What is left of what is possible.
double gapOf(const CavityTask& task, const CavityResult& result) {
  return result.status == CavityStatus::Found ? gapOf(task, hollowBody(task, result)) : 1.0;
}

/// A cavity, or what it will be like.
struct Made {
  CavityResult result;
  bool isFinished = true;  ///< else hardly polished and not inspected
  double unresolved = 0.0; ///< see `Contour`
};

/// Of a contour, hardly polished.
struct Rough {
  Points vertices; ///< working frame
  Points inner;    ///< delivered
  Body body;
};

Rough roughlyPolished(const CavityTask& task, const LayeredQuadric& quadric, double edge,
                      const Contour& contour) {
  const auto roughAt = [&](const Points& vertices) {
    Rough rough{vertices, delivered(task, vertices), {}};
    rough.body = hollowBody(task, rough.inner, contour.mesh.faces);
    return rough;
  };
  Points vertices = contour.mesh.vertices;
  adjustCut(task, quadric, edge, {}, contour, vertices);
  Rough moved = roughAt(vertices);
  Rough unmoved = roughAt(contour.mesh.vertices);
  return isWorthMoving(task, unmoved.body, moved.body) ? std::move(moved) : std::move(unmoved);
}

/// Whether a cavity is worth finishing, by what it leaves of what is possible, its area, and at how
/// many corners cubes are too large for it.
using IsEnough = std::function<bool(double gap, double area, double unresolved)>;

/// In cubes of the set's edge. `quadric`: the limit's, which is known of larger cells; as it moved.
Made cavityOf(const CavityTask& task, const OpenedSet& deliverable, LayeredQuadric& quadric,
              Room& room, const IsEnough& isEnough) {
  CavityResult rough;
  ContourUse use;
  use.loss = [&](const Contour& contour) {
    return gapOf(task, roughlyPolished(task, quadric, deliverable.edge, contour).body);
  };
  MovingQuadric moving(quadric);
  use.isWorthIt = [&](const Contour& contour) {
    if (!moving.isAsMeant(contour)) return false;
    if (!isEnough && moving.isAtRest()) return true;
    Rough polished = roughlyPolished(task, quadric, deliverable.edge, contour);
    const bool isWorth =
        !isEnough || polished.body.violation > kFeasibility ||
        isEnough(gapOf(task, polished.body), surfaceArea(polished.inner, contour.mesh.faces),
                 contour.unresolved);
    const bool moves = isWorth && moving.follow(contour, polished.vertices, deliverable.edge);
    if (!isWorth) rough = resultOf(std::move(polished.inner), contour.mesh.faces, {});
    return isWorth && !moves;
  };
  std::vector<Vec3> crossing;
  const auto contourOf = [&](const OpenedSet& set) {
    for (;;) {
      moving.begin();
      std::optional<CavityContour> found = cavityContour(set, quadric, use, crossing);
      if (!found || found->contour.mesh.faces.rows() == 0) moving.takeBack();
      if (!moving.hasMoved()) return found;
    }
  };
  const double roomy = wallBeforeRounding(task);
  double wall = task.wall;
  CavityResult result;
  double unresolved = 0.0;
  constexpr int kRounds = 3;
  for (int round = 1; round <= kRounds; ++round) {
    if (deliverable.wall < roomy || round > 1) wall += roomy - task.wall;
    const OpenedSet set = wall <= deliverable.wall ? deliverable : withWall(deliverable, wall);
    std::optional<CavityContour> found = contourOf(set);
    if (!found || found->contour.mesh.faces.rows() == 0) {
      result = {};
      // Where there is room the limit's body is the solid one.
      if (room.isThere()) result.status = CavityStatus::NoGain;
      result.stopReason = found ? "the best possible cavity is none"
                                : "the best possible cavity cannot be resolved";
      break;
    }
    unresolved = found->contour.unresolved;
    if (!found->isFinished) return {std::move(rough), false, unresolved};
    result = polished(task, quadric, wall, *std::move(found));
    result.effort.rounds = round;
    if (result.inspection.isClean()) break;
    // What just passes by in one frame may touch in another.
    for (const int v : result.inspection.crossing)
      crossing.emplace_back(result.inner.row(v).transpose());
  }
  result.shape = CavityShape::BestPossible;
  result.edge = deliverable.edge;
  if (result.cavity.faces.rows() > kEnoughTriangles) {
    result.stopReason += "; fewer than its " + std::to_string(result.cavity.faces.rows()) +
                         " triangles would be too far from where its surface should be";
  }
  if (result.status == CavityStatus::Found) {
    if (!result.inspection.isClean()) {
      // There is room, but none of the surfaces passed.
      result = {};
      result.status = CavityStatus::NoGain;
      result.stopReason = "the best possible cavity cannot be resolved";
    } else if (!servesBetter(task, hollowBody(task, result), inputBody(task))) {
      result.status = CavityStatus::NoGain;
    }
  }
  return {std::move(result), true, unresolved};
}

/// Whether the quadric leaves room on both sides.
bool isCut(const CavityTask& task) {
  const Vec3 low = task.surface.lower();
  const Vec3 high = task.surface.upper();
  const Region region{task.surface, task.wall, {}, task.bound->worth};
  return sideOfCut(region, 0.5 * (low + high), 0.5 * (high - low).norm()) != Side::Positive;
}

constexpr double kUncut = 1.2; // as large as they are behind a wall alone

/// Of cubes that leave little of what is possible: by what larger ones leave, where that depends
/// on the goal.
double edgeThatWillDo(const CavityTask& task, const OpenedSet& deliverable,
                      const LayeredQuadric& quadric) {
  constexpr double kLarger = 2.0;
  constexpr double kWanted = 0.010;  // before all is polished
  constexpr double kCarrying = 0.85; // ceilings that shall carry themselves ask for more
  if (deliverable.fill) return kCarrying * deliverable.edge;
  if (!isCut(task)) return kUncut * leewayOfEdge(task.surface) * deliverable.edge;
  OpenedSet coarse = deliverable;
  coarse.edge *= kLarger;
  double gap = 0.0;
  ContourUse use;
  use.isWorthIt = [&](const Contour& contour) {
    const Body body = roughlyPolished(task, quadric, coarse.edge, contour).body;
    if (body.violation <= kFeasibility) gap = gapOf(task, body);
    return false;
  };
  cavityContour(coarse, quadric, use);
  if (gap <= 0.0) return deliverable.edge;
  // In steps: the last digits of the gap depend on where the model lies.
  constexpr double kSteps = 4.0;                                        // that double the edge
  const double ideal = kLarger * std::pow(kWanted / gap, 1.0 / kPower); // times the edge
  const double more = leewayOfEdge(task.surface);
  const double steps = kSteps * std::log2(more * ideal);
  const double most = 1.0 + std::round(kSteps * std::log2(more));
  const double factor = std::exp2(std::round(std::clamp(steps, -2.0, most)) / kSteps);
  return std::max(factor * deliverable.edge, kLeastEdge);
}

// More take more than 60 MB, and much time.
constexpr double kManyCubes = 250000.0;

/// How many cubes at most it is worth to have less left of what is possible than this.
double cubesWorth(double gap, double leeway) {
  constexpr double kLittle = 0.022;
  constexpr double kFewCubes = 80000.0;
  constexpr double kFar = 0.0275; // finishing may take some
  if (gap <= leeway * kLittle) return kFewCubes;
  return gap <= kFar ? kManyCubes : std::numeric_limits<double>::infinity();
}

/// Where cubes of this edge find no room, of those that do; less than an eighth would be too many.
double edgeThatResolves(double edge, double ball) {
  return std::clamp(kResolves * ball, edge / 8.0, edge / 2.0);
}

/// Whether the quadric that was found in large cells does not keep the constraints of triangles as
/// it should, for much depends on what its border cuts: smaller ones find a better one.
bool asksForSmallerCells(const CavityTask& task, const CavityResult& result) {
  const bool isOfMoments = task.goal.usesInertia() && task.bound->worth.quadrics.size() == 1;
  const bool isKept = hollowBody(task, result).violation <= kFeasibility;
  return isOfMoments && !isKept && !task.goal.insteadOfConstraints();
}

/// The quadric in cells of the cubes' edge.
LayeredQuadric quadricInSmallerCells(const CavityTask& task, const OpenedSet& deliverable) {
  const Vec3 extent = task.surface.upper() - task.surface.lower();
  const double count = extent.prod() / std::pow(deliverable.edge, 3);
  const auto most = static_cast<double>(std::numeric_limits<int>::max());
  // The parts take more than the cells, and are not needed any more then.
  const AdmissibleCells cells =
      cellsWithin(deliverable, admissibleParts(task.surface, task.wall,
                                               static_cast<int>(std::min(count, most))));
  return cells.rows() == 0 ? task.bound->worth
                           : quadricWithin(cells, *task.bound, task.goal, task.weights,
                                           task.model.solidMoments, task.model.fillings);
}

/// In cubes as fine as it takes to lose little.
CavityResult inFineCubes(const CavityTask& task, OpenedSet deliverable, Room& room) {
  const double more = leeway(task.surface);
  const std::array<double, 2> enough{more * 0.018, more * 0.025};  // of what is possible is left
  const std::array<double, 2> roughlyEnough{more * 0.018, 0.0275}; // before all is polished
  constexpr double kWanted = 0.01;
  constexpr double kWantedOfMany = 0.02;
  LayeredQuadric quadric = task.bound->worth;
  deliverable.edge = edgeThatWillDo(task, deliverable, quadric);
  const auto edgeFor = [&](double gap, double wanted) {
    return deliverable.edge * std::clamp(std::sqrt(wanted / gap), 0.5, 0.8);
  };
  const auto areTooLarge = [&](double unresolved) {
    constexpr double kFrayed = 0.0005;
    return unresolved > kFrayed && deliverable.edge > kResolves * deliverable.ball;
  };
  const auto isEnough = [&](double gap, double area, double limit) {
    return gap <= limit || edgeOfCubes(area, cubesWorth(gap, more)) > edgeFor(gap, kWanted);
  };
  const auto isRoughlyEnough = [&](std::size_t i) {
    return [&, i](double gap, double area, double unresolved) {
      return isEnough(gap, area, roughlyEnough[i]) && !areTooLarge(unresolved);
    };
  };
  Made best = cavityOf(task, deliverable, quadric, room, isRoughlyEnough(0));
  double edgeOfBest = deliverable.edge;
  LayeredQuadric quadricOfBest = quadric;
  bool isOfLargeCells = true;
  for (std::size_t i = 0; i < enough.size();) {
    const double gap = gapOf(task, best.result);
    const double area = surfaceArea(best.result.inner, best.result.cavity.faces);
    if (best.result.status == CavityStatus::NoRoom) break;
    const bool isFrayed = areTooLarge(best.unresolved);
    const bool isNone = best.result.cavity.faces.rows() == 0;
    const bool isOfCells = isOfLargeCells && !isNone && !isFrayed && gap > enough[i] &&
                           asksForSmallerCells(task, best.result);
    if (isEnough(gap, area, enough[i]) && !isFrayed && !isOfCells) break;
    const bool areMany = edgeOfCubes(area, kManyCubes) > edgeFor(gap, kWanted);
    if (isNone) {
      deliverable.edge = edgeThatResolves(deliverable.edge, deliverable.ball);
    } else if (isFrayed) {
      deliverable.edge = std::max(0.5 * deliverable.edge, kResolves * deliverable.ball);
    } else if (isOfCells) {
      quadric = quadricInSmallerCells(task, deliverable);
      isOfLargeCells = false;
    } else {
      deliverable.edge = edgeFor(gap, areMany ? kWantedOfMany : kWanted);
    }
    if (deliverable.edge < kLeastEdge) break;
    if (!isOfCells) ++i;
    const bool isLast = i == enough.size();
    Made finer =
        cavityOf(task, deliverable, quadric, room, isLast ? IsEnough() : isRoughlyEnough(i));
    finer.result.effort += best.result.effort;
    constexpr double kLittleMore = 0.002; // of what is possible, where ends get smooth
    const bool isBetter = servesBetter(task, finer.result, best.result) ||
                          (isFrayed && gapOf(task, finer.result) <= gap + kLittleMore);
    best.result.effort = finer.result.effort;
    if (!isBetter && !isOfCells) break;
    if (!isBetter) {
      quadric = quadricOfBest;
      continue;
    }
    best = std::move(finer);
    edgeOfBest = deliverable.edge;
    quadricOfBest = quadric;
  }
  deliverable.edge = std::max(deliverable.edge, kLeastEdge);
  if (best.isFinished) return std::move(best.result);
  deliverable.edge = edgeOfBest;
  Made finished = cavityOf(task, deliverable, quadricOfBest, room, {});
  finished.result.effort += best.result.effort;
  return std::move(finished.result);
}

/// As finely as the rooms behind a wall are narrow.
double edgeFor(const RegionParts& behindWall, const AdmissibleCells& cells) {
  constexpr double kFewest = 15000.0;
  constexpr double kMost = 50000.0;
  constexpr double kAcross = 9.0; // a room of the mean width
  const double area = borderArea(behindWall);
  const double width = 2.0 * cells.col(0).sum() / area;
  const double edge =
      std::clamp(width / kAcross, edgeOfCubes(area, kMost), edgeOfCubes(area, kFewest));
  return std::max(edge, kLeastEdge);
}

/// Edges of cubes within which of any point a corner of them is: √3/2, and what rounding takes.
constexpr double kToCorner = 0.87;

/// `radius`: of a ball within the surface. \pre behind the wall it leaves one as wide as the wall
bool seesRoom(const TriangleTree& surface, double wall, double radius) {
  const RegionParts behindWall = admissibleParts(surface, wall);
  const AdmissibleCells cells = cellsOf(behindWall);
  // Without cells there is no limit, and no quadric to go by.
  if (cells.rows() == 0) return false;
  const double largest = kUncut * leewayOfEdge(surface) * edgeFor(behindWall, cells);
  const double edge = std::max(edgeThatResolves(largest, wall), kLeastEdge);
  if (radius - wall >= kToCorner * edge) return true;
  const std::optional<CavityContour> found = cavityContour(openedSet(surface, wall, edge), {});
  return found && found->contour.mesh.faces.rows() > 0;
}

/// Where a mass is all that is wanted: behind a wall as thick everywhere as that takes. Empty: more
/// is wanted, or not to be had that way.
std::optional<CavityResult> uniformlyWalled(const CavityTask& task, const OpenedSet& set) {
  const std::optional<double> mass = task.goal.wantedMass();
  const Filling& filling = task.model.fillings.front();
  if (!mass || task.weights.constraints == 0.0 || filling.isPartial()) return {};
  const double solid = task.model.solidMoments[0];
  const double perVolume = 1.0 - filling.density; // what a cavity takes off
  const double volume = (solid - *mass) / perVolume;
  if (!(volume > 0.0)) return {};
  const double tolerance = 0.1 * kFeasibility * solid / std::abs(perVolume);
  std::optional<TriangleMesh> cavity;
  constexpr std::array<double, 3> kCoarser{1.0, 1.5, 2.25};
  const double edge = leewayOfEdge(task.surface) * set.edge;
  for (const double factor : kCoarser) {
    std::optional<TriangleMesh> found = cavityOfVolume(
        {task.surface, volume, tolerance, wallBeforeRounding(task), set.ball, factor * edge,
         [&](const Points& points) { return delivered(task, points); }});
    if (!found) break;
    cavity = std::move(found);
    if (cavity->faces.rows() <= kEnoughTriangles) break;
  }
  if (!cavity) return {};
  Points inner = delivered(task, cavity->vertices);
  const Stopwatch time;
  Inspection inspection = inspect(inner, cavity->faces, task.surface, task.wall, false,
                                  LookFirst::ForAll, nullptr, task.stored);
  CavityResult result = resultOf(std::move(inner), cavity->faces, std::move(inspection));
  result.effort.secondsInspection = time.seconds();
  result.effort.rounds = 1;
  result.stopReason = "walls as thick everywhere as the mass asks for";
  if (!result.inspection.isClean()) return {};
  return result;
}

} // namespace

Deliverable deliverableSet(const TriangleTree& surface, double wall, const RegionParts& behindWall,
                           const AdmissibleCells& cells) {
  OpenedSet set = openedSet(surface, wall, edgeFor(behindWall, cells));
  AdmissibleCells within = cellsWithin(set, behindWall);
  return {std::move(set), std::move(within)};
}

CavityResult bestPossibleCavity(const CavityTask& task, const OpenedSet& deliverable, Cubes cubes) {
  const Stopwatch time;
  Room room(task.surface, task.wall);
  std::optional<CavityResult> walled;
  if (!deliverable.fill) walled = uniformlyWalled(task, deliverable);
  LayeredQuadric quadric = task.bound->worth;
  CavityResult result = walled ? *std::move(walled)
                        : cubes == Cubes::OfTheSet
                            ? cavityOf(task, deliverable, quadric, room, {}).result
                            : inFineCubes(task, deliverable, room);
  if (result.status == CavityStatus::Found) result.outer = task.surface.vertices();
  result.effort.secondsOptimization = time.seconds() - result.effort.secondsInspection;
  return result;
}

double largestWallForBestPossible(const CavityTask& task,
                                  const std::function<void(double)>& progress) {
  constexpr double kNearly = 0.95; // cubes do not see what just fits
  const double radius = largestInscribedBall(task.surface, task.wall).radius;
  double wall = std::min(kNearly * wallWithRoomFor(radius), task.wall);
  // In thin sheets a contour of all would take half a minute, for a wall that is hardly thicker.
  constexpr double kSurely = 1.01;
  constexpr double kHardly = 0.8;
  const double surelySeen = radius - kSurely * kToCorner * kLeastEdge;
  if (surelySeen >= kHardly * wall) wall = std::min(wall, surelySeen);
  const auto sees = [&](double some) { return seesRoom(task.surface, some, radius); };
  return wall > 0.0 && sees(wall) ? wall : greatestWall(wall, sees, progress);
}

} // namespace massprops
