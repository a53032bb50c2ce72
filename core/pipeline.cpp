#include "core/pipeline.h"

#include "core/cavity_search.h"
#include "core/contact.h"
#include "core/frame.h"
#include "core/goals.h"
#include "core/harmonics.h"
#include "core/laplacian.h"
#include "core/offset_field.h"
#include "core/skeleton.h"
#include "core/solid.h"
#include "core/stopwatch.h"
#include "core/validity.h"

#include <algorithm>
#include <cmath>
#include <future>

namespace massprops {
namespace {

/// Smooths the noise of the skeleton's correspondence and keeps its shape.
constexpr double kDiffusionLength = 0.02;
constexpr double kDefaultWall = 0.01;
constexpr double kFeasibility = 1e-6;

/// The model in the working frame, standing on its contact area's centre.
struct Workpiece {
  Frame frame;
  Points vertices;
  ContactArea contact; ///< working lengths
  double wall;         ///< working length
};

void requireSensible(const Options& options, const Solid& solid) {
  const auto require = [](bool holds, const std::string& sentence) {
    if (!holds) throw InvalidInput(sentence);
  };
  const auto finite = [](double value) { return std::isfinite(value); };
  require(options.basisSize >= 1, "basis_k is " + std::to_string(options.basisSize) +
                                      ": give at least 1; 36 suits most models.");
  require(options.basisSize < solid.vertices().rows(),
          "basis_k is " + std::to_string(options.basisSize) + ", but this model has only " +
              std::to_string(solid.vertices().rows()) +
              " vertices: lower basis_k below that, or refine the model with Remeshing > "
              "Subdivision Surfaces: Midpoint.");
  for (const std::optional<double>& radius : {options.radiusX, options.radiusY}) {
    require(!radius || (finite(*radius) && *radius > 0.0),
            "radius_x and radius_y must be positive, or 0 to take them from the model.");
  }
  require(options.radiusX.has_value() == options.radiusY.has_value(),
          "Give both radius_x and radius_y, or leave both 0 to take them from the model.");
  require(!options.innerLowerBound ||
              (finite(*options.innerLowerBound) && *options.innerLowerBound > 0.0),
          "inner_lower_bound, the minimum wall, must be greater than 0.");
  require(finite(options.innerUpperBound) && options.innerUpperBound > 0.0 &&
              options.innerUpperBound <= 1.0,
          "inner_upper_bound is a factor on the distance to the skeleton: give a value above 0 and "
          "at most 1.");
  require(!options.innerLowerBound ||
              *options.innerLowerBound < options.innerUpperBound * solid.diagonal(),
          "inner_lower_bound lies above inner_upper_bound for every point of this model: lower the "
          "minimum wall.");
  require(finite(options.outerLowerBound) && finite(options.outerUpperBound) &&
              options.outerLowerBound >= 0.0 && options.outerUpperBound >= 0.0,
          "outer_lower_bound and outer_upper_bound must be 0 or positive: the outer surface only "
          "moves outwards.");
  require(options.outerLowerBound <= options.outerUpperBound,
          "outer_lower_bound is greater than outer_upper_bound: swap them.");
  require(options.outerUpperBound <= 0.5 * solid.diagonal(),
          "outer_upper_bound is more than half of the model's diagonal: lower it.");
  const Weights& w = options.weights;
  for (const double weight :
       {w.volume, w.centerOfMass, w.inertia, w.smoothness, w.constraints, w.outer}) {
    require(finite(weight) && weight >= 0.0, "opt_weight_1 to opt_weight_6 must be 0 or positive.");
  }
  require(finite(options.density) && options.density > 0.0,
          "density must be greater than 0 g/cm³; PLA has 1.24.");
  require(finite(options.fillDensity) && options.fillDensity >= 0.0,
          "fill_density must be 0 (an empty cavity) or positive.");
}

Workpiece prepare(const Solid& solid, const Options& options) {
  Workpiece piece;
  piece.frame.rotation = rotationToUp(options.upAxis);
  const Points upright = solid.vertices() * piece.frame.rotation.transpose();
  std::optional<Vec2> radii;
  if (options.radiusX && options.radiusY) radii = Vec2(*options.radiusX, *options.radiusY);
  const GroundContact contact = groundContact(upright, radii);
  piece.frame.origin = piece.frame.rotation.transpose() * contact.centre;
  piece.frame.length = solid.diagonal();
  piece.contact = scaled(contact.area, solid.diagonal());
  piece.vertices = snapped(toWorking(piece.frame, solid.vertices()));
  piece.wall = options.innerLowerBound.value_or(kDefaultWall * solid.diagonal()) / solid.diagonal();
  return piece;
}

void requireNoSelfIntersection(const Workpiece& piece, const Faces& faces) {
  const std::size_t crossing = selfIntersectingFaces(piece.vertices, faces).size();
  if (crossing > 0) {
    throw InvalidInput("The surface crosses itself: " + std::to_string(crossing) +
                       " faces intersect others. Use Selection > Select Self Intersecting Faces, "
                       "delete them and use Remeshing > Close Holes, then run again.");
  }
}

std::unique_ptr<Goal> makeGoal(const Options& options, const Workpiece& piece,
                               const Moments& solidMoments) {
  switch (options.goal) {
  case GoalKind::Stand:
    return makeStandGoal(piece.contact, options.weights);
  case GoalKind::Spin:
    return makeSpinGoal(solidMoments, options.weights, piece.frame.length);
  }
  throw InvalidInput("This goal does not exist: choose one from the list.");
}

/// A body in the model's own coordinates and in grams.
MassProperties inModel(const Moments& massMoments, const Frame& frame, double density) {
  const MassProperties working = massProperties(massMoments);
  const double grams = density * std::pow(frame.length, 3) / 1000.0;
  MassProperties body;
  body.mass = working.mass * grams;
  body.centerOfMass =
      frame.rotation.transpose() * working.centerOfMass * frame.length + frame.origin;
  body.inertiaTensor = frame.rotation.transpose() * working.inertiaTensor * frame.rotation * grams *
                       frame.length * frame.length;
  return body;
}

/// The vertices that `faces` use, renumbered.
TriangleMesh compacted(const Points& vertices, const Faces& faces) {
  std::vector<int> index(static_cast<std::size_t>(vertices.rows()), -1);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    index[static_cast<std::size_t>(faces.data()[i])] = 0;
  }
  TriangleMesh mesh;
  mesh.vertices.resize(std::count(index.begin(), index.end(), 0), 3);
  int next = 0;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (index[static_cast<std::size_t>(v)] < 0) continue;
    mesh.vertices.row(next) = vertices.row(v);
    index[static_cast<std::size_t>(v)] = next++;
  }
  mesh.faces = faces.unaryExpr([&](int v) { return index[static_cast<std::size_t>(v)]; });
  return mesh;
}

std::string verdict(const Goal& goal, const Moments& before, const Moments& after, bool hollow,
                    double violation) {
  if (!hollow) {
    return "Nothing can be hollowed at this wall: lower inner_lower_bound.";
  }
  const std::string reached = goal.isReached(after) ? "The goal is reached" : "The goal is missed";
  const std::string was = goal.isReached(before) ? " (the solid model reaches it too)" : "";
  return violation <= kFeasibility
             ? reached + was + "; all constraints hold."
             : reached + was + "; the best cavity found violates a constraint by " +
                   toString(violation) + " of the model's size.";
}

} // namespace

Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress) {
  const auto tell = [&](int percent, const char* stage) {
    if (progress) progress(percent, stage);
  };
  const Stopwatch total;
  tell(0, "Checking the model");
  const Solid solid = makeSolid(model);
  requireSensible(options, solid);
  const Workpiece piece = prepare(solid, options);
  requireNoSelfIntersection(piece, solid.faces());

  // The basis does not need the skeleton: both cores work.
  tell(5, "Mean curvature skeleton and harmonic basis");
  const SparseMatrix L = cotanLaplacian(piece.vertices, solid.faces());
  const Vector area = vertexLumpedMass(piece.vertices, solid.faces());
  const Vector mass = area / area.sum();
  double secondsBasis = 0.0;
  std::future<HarmonicBasis> pendingBasis = std::async(std::launch::async, [&] {
    const Stopwatch time;
    HarmonicBasis result = harmonicBasis(L, mass, options.basisSize);
    secondsBasis = time.seconds();
    return result;
  });
  const Stopwatch skeletonTime;
  const Points skeleton = meanCurvatureSkeleton(piece.vertices, solid.faces());
  const double secondsSkeleton = skeletonTime.seconds();

  const HarmonicBasis basis = pendingBasis.get();

  tell(65, "Offset directions");
  const OffsetField field =
      offsetField(piece.vertices, solid.faces(), skeleton, L, area, kDiffusionLength);

  tell(70, "Optimization");
  const Moments outerMoments = moments(piece.vertices, solid.faces());
  const std::unique_ptr<Goal> goal = makeGoal(options, piece, outerMoments);
  CavityTask task{piece.vertices, solid.faces(), field, basis, L, mass, *goal, options.weights};
  task.solidMoments = outerMoments;
  task.fillDensity = options.fillDensity / options.density;
  task.wall = piece.wall;
  task.inner = keepingWall(piece.vertices, solid.faces(), field,
                           innerBounds(field, piece.wall, options.innerUpperBound), piece.wall);
  if (options.outerUpperBound > 0.0) {
    task.outer = outerBounds(piece.vertices, field, options.outerLowerBound / piece.frame.length,
                             options.outerUpperBound / piece.frame.length);
  }
  const auto representable = [&](const Points& modelPoints) {
    return options.representable ? options.representable(modelPoints) : modelPoints;
  };
  task.deliverable = [&](const Points& working) {
    return toWorking(piece.frame, representable(toModel(piece.frame, working)));
  };
  const CavityResult cavity = searchCavity(
      task, [&](double share) { tell(70 + static_cast<int>(25.0 * share), "Optimization"); });

  tell(95, "Report");
  Result result;
  const bool hollow = cavity.cavity.faces.rows() > 0;
  const Moments innerMoments = moments(cavity.inner, cavity.cavity.faces);
  const Moments movedMoments = moments(cavity.outer, solid.faces());
  const Moments before = outerMoments;
  const Moments after = shellMoments(movedMoments, innerMoments, 1.0, task.fillDensity);
  const double violation = largestViolation(*goal, after);
  const MassProperties bodyBefore = inModel(before, piece.frame, options.density);
  const MassProperties bodyAfter = inModel(after, piece.frame, options.density);
  const double unitVolume = std::pow(piece.frame.length, 3);

  Report& report = result.report;
  report.add("goal", std::string(options.goal == GoalKind::Stand ? "Stand" : "Spin"));
  report.add("solved", hollow && violation <= kFeasibility);
  report.add("message", verdict(*goal, before, after, hollow, violation));
  report.add("objective_before",
             objectiveValue(*goal, options.weights, before, 1.0, L, {}, mass, {}));
  report.add("objective_after",
             objectiveValue(*goal, options.weights, after,
                            (movedMoments[0] - innerMoments[0]) / outerMoments[0], L,
                            cavity.innerOffsets, mass, cavity.outerOffsets));
  report.add("max_constraint_violation", violation);
  report.add("volume_before", outerMoments[0] * unitVolume);
  report.add("volume_after", (movedMoments[0] - innerMoments[0]) * unitVolume);
  report.add("mass_before", bodyBefore.mass);
  report.add("mass_after", bodyAfter.mass);
  report.add("center_of_mass_before", bodyBefore.centerOfMass);
  report.add("center_of_mass_after", bodyAfter.centerOfMass);
  report.add("inertia_tensor_before", bodyBefore.inertiaTensor);
  report.add("inertia_tensor_after", bodyAfter.inertiaTensor);
  goal->describe(before, "before", report);
  goal->describe(after, "after", report);
  report.add("min_wall", hollow ? cavity.inspection.leastWall * piece.frame.length : 0.0);
  report.add("cavity_components", cavity.inspection.components);
  report.add("solid_vertices", static_cast<int>(std::count(cavity.cavity.solid.begin(),
                                                           cavity.cavity.solid.end(), 1)));
  report.add("stop_reason", cavity.stopReason);
  report.add("rounds", cavity.rounds);
  report.add("evaluations", cavity.evaluations);
  report.add("seconds_skeleton", secondsSkeleton);
  report.add("seconds_basis", secondsBasis);
  report.add("seconds_optimization", cavity.secondsOptimization);
  report.add("seconds_inspection", cavity.secondsInspection);

  if (hollow) {
    result.inner =
        compacted(representable(toModel(piece.frame, cavity.inner)), cavity.cavity.faces);
    result.inner.faces.col(1).swap(result.inner.faces.col(2));
  }
  if (task.outer) {
    result.outer = TriangleMesh{representable(toModel(piece.frame, cavity.outer)), solid.faces()};
  }
  report.add("seconds_total", total.seconds());
  tell(100, "Done");
  return result;
}

} // namespace massprops
