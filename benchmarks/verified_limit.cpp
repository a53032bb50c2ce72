// How far the limit, which is calculated by cells, lies from what is proved for every cavity: all
// goals whose conditions are linear in a level, on the samples or on other models.
// benchmarks/results.md keeps the output.
//
// usage: verified_limit [wall in per cent of the diagonal [file of a model ...]]
// 2 and the samples where not given.
#include "core/base/angles.h"
#include "core/goals/registry.h"
#include "core/optimum/certificate.h"
#include "core/pipeline_stages.h"
#include "core/reduced/hollow_body.h"
#include "samples.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace massprops;

/// Effort of a proof that would not be felt, and of one that a run makes where the goal is missed.
constexpr std::size_t kFewCubes = 200000;
constexpr std::size_t kManyCubes = 1500000;

double degrees(double tangent) {
  return std::atan(tangent) * kDegrees;
}
double percent(double share) {
  return 100.0 * share;
}

/// What a level is in the goal's own unit: the tipping angle in degrees, how far below the wished
/// point the centre of mass is off the plumb line in per cent of the diagonal, the largest
/// violation in per cent of the displaced mass.
struct Case {
  GoalKind goal;
  double (*inUnit)(double level);
};

constexpr Case kCases[] = {
    {GoalKind::Stand, degrees},
    {GoalKind::StandEmptyAndFilled, degrees},
    {GoalKind::Hang, percent},
    {GoalKind::Float, percent},
};

/// In the goal's own unit.
struct Levels {
  double solid, estimate;
  double few, many;               ///< proved
  double body;                    ///< of the delivered one
  double secondsFew, secondsMany; ///< of processor time

  /// Whether a share of it means anything.
  bool hasGain() const { return estimate - solid > 0.05; }
  double excess(double proved) const { return 100.0 * (proved - estimate) / (estimate - solid); }
};

/// That the filter's cavity reaches, measured on its triangles.
double levelOf(const Search& found, const LinearConditions& conditions, const Options& options) {
  const Moments mass = hollowBody(found.task, found.cavity).mass;
  if (options.goal != GoalKind::StandEmptyAndFilled) return levelReached(conditions, mass);
  Report report;
  found.verdictAfter->describe(mass, "after", report);
  return std::tan(std::get<double>(report.at("tip_angle_filling_after")) / kDegrees);
}

/// Empty: there is no room, or the goal is reached and its level is no measure.
std::optional<Levels> levelsOf(const Preparation& model, const Options& options, const Case& c) {
  const Progress silent;
  ProgressBar bar(silent);
  const Foundation foundation = coarsen(model, options, bar);
  if (!foundation.possible || foundation.possible->bound.levels.empty()) return std::nullopt;
  const LinearConditions conditions = model.goal->conditions().front();
  const LevelBound& bound = foundation.possible->bound.levels.front();
  Levels levels{};
  levels.solid = c.inUnit(levelReached(conditions, model.solidMoments));
  levels.estimate = c.inUnit(bound.reached);
  const auto proved = [&](std::size_t cubes, double& seconds) {
    const std::clock_t start = std::clock();
    const std::optional<double> level =
        provedLevel(conditions, bound, model.solidMoments, foundation.possible->states,
                    model.surface, model.posed.wall, cubes);
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return level ? c.inUnit(*level) : std::numeric_limits<double>::infinity();
  };
  levels.few = proved(kFewCubes, levels.secondsFew);
  levels.many = proved(kManyCubes, levels.secondsMany);
  const Search found = search(model, foundation, options, bar);
  levels.body = found.cavity.status == CavityStatus::Found
                    ? c.inUnit(levelOf(found, conditions, options))
                    : levels.solid;
  return levels;
}

/// With a round contact area where the model touches the ground in a point.
std::optional<Levels> levelsOf(const TriangleMesh& mesh, double wall, const Case& c) {
  const double diagonal =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  Options options;
  options.goal = c.goal;
  options.cavityShape = CavityShape::BestPossible;
  options.innerLowerBound = wall * diagonal;
  if (c.goal == GoalKind::StandEmptyAndFilled) options.fillDensity = 1.0;
  for (const double radius : {0.0, 0.03 * diagonal}) {
    if (radius > 0.0) options.radiusX = options.radiusY = radius;
    try {
      const Progress silent;
      ProgressBar bar(silent);
      PreparedModel model(mesh);
      return levelsOf(prepare(model, {}, options, bar), options, c);
    } catch (const InvalidInput&) {
    }
  }
  return std::nullopt;
}

/// Middle and largest.
void summarize(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::printf("  %s: median %.3g, nine tenths below %.3g, largest %.3g\n", what,
              values[values.size() / 2], values[values.size() * 9 / 10], values.back());
}

} // namespace

int main(int argc, char** argv) {
  const double wall = (argc > 1 ? std::atof(argv[1]) : 2.0) / 100.0;
  std::vector<std::string> models(argv + std::min(argc, 2), argv + argc);
  if (models.empty()) models = testing::sampleFiles();
  std::printf("Wall %.3g %% of the diagonal.\n", 100.0 * wall);
  std::printf("%-23s %-21s %9s %9s %9s %9s %9s %7s %7s %6s %6s\n", "goal", "model", "solid",
              "delivered", "estimate", "proved", "quickly", "% above", "quickly", "s", "s");
  std::vector<double> apart, many, few, secondsMany, secondsFew;
  for (const std::string& file : models) {
    const TriangleMesh mesh = testing::meshFile(file);
    for (const Case& c : kCases) {
      const std::optional<Levels> l = levelsOf(mesh, wall, c);
      if (!l) continue;
      apart.push_back(l->many - l->estimate);
      if (l->hasGain()) {
        many.push_back(l->excess(l->many));
        few.push_back(l->excess(l->few));
      }
      secondsMany.push_back(l->secondsMany);
      secondsFew.push_back(l->secondsFew);
      std::printf("%-23s %-21s %9.4f %9.4f %9.4f %9.4f %9.4f %6.2f%% %6.2f%% %6.2f %6.2f%s\n",
                  goalEntry(c.goal).name.c_str(),
                  std::filesystem::path(file).stem().string().c_str(), l->solid, l->body,
                  l->estimate, l->many, l->few, l->excess(l->many), l->excess(l->few),
                  l->secondsMany, l->secondsFew, l->body > l->estimate ? " *" : "");
      std::fflush(stdout);
    }
  }
  std::printf("%zu cases; * delivered body above the estimate.\n", apart.size());
  if (many.empty()) return 0;
  summarize("proved above the estimate, degrees or %", apart);
  summarize("the same in % of the gain, where there is one", many);
  summarize("the same quickly", few);
  summarize("seconds", secondsMany);
  summarize("seconds, quickly", secondsFew);
  return 0;
}
