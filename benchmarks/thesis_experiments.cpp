// The experiments of [Thesis] that table51 does not repeat: bounds mapped into the objective
// against plain ones (5.1.2), shapes rebuilt from k harmonics (3.3), the skeleton with its
// correspondences (3.2) and cavities at several k (5.3 to 5.6). benchmarks/results.md keeps the
// output.
//
// usage: thesis_experiments bounds | shapes [folder]
// Into the folder go the meshes that scripts/thesis_pictures.py makes pictures of.
#include "core/pipeline.h"
#include "core/pipeline_stages.h"
#include "core/reduced/harmonics.h"
#include "samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace massprops;

constexpr int kRuns = 5;

struct Sample {
  const char* name;
  const char* verdict; ///< key of what the goal is judged by
  GoalKind goal;
  /// Whether the methods of keeping bounds are compared on it: with 20,000 constraints SLSQP takes
  /// minutes.
  bool hasBoundsCompared;
};

constexpr Sample kSamples[] = {
    {"box_on_corner", "tip_angle", GoalKind::Stand, true},
    {"tilted_ellipsoid_top", "axis_tilt", GoalKind::Spin, true},
    {"toy_dinosaur", "tip_angle", GoalKind::Stand, false},
    {"toy_dog", "tip_angle", GoalKind::Stand, true},
    {"leaning_ring", "tip_angle", GoalKind::Stand, true},
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Of processor time of all threads, which other programs disturb least.
double medianSeconds(const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t start = std::clock();
    work();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return median(seconds);
}

double number(const Report& report, const std::string& key) {
  return std::get<double>(report.at(key));
}

Options optionsFor(const Sample& sample) {
  Options options;
  options.goal = sample.goal;
  options.cavityShape = CavityShape::Offset;
  return options;
}

/// Where the meshes go; nothing is written without a folder.
class Folder {
public:
  explicit Folder(std::string path) : path_(std::move(path)) {
    if (!path_.empty()) std::filesystem::create_directories(path_);
  }

  /// `colours`: one for each vertex, or none.
  void write(const std::string& name, const TriangleMesh& mesh,
             const std::vector<Colour>& colours = {}) const {
    if (path_.empty()) return;
    std::ofstream file = open(name + ".ply");
    file << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.rows()
         << "\nproperty double x\nproperty double y\nproperty double z\n";
    if (!colours.empty()) {
      file << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    file << "element face " << mesh.faces.rows()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    file.precision(12);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      file << mesh.vertices.row(v);
      if (!colours.empty()) {
        const Colour c = colours[static_cast<std::size_t>(v)];
        file << ' ' << int{c.red} << ' ' << int{c.green} << ' ' << int{c.blue};
      }
      file << '\n';
    }
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) file << "3 " << mesh.faces.row(f) << '\n';
  }

  void write(const std::string& name, const Report& report) const {
    if (path_.empty()) return;
    std::ofstream file = open(name + "_report.txt");
    for (const auto& [key, value] : report.entries) file << key << " = " << toString(value) << '\n';
  }

private:
  std::ofstream open(const std::string& name) const {
    std::ofstream file(std::filesystem::path(path_) / name);
    if (!file) throw std::runtime_error("cannot write " + name + " to " + path_);
    return file;
  }

  std::string path_;
};

// ---------------------------------------------------------------- bounds

/// One cavity with the full freedom of its offsets: what the methods of keeping bounds are tried
/// on. Everything but the bounds is the same for all of them.
struct BoundsTask {
  OffsetModel model;
  const Goal* goal;
  Weights weights;
  Matrix functions;       ///< n×k, at the vertices
  std::vector<int> moves; ///< the vertices that the cavity has
};

/// Vertices that the faces refer to.
std::vector<int> usedBy(const Faces& faces) {
  std::vector<int> used(faces.data(), faces.data() + faces.size());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

/// The cavity's triangles are those that the filter ends with, so that every vertex has room
/// between its bounds; these are the ones that it starts with.
BoundsTask boundsTask(const CavityTask& task) {
  BoundsTask result{task.model, &task.goal, task.weights, {}, {}};
  CavityTask searched = task;
  result.model.innerFaces = searchCavity(searched, {}).cavity.faces;
  result.model.inner.lower = task.model.inner.lower.cwiseMin(task.model.inner.upper);
  const MovingSurface& surface = *task.model.surface;
  result.functions.resize(surface.vertices.rows(), surface.basis.functions.cols());
  for (Eigen::Index j = 0; j < result.functions.cols(); ++j) {
    result.functions.col(j) = surface.interpolation * Vector(surface.basis.functions.col(j));
  }
  result.moves = usedBy(result.model.innerFaces);
  return result;
}

/// From fields Hα to offsets.
using Shape = std::function<BoundedOffsets(const OffsetBounds&, const Vector&)>;

/// The corrected arctangent of [Thesis, Eq. 3.12]: c + w/π · atan(π(t − c)/w).
BoundedOffsets arctangent(const OffsetBounds& bounds, const Vector& t) {
  constexpr double kPi = 3.14159265358979323846;
  BoundedOffsets result{t, Vector::Zero(t.size())};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double centre = 0.5 * (bounds.upper[i] + bounds.lower[i]);
    const double width = bounds.upper[i] - bounds.lower[i];
    const double tau = width > 0.0 ? kPi * (t[i] - centre) / width : 0.0;
    result.offsets[i] = centre + width / kPi * std::atan(tau);
    result.slopes[i] = width > 0.0 ? 1.0 / (1.0 + tau * tau) : 0.0;
  }
  return result;
}

/// Cut off at the bounds: not smooth.
BoundedOffsets clamped(const OffsetBounds& bounds, const Vector& t) {
  BoundedOffsets result{t.cwiseMax(bounds.lower).cwiseMin(bounds.upper), Vector::Zero(t.size())};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    result.slopes[i] = t[i] > bounds.lower[i] && t[i] < bounds.upper[i] ? 1.0 : 0.0;
  }
  return result;
}

BoundedOffsets unbounded(const OffsetBounds&, const Vector& t) {
  return {t, Vector::Ones(t.size())};
}

/// As `evaluate` of the filter, but for the shape. `field`: Hα.
Evaluation evaluateShape(const BoundsTask& task, const Vector& field, const Shape& shape) {
  const OffsetModel& model = task.model;
  const BoundedOffsets bounded = shape(model.inner, field);
  const Points inner =
      model.surface->vertices - bounded.offsets.asDiagonal() * model.field.directions;
  const MomentsWithRates cavity =
      momentsWithRates(inner, model.innerFaces, model.field.directions, task.goal->usesInertia());
  MomentJacobian jacobian = MomentJacobian::Zero(10, task.functions.cols());
  jacobian.topRows(cavity.rates.cols()).noalias() =
      -(cavity.rates.array().colwise() * bounded.slopes.array()).matrix().transpose() *
      task.functions;
  const double solid = model.solidMoments[0];
  const double fill = model.fillings.front().density;
  return evaluateBody(
      *task.goal, task.weights,
      {{shellMoments(model.solidMoments, cavity.moments, 1.0, fill), (fill - 1.0) * jacobian}},
      (solid - cavity.moments[0]) / solid, -jacobian.row(0).transpose() / solid);
}

/// How bounds are kept.
struct Method {
  const char* name;
  Shape shape;
  bool hasConstraints; ///< 2n linear ones on the k coefficients, given to the solver
};

const std::vector<Method>& methods() {
  static const std::vector<Method> list = {
      {"map of the filter", boundMap, false},
      {"arctangent", arctangent, false},
      {"2n linear constraints", unbounded, true},
      {"cut off", clamped, false},
  };
  return list;
}

/// l ≤ Hα ≤ u below the goal's own inequalities.
void addBounds(const BoundsTask& task, const Vector& field, Evaluation& e) {
  const auto n = static_cast<Eigen::Index>(task.moves.size());
  const Eigen::Index own = e.inequalities.size();
  e.inequalities.conservativeResize(own + 2 * n);
  e.inequalityJacobian.conservativeResize(own + 2 * n, task.functions.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int v = task.moves[static_cast<std::size_t>(i)];
    e.inequalities[own + i] = task.model.inner.lower[v] - field[v];
    e.inequalities[own + n + i] = field[v] - task.model.inner.upper[v];
    e.inequalityJacobian.row(own + i) = -task.functions.row(v);
    e.inequalityJacobian.row(own + n + i) = task.functions.row(v);
  }
}

/// What a method ends with.
struct Outcome {
  double objective = 0.0, violation = 0.0, seconds = 0.0;
  int evaluations = 0;
  /// Objective and violation of each evaluation, in their order.
  std::vector<std::array<double, 2>> history;
  Vector offsets;
};

double violationOf(const Evaluation& e) {
  double violation = 0.0;
  if (e.equalities.size() > 0) violation = e.equalities.cwiseAbs().maxCoeff();
  if (e.inequalities.size() > 0) violation = std::max(violation, e.inequalities.maxCoeff());
  return violation;
}

/// Patient enough that every method comes to its end.
MinimizeOptions patience() {
  MinimizeOptions options;
  options.maxEvaluations = 1000;
  options.objectiveTolerance = 1e-8;
  return options;
}

Outcome tryMethod(const BoundsTask& task, const Method& method) {
  Outcome outcome;
  const Problem problem = [&](const Vector& x) {
    const Vector field = task.functions * x;
    Evaluation e = evaluateShape(task, field, method.shape);
    if (method.hasConstraints) addBounds(task, field, e);
    outcome.history.push_back({e.objective, violationOf(e)});
    return e;
  };
  const OffsetBounds& bounds = task.model.inner;
  const Vector start = coefficientsFor(task.model, 0.5 * (bounds.lower + bounds.upper), {});
  MinimizeResult best;
  outcome.seconds = medianSeconds([&] {
    outcome.history.clear();
    best = minimize(problem, start, patience());
  });
  outcome.objective = best.objective;
  outcome.violation = best.violation;
  outcome.evaluations = best.evaluations;
  outcome.offsets = method.shape(bounds, task.functions * best.x).offsets;
  return outcome;
}

/// The number of the first evaluation that keeps all constraints to a millionth of the diagonal and
/// has this objective; 0: none.
int evaluationsTo(const Outcome& outcome, double objective) {
  for (std::size_t i = 0; i < outcome.history.size(); ++i) {
    const auto& [value, violation] = outcome.history[i];
    if (violation <= 1e-6 && value <= objective) return static_cast<int>(i) + 1;
  }
  return 0;
}

/// Share of the cavity's vertices whose offset is within a twentieth of its range from a bound.
double shareAt(const BoundsTask& task, const Outcome& outcome, bool isUpper) {
  const OffsetBounds& b = task.model.inner;
  const auto at = std::count_if(task.moves.begin(), task.moves.end(), [&](int v) {
    const double share = (outcome.offsets[v] - b.lower[v]) / (b.upper[v] - b.lower[v]);
    return isUpper ? share > 0.95 : share < 0.05;
  });
  return static_cast<double>(at) / static_cast<double>(task.moves.size());
}

void compareBounds(const Sample& sample) {
  const Options options = optionsFor(sample);
  const Progress silent;
  ProgressBar bar(silent);
  PreparedModel model(testing::sampleMesh(sample.name));
  const Preparation prepared = prepare(model, {}, options, bar);
  const Foundation foundation = coarsen(prepared, options, bar);
  const Search found = search(prepared, foundation, options, bar);
  const BoundsTask task = boundsTask(found.task);
  const double before = momentObjective(*task.goal, task.weights, {found.task.inputMoments}, 1.0);

  std::vector<Outcome> outcomes;
  double best = before;
  for (const Method& method : methods()) {
    outcomes.push_back(tryMethod(task, method));
    if (outcomes.back().violation <= 1e-6) best = std::min(best, outcomes.back().objective);
  }
  const double nearly = best + 0.01 * (before - best);
  std::printf("%s, %zu vertices, f of the solid %.6f\n", sample.name, task.moves.size(), before);
  for (std::size_t m = 0; m < outcomes.size(); ++m) {
    const Outcome& o = outcomes[m];
    std::printf("  %-22s %10.6f %8.2f%% %10.1e %6d %6d %8.2f %8.2f %7.0f%% %7.0f%%\n",
                methods()[m].name, o.objective, 100.0 * (before - o.objective) / (before - best),
                o.violation, o.evaluations, evaluationsTo(o, nearly),
                o.seconds / outcomes[0].seconds,
                o.seconds / o.evaluations * outcomes[0].evaluations / outcomes[0].seconds,
                100.0 * shareAt(task, o, false), 100.0 * shareAt(task, o, true));
  }
  std::fflush(stdout);
}

void compareAllBounds() {
  std::printf("Bounds mapped and plain; medians of %d runs, processor time as a multiple of the "
              "filter's map's.\n",
              kRuns);
  std::printf("  %-22s %10s %9s %10s %6s %6s %8s %8s %8s %8s\n", "bounds", "f", "gain", "violation",
              "evals", "to 99%", "time", "an eval.", "at least", "at most");
  for (const Sample& sample : kSamples) {
    if (sample.hasBoundsCompared) compareBounds(sample);
  }
}

// ---------------------------------------------------------------- harmonics

/// The surface whose coordinates are sums of the first harmonics: X ≈ H_k H_kᵀ M X.
Points rebuilt(const Points& vertices, const Vector& mass, const RowMatrix& functions, int k) {
  const auto first = functions.leftCols(k);
  return first * (first.transpose() * (mass.asDiagonal() * vertices));
}

void rebuild(const Sample& sample, const std::vector<int>& sizes, const Folder& folder) {
  const TriangleMesh mesh = testing::sampleMesh(sample.name);
  const double diagonal =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  const Vector area = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Vector mass = area / area.sum();
  const HarmonicBasis basis = harmonicBasis(mesh.vertices, mesh.faces, L, mass, sizes.back());
  const double volume = moments(mesh.vertices, mesh.faces)[0];
  Report errors;
  std::printf("%-21s %6ld", sample.name, static_cast<long>(mesh.vertices.rows()));
  for (const int k : sizes) {
    const Points shape = rebuilt(mesh.vertices, mass, basis.functions, k);
    const Vector squared = (shape - mesh.vertices).rowwise().squaredNorm();
    const double rms = std::sqrt(mass.dot(squared)) / diagonal;
    std::printf("  %5.2f %5.1f %4.0f", 100.0 * rms,
                100.0 * std::sqrt(squared.maxCoeff()) / diagonal,
                100.0 * moments(shape, mesh.faces)[0] / volume);
    const std::string name = std::string(sample.name) + "_rebuilt_" + std::to_string(k);
    folder.write(name, TriangleMesh{shape, mesh.faces});
    errors.add("rms_" + std::to_string(k), rms);
  }
  std::puts("");
  folder.write(std::string(sample.name) + "_rebuilt", errors);
  std::fflush(stdout);
}

void rebuildAll(const Folder& folder) {
  const std::vector<int> sizes = {4, 9, 16, 36, 100};
  std::printf(
      "\nShapes rebuilt from k harmonics: distance from the sample, root of the mean square "
      "and\nlargest, %% of the diagonal, and volume, %% of the sample's.\n%-21s %6s",
      "sample", "size");
  for (const int k : sizes) std::printf("  k = %-12d", k);
  std::puts("");
  for (const Sample& sample : kSamples) rebuild(sample, sizes, folder);
}

// ---------------------------------------------------------------- cavities

/// One sample's cavity with k functions, and what a run takes.
struct CavityOfSize {
  Result result;
  double seconds = 0.0;
};

CavityOfSize cavityOfSize(const TriangleMesh& model, Options options, int k) {
  CavityOfSize cavity;
  options.basisSize = k;
  cavity.seconds = medianSeconds([&] { cavity.result = optimizeMassProperties(model, options); });
  return cavity;
}

void hollow(const Sample& sample, const std::vector<int>& sizes, const Folder& folder) {
  const TriangleMesh model = testing::sampleMesh(sample.name);
  std::vector<CavityOfSize> cavities;
  cavities.reserve(sizes.size());
  for (const int k : sizes) cavities.push_back(cavityOfSize(model, optionsFor(sample), k));
  const auto usual = std::find(sizes.begin(), sizes.end(), Options{}.basisSize) - sizes.begin();
  const CavityOfSize& reference = cavities[static_cast<std::size_t>(usual)];
  std::printf("%s, f of the solid %.6f, %s %.2f\n", sample.name,
              number(reference.result.report, "objective_before"), sample.verdict,
              number(reference.result.report, std::string(sample.verdict) + "_before"));
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Report& report = cavities[i].result.report;
    std::printf("  %3d %10.6f %6.1f%% %8.2f %6s %6d %8.2f\n", sizes[i],
                number(report, "objective_after"), 100.0 * number(report, "gap_to_limit"),
                number(report, std::string(sample.verdict) + "_after"),
                std::get<bool>(report.at("solved")) ? "yes" : "no",
                std::get<int>(report.at("evaluations")), cavities[i].seconds / reference.seconds);
    const std::string name = std::string(sample.name) + "_k" + std::to_string(sizes[i]);
    folder.write(name, cavities[i].result.inner);
    folder.write(name, report);
  }
  std::fflush(stdout);
}

void hollowAll(const Folder& folder) {
  const std::vector<int> sizes = {4, 9, 16, 36, 64};
  std::printf(
      "\nCavities of k harmonics; medians of %d runs, processor time as a multiple of that at k = "
      "%d.\n  %3s %10s %7s %8s %6s %6s %8s\n",
      kRuns, Options{}.basisSize, "k", "f", "gap", "verdict", "solved", "evals", "time");
  for (const Sample& sample : kSamples) hollow(sample, sizes, folder);
}

// ---------------------------------------------------------------- skeletons

void drawSkeletons(const Folder& folder) {
  for (const Sample& sample : kSamples) {
    const TriangleMesh model = testing::sampleMesh(sample.name);
    folder.write(sample.name, model);
    Options options = optionsFor(sample);
    options.showAnswer = true;
    const Result result = optimizeMassProperties(model, options);
    if (!result.picture) continue;
    const ColouredMesh& skeleton = result.picture->skeleton;
    folder.write(std::string(sample.name) + "_skeleton", skeleton.mesh, skeleton.colours);
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::string part = argc > 1 ? argv[1] : "";
  try {
    if (part == "bounds") {
      compareAllBounds();
    } else if (part == "shapes") {
      const Folder folder(argc > 2 ? argv[2] : "");
      rebuildAll(folder);
      hollowAll(folder);
      if (argc > 2) drawSkeletons(folder);
    } else {
      std::fputs("usage: thesis_experiments bounds | shapes [folder]\n", stderr);
      return 2;
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
