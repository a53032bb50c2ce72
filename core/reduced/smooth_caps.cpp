#include "core/reduced/smooth_caps.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/contour/cavity_surface.h"
#include "core/goals/objective.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/hole_filling.h"
#include "core/mesh/signed_volume.h"
#include "core/optimum/layered_quadric.h"
#include "core/reduced/cavity_ends.h"
#include "core/reduced/displacement.h"
#include "core/reduced/fairing.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Marks = std::vector<char>;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

template <class Predicate>
Faces facesWhere(const Faces& faces, const Predicate& predicate) {
  Faces result(faces.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (predicate(f)) result.row(count++) = faces.row(f);
  }
  return result.topRows(count);
}

bool hasAny(const Faces& faces, Eigen::Index f, const Marks& marks) {
  return std::any_of(faces.row(f).begin(), faces.row(f).end(),
                     [&](int v) { return marks[at(v)] != 0; });
}

/// A cavity over the n vertices of what moves and, behind them, those of new caps, borders
/// included.
struct Capped {
  TriangleMesh mesh;
  Marks solid;          ///< n
  std::vector<int> end; ///< of every vertex; −1
};

bool isClosed(const TriangleMesh& mesh) {
  const EdgeCounts wrong = countEdges(mesh.vertices.rows(), mesh.faces);
  return wrong.boundary + wrong.nonManifold + wrong.incoherent == 0;
}

/// The triangles between a hole's border, divided, over the vertices of the whole and new ones.
TriangleMesh divided(const Points& vertices, const Faces& kept, const VertexCorners& corners,
                     const Faces& cap) {
  std::vector<Eigen::Index> around;
  for (const int v : cap.reshaped()) {
    for (const int c : corners.at(v)) around.push_back(c / 3);
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  const auto first = static_cast<Eigen::Index>(around.size());
  Faces faces(first + cap.rows(), 3);
  for (Eigen::Index i = 0; i < first; ++i) faces.row(i) = kept.row(around[at(i)]);
  faces.bottomRows(cap.rows()) = cap;
  const Submesh patch = submesh(vertices, faces);
  const TriangleMesh other = refinedFilling(patch.mesh, first);
  if (other.faces.rows() == 0) return {Points(0, 3), cap};
  const Eigen::Index old = patch.mesh.vertices.rows();
  return {other.vertices.bottomRows(other.vertices.rows() - old), other.faces.unaryExpr([&](int v) {
            return v < old ? patch.vertexOf[at(v)] : static_cast<int>(vertices.rows() + v - old);
          })};
}

/// Least volume of a component that is worth printing, in cubes of the wall.
constexpr double kSpeck = 8.0;
/// Of many ends some always are faulty, and to try all again takes long.
constexpr int kMostEnds = 8;
/// Of what the cavity gains over the solid body, that smooth ends may cost.
constexpr double kMostLoss = 0.02;

/// Of the constraints; where the cavity cannot keep them, more than its own by a share of its gain.
double mostViolation(const CavityTask& task, const Body& found) {
  if (found.violation <= kFeasibility) return kFeasibility;
  const double gain = inputBody(task).violation - found.violation;
  return found.violation + kMostLoss * std::max(gain, 0.0);
}

class Capping {
public:
  Capping(const CavityTask& task, const CavityResult& found);
  CavityResult run();

private:
  bool isAsFound(int vertex) const;
  Marks haveSharpEdges(const CavityResult& result, const std::vector<int>& end) const;
  void markPleated(const std::vector<int>& end, CavityResult& result) const;
  /// What has not been inspected yet.
  struct Stretched {
    std::unique_ptr<const Skin> skin; ///< at the caps
    CavityResult result;
  };

  struct Closed {
    CavityResult result;
    bool isPressed; ///< else any pressing leads to it
  };

  struct Inspected {
    CavityResult result;
    bool isGood;          ///< clean and worth it
    std::vector<int> end; ///< of every vertex; −1
  };

  /// Of what the goal gains.
  struct Loss {
    double is;
    double most; ///< that smooth ends may cost
  };

  const TriangleTree& outer() const { return moved_ ? *moved_ : task_.surface; }
  Capped opened() const;
  std::vector<Stretched> stretched(Capped capped) const;
  std::optional<Inspected> inspected(const Capped& rough);
  std::optional<Closed> closed(const Stretched& caps, double farthest) const;
  void dropSpecks(double leastVolume, Capped& capped) const;
  CavityResult resultOf(const Capped& capped) const;
  bool keepsConstraints(const CavityResult& result) const;
  bool press(const Skin& skin, double farthest, const Marks& atWall, CavityResult& result) const;
  bool keepsVolume(const CavityResult& result) const;
  bool isWorthIt(const CavityResult& result) const;
  bool giveUp(const CavityResult& result, const std::vector<int>& end);
  Loss lossOf(const Body& before, const Body& after) const;
  Body bodyWith(const Moments& cavity) const;
  void giveUpCostliest(const CavityResult& result, const std::vector<int>& end);

  const CavityTask& task_;
  const CavityResult& found_;
  const Faces& faces_;
  Eigen::Index n_;
  std::unique_ptr<const TriangleTree> moved_; ///< null: the outer surface rests
  std::unique_ptr<const Goal> movedGoal_;
  Moments outerMass_;
  double mostViolation_;
  VertexAdjacency neighbours_;
  VertexCorners corners_;
  CavityEnds ends_;
  Marks isGivenUp_; ///< by the end: it stays as it was
};

Capping::Capping(const CavityTask& task, const CavityResult& found)
    : task_(task), found_(found), faces_(task.model.surface->faces),
      n_(task.model.surface->vertices.rows()),
      moved_(task.model.outer ? std::make_unique<const TriangleTree>(
                                    found.outer, task.surface.faces(), TriangleTree::Order::Spatial)
                              : nullptr),
      movedGoal_(task.goalFor ? task.goalFor(found.outer) : nullptr),
      outerMass_(outerMoments(task, found)),
      mostViolation_(mostViolation(task, hollowBody(task, found))),
      neighbours_(vertexAdjacency(n_, faces_)), corners_(vertexCorners(n_, faces_)),
      ends_(cavityEnds(task, found, neighbours_)), isGivenUp_(at(ends_.count), 0) {}

bool Capping::isAsFound(int vertex) const {
  const int end = ends_.end[at(vertex)];
  return end >= 0 && isGivenUp_[at(end)] != 0;
}

/// What is wrong at one end stays as it was, and the others are tried again.
CavityResult Capping::run() {
  constexpr int kAttempts = 8;
  for (int attempt = 0; attempt < kAttempts && ends_.count <= kMostEnds; ++attempt) {
    if (std::find(isGivenUp_.begin(), isGivenUp_.end(), 0) == isGivenUp_.end()) break;
    std::optional<Inspected> tried = inspected(opened());
    if (!tried) break;
    if (tried->isGood) {
      markPleated(tried->end, tried->result);
      return std::move(tried->result);
    }
    if (tried->result.inspection.isClean()) {
      giveUpCostliest(tried->result, tried->end);
    } else if (!giveUp(tried->result, tried->end)) {
      break;
    }
  }
  std::fill(isGivenUp_.begin(), isGivenUp_.end(), 1);
  CavityResult result = found_;
  markPleated(ends_.end, result);
  return result;
}

/// With smooth ends, the first that are clean and worth it, or else the first of all; empty: there
/// are none.
std::optional<Capping::Inspected> Capping::inspected(const Capped& rough) {
  constexpr double kFarthest[] = {4.0, 2.0}; // walls
  if (!isClosed(rough.mesh)) return {};      // ends too close to each other
  std::optional<Inspected> first;
  const std::vector<Stretched> all = stretched(rough);
  Marks isKnown(all.size(), 0);
  for (const double farthest : kFarthest) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (isKnown[i] != 0) continue;
      std::optional<Closed> caps = closed(all[i], farthest);
      if (!caps) continue;
      isKnown[i] = caps->isPressed ? 0 : 1;
      CavityResult& result = caps->result;
      result.inspection = inspect(result.inner, result.cavity.faces, outer(), task_.wall, false,
                                  LookFirst::ForAll, found_.clearance.get(), task_.stored);
      const bool isGood = result.inspection.isClean() && isWorthIt(result);
      Inspected tried{std::move(result), isGood, rough.end};
      if (isGood) return tried;
      if (!first) first = std::move(tried);
    }
  }
  return first;
}

/// Of every end, whether the surface folds at one of its edges.
Marks Capping::haveSharpEdges(const CavityResult& result, const std::vector<int>& end) const {
  constexpr double kCosine = 0.5; // 60°
  const Faces& faces = result.cavity.faces;
  const std::vector<int> opposite = oppositeHalfEdges(result.inner.rows(), faces);
  Marks are(at(ends_.count), 0);
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    const int number =
        std::max(end[at(faces(h / 3, h % 3))], end[at(faces(h / 3, nextHalfEdge(h) % 3))]);
    if (number < 0 || are[at(number)] != 0) continue;
    const Vec3 here = areaNormal(result.inner, faces, h / 3);
    const Vec3 there = areaNormal(result.inner, faces, opposite[at(h)] / 3);
    if (here.dot(there) < kCosine * here.norm() * there.norm()) are[at(number)] = 1;
  }
  return are;
}

/// The ends that stayed as they were, and those whose caps have a ragged rim or folds.
void Capping::markPleated(const std::vector<int>& end, CavityResult& result) const {
  Marks isPleated = haveSharpEdges(result, end);
  for (std::size_t number = 0; number < isPleated.size(); ++number) {
    if (isGivenUp_[number] != 0) isPleated[number] = 1;
  }
  result.pleatedEnds = static_cast<int>(std::count(isPleated.begin(), isPleated.end(), 1));
  result.pleated.clear();
  for (int v = 0; v < static_cast<int>(end.size()); ++v) {
    if (end[at(v)] >= 0 && isPleated[at(end[at(v)])] != 0) result.pleated.push_back(v);
  }
}

/// With holes closed at ends that are to be smooth, which they are not yet.
Capped Capping::opened() const {
  Marks solid = found_.cavity.solid;
  for (int v = 0; v < static_cast<int>(n_); ++v) {
    if (ends_.turned[at(v)] != 0 && !isAsFound(v)) solid[at(v)] = 1;
  }
  const CavitySurface surface = cavitySurface(found_.inner, faces_, corners_, std::move(solid));
  const Faces kept = surface.faces.topRows(surface.firstCapFace);
  const Faces& before = found_.cavity.faces;
  std::vector<Faces> parts{kept, facesWhere(before, [&](Eigen::Index f) {
                             return f >= found_.cavity.firstCapFace && isAsFound(before(f, 0)) &&
                                    !hasAny(before, f, surface.solid);
                           })};
  Capped result;
  result.solid = surface.solid;
  result.end = ends_.end;
  const VertexCorners keptCorners = vertexCorners(n_, kept);
  std::vector<int> placeOf(at(n_));
  for (std::size_t v = 0; v < placeOf.size(); ++v) placeOf[v] = static_cast<int>(v);
  std::vector<Eigen::RowVector3d> added;
  const auto add = [&](const Eigen::RowVector3d& position, int end) {
    added.push_back(position);
    result.end.push_back(end);
    return static_cast<int>(n_) + static_cast<int>(added.size()) - 1;
  };
  const Faces caps = facesWhere(surface.faces, [&](Eigen::Index f) {
    return f >= surface.firstCapFace && !isAsFound(surface.faces(f, 0));
  });
  for (const Faces& cap : connectedComponents(n_, caps)) {
    const int end = ends_.end[at(cap(0, 0))];
    const TriangleMesh other = divided(found_.inner, kept, keptCorners, cap);
    const int first = static_cast<int>(n_) + static_cast<int>(added.size());
    for (const auto& position : other.vertices.rowwise()) add(position, end);
    parts.emplace_back(other.faces.unaryExpr(
        [&](int v) { return v < n_ ? v : first + v - static_cast<int>(n_); }));
    for (const int v : cap.reshaped()) {
      const bool isOnBorder = keptCorners.at(v).size() > 0;
      if (isOnBorder && placeOf[at(v)] < n_) placeOf[at(v)] = add(found_.inner.row(v), end);
    }
  }
  result.mesh.faces = joined(parts).unaryExpr([&](int v) { return v < n_ ? placeOf[at(v)] : v; });
  result.mesh.vertices.resize(n_ + static_cast<Eigen::Index>(added.size()), 3);
  result.mesh.vertices.topRows(n_) = found_.inner.topRows(n_);
  for (std::size_t i = 0; i < added.size(); ++i) {
    result.mesh.vertices.row(n_ + static_cast<Eigen::Index>(i)) = added[i];
  }
  return result;
}

/// Smooth ends of several stiffnesses, those first that serve the goal best.
std::vector<Capping::Stretched> Capping::stretched(Capped capped) const {
  constexpr double kStiffness[] = {1.0, 2.0, 4.0}; // walls
  dropSpecks(0.0, capped);
  Marks isFree(at(capped.mesh.vertices.rows()), 1);
  std::fill_n(isFree.begin(), n_, 0);
  std::vector<Stretched> all;
  for (const double stiffness : kStiffness) {
    auto skin = std::make_unique<const Skin>(capped.mesh.vertices, capped.mesh.faces, isFree,
                                             stiffness * task_.wall);
    if (!skin->isSolvable()) continue;
    Capped smooth = capped;
    smooth.mesh.vertices = skin->atRest();
    if (!smooth.mesh.vertices.allFinite()) continue;
    dropSpecks(kSpeck * task_.wall * task_.wall * task_.wall, smooth);
    if (smooth.mesh.faces.rows() == 0) continue;
    all.push_back({std::move(skin), resultOf(smooth)});
  }
  std::stable_sort(all.begin(), all.end(), [&](const Stretched& a, const Stretched& b) {
    return servesBetter(task_, a.result, b.result);
  });
  return all;
}

/// The caps as they keep the wall and the constraints hold, not inspected yet; empty where they do
/// not.
std::optional<Capping::Closed> Capping::closed(const Stretched& caps, double farthest) const {
  constexpr int kRounds = 12;
  CavityResult result = caps.result;
  ClearanceQuery clearance(outer());
  Marks rests(at(result.inner.rows()), 0); // what keeps the wall already
  std::fill_n(rests.begin(), n_, 1);
  Marks atWall(at(result.inner.rows()), 0);
  bool isPressed = false;
  for (int round = 0; round < kRounds; ++round) {
    if (!keepsConstraints(result)) {
      isPressed = true;
      if (!press(*caps.skin, farthest, atWall, result)) return std::nullopt;
    }
    Points moved = result.inner;
    // Each time by a little less, so that what has moved once is not moved again, which would upset
    // the constraints for ever.
    const double beyond = (kBeyondWall - 1.0) * (1.0 - round / (kRounds + 1.0));
    const bool isThin =
        !keepWall(clearance, (1.0 + beyond) * task_.wall, result.cavity.faces, moved).empty();
    if (moved == result.inner) break;
    for (Eigen::Index v = n_; v < moved.rows(); ++v) {
      if (moved.row(v) != result.inner.row(v)) atWall[at(v)] = 1;
    }
    result.inner = std::move(moved);
    if (isThin && keepsConstraints(result)) break; // more rounds are slow and in vain
  }
  result.inner = task_.deliverable(result.inner);
  return Closed{std::move(result), isPressed};
}

/// Leaves out components that nothing holds, and those of less volume.
void Capping::dropSpecks(double leastVolume, Capped& capped) const {
  const Points& vertices = capped.mesh.vertices;
  const Components components = connectedComponents(vertices.rows(), capped.mesh.faces);
  std::vector<Faces> left;
  for (const Faces& part : components) {
    const auto all = part.reshaped();
    const bool isHeld = std::any_of(all.begin(), all.end(), [&](int v) { return v < n_; });
    if (isHeld && signedVolume(vertices, part) >= leastVolume) {
      left.push_back(part);
      continue;
    }
    for (const int v : all) {
      if (v < n_) capped.solid[at(v)] = 1;
    }
  }
  if (left.size() < components.size()) capped.mesh.faces = joined(left);
}

CavityResult Capping::resultOf(const Capped& capped) const {
  CavityResult result = found_;
  result.inner = capped.mesh.vertices;
  result.cavity = {capped.mesh.faces, capped.mesh.faces.rows(), capped.solid};
  return result;
}

/// With room for rounding.
bool Capping::keepsConstraints(const CavityResult& result) const {
  const double most = mostViolation_ > kFeasibility ? mostViolation_ : 0.1 * kFeasibility;
  return task_.weights.constraints <= 0.0 || hollowBody(task_, result).violation <= most;
}

/// Presses the caps in and out until the constraints hold; false where they do not. `farthest`:
/// walls, in the mean square. `atWall`: vertices that must not move.
bool Capping::press(const Skin& skin, double farthest, const Marks& atWall,
                    CavityResult& result) const {
  const Eigen::Index terms = task_.goal.usesInertia() ? 10 : 4;
  RowMatrix pressures = RowMatrix::Zero(result.inner.rows(), terms);
  Points directions = vertexNormals(result.inner, result.cavity.faces);
  for (Eigen::Index v = 0; v < result.inner.rows(); ++v) {
    if (v < n_ || atWall[at(v)] != 0) directions.row(v).setZero();
    if (v < n_) continue;
    pressures.row(v) = monomials(result.inner.row(v).transpose()).head(terms).transpose();
  }
  const DisplacementTask displacement{movedGoal_ ? *movedGoal_ : task_.goal,
                                      task_.weights,
                                      task_.model.fillings,
                                      outerMass_,
                                      task_.model.solidMoments[0],
                                      result.cavity.faces,
                                      directions,
                                      farthest * task_.wall,
                                      skin.deflections(pressures)};
  const Displaced done = displace(displacement, result.inner);
  result.effort.evaluations += done.evaluations;
  return done.evaluations > 0 && done.violation <= mostViolation_;
}

/// As `greatestVolume` has it.
bool Capping::keepsVolume(const CavityResult& result) const {
  if (task_.model.outer) return true;
  const double volume = signedVolume(result.inner, result.cavity.faces);
  return volume <= signedVolume(found_.inner, found_.cavity.faces) ||
         volume <= greatestVolume(task_);
}

Capping::Loss Capping::lossOf(const Body& before, const Body& after) const {
  const Body solid = inputBody(task_);
  if (before.measure && after.measure && solid.measure) {
    const double most = kMostLoss * std::abs(*before.measure - *solid.measure);
    const double beyond = *before.measure - task_.goal.wantedLevel();
    return {*before.measure - *after.measure, beyond >= 0.0 ? std::min(most, beyond) : most};
  }
  return {after.objective - before.objective,
          kMostLoss * std::abs(solid.objective - before.objective)};
}

bool Capping::isWorthIt(const CavityResult& result) const {
  if (!keepsVolume(result)) return false;
  const Body before = hollowBody(task_, found_);
  const Body after = hollowBody(task_, result);
  if (task_.weights.constraints > 0.0) {
    if (after.violation > mostViolation_) return false;
    if (before.violation > kFeasibility) return true; // what a missed goal lacks counts alone
  }
  const Loss loss = lossOf(before, after);
  return loss.is <= loss.most;
}

/// Without contents up to a level, which ends are not told apart by.
Body Capping::bodyWith(const Moments& cavity) const {
  const Goal& goal = movedGoal_ ? *movedGoal_ : task_.goal;
  std::vector<Moments> states;
  for (const Filling& filling : task_.model.fillings) {
    if (!filling.isPartial()) states.emplace_back(outerMass_ - (1.0 - filling.density) * cavity);
  }
  Body body;
  body.objective = momentObjective(goal, task_.weights, states,
                                   (outerMass_[0] - cavity[0]) / task_.model.solidMoments[0]);
  body.measure = measure(goal, states);
  return body;
}

/// The ends that cost least keep their caps, as many as may be if each costs what it would alone;
/// the costliest stays as it was. Where the volume is too large that is what counts.
void Capping::giveUpCostliest(const CavityResult& result, const std::vector<int>& end) {
  const Faces& before = found_.cavity.faces;
  const Moments cavity = moments(found_.inner, before);
  const Body body = bodyWith(cavity);
  const bool keeps = keepsVolume(result);
  Points both(result.inner.rows() + n_, 3);
  both << result.inner, found_.inner.topRows(n_);
  const auto first = static_cast<int>(result.inner.rows());
  std::vector<std::pair<double, int>> costs;
  for (int number = 0; number < ends_.count; ++number) {
    if (isGivenUp_[at(number)] != 0) continue;
    const auto isOfEnd = [&](const Faces& faces, Eigen::Index f) {
      return std::any_of(faces.row(f).begin(), faces.row(f).end(),
                         [&](int v) { return end[at(v)] == number; });
    };
    // What lies between the two surfaces there.
    const Faces now = facesWhere(result.cavity.faces,
                                 [&](Eigen::Index f) { return isOfEnd(result.cavity.faces, f); });
    Faces was = facesWhere(before, [&](Eigen::Index f) { return isOfEnd(before, f); });
    was.col(1).swap(was.col(2));
    was.array() += first;
    const Moments change = moments(both, joined({now, was}));
    const double cost = keeps ? lossOf(body, bodyWith(cavity + change)).is : change[0];
    costs.emplace_back(cost, number);
  }
  std::sort(costs.begin(), costs.end());
  double left = keeps ? lossOf(body, body).most : 0.0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    left -= costs[i].first;
    const bool isCostliest = i + 1 == costs.size();
    if (isCostliest || left < 0.0) isGivenUp_[at(costs[i].second)] = 1;
  }
}

/// Ends at which something is wrong stay as they were. False where it is wrong elsewhere.
bool Capping::giveUp(const CavityResult& result, const std::vector<int>& end) {
  const VertexAdjacency neighbours = vertexAdjacency(result.inner.rows(), result.cavity.faces);
  Marks isWrong(at(ends_.count), 0);
  const auto giveUpAt = [&](int v) {
    const int number = end[at(v)];
    if (number >= 0 && isGivenUp_[at(number)] == 0) isWrong[at(number)] = 1;
  };
  for (const std::vector<int>* wrong : {&result.inspection.crossing, &result.inspection.thin}) {
    for (const int v : *wrong) {
      giveUpAt(v);
      for (const int w : neighbours[at(v)]) giveUpAt(w);
    }
  }
  for (std::size_t number = 0; number < isWrong.size(); ++number) {
    if (isWrong[number] != 0) isGivenUp_[number] = 1;
  }
  return std::find(isWrong.begin(), isWrong.end(), 1) != isWrong.end();
}

} // namespace

CavityResult withSmoothCaps(const CavityTask& task, const CavityResult& found) {
  if (found.status != CavityStatus::Found || task.open != nullptr || found.cavity.faces.rows() == 0)
    return found;
  return Capping(task, found).run();
}

} // namespace massprops
