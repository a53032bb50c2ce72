// Every sample with its goal: what the solid does, what the hollowed body does, and how far that is
// from the best that any cavity with this wall could do, and at which share of the cavity's edges
// it turns by more than 60° and 100°. benchmarks/results.md keeps the output.
//
// usage: gaps [wall in per cent of the diagonal [entry of cavity_shape]]   2 and 0 where not given
#include "core/goals/registry.h"
#include "core/pipeline.h"
#include "judge/checks.h"
#include "samples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace massprops;

struct Case {
  const char* sample;
  GoalKind goal;
  const char* verdict; ///< key of what the goal is judged by
  std::function<void(Options&)> change = [](Options&) {};
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"box_on_corner", GoalKind::Stand, "tip_angle"},
      {"toy_dinosaur", GoalKind::Stand, "tip_angle"},
      {"leaning_ring", GoalKind::Stand, "tip_angle"},
      {"leaning_egg", GoalKind::Stand, "tip_angle"},
      {"toy_dog", GoalKind::Stand, "tip_angle"},
      {"leaning_skittle", GoalKind::Stand, "tip_angle"},
      {"tilted_ellipsoid_top", GoalKind::Spin, "axis_tilt"},
      {"uneven_yo_yo", GoalKind::YoYo, "axis_tilt"},
      {"leaning_jar", GoalKind::StandEmptyAndFilled, "tip_angle_filled",
       [](Options& o) { o.fillDensity = 0.6; }},
      {"roly_poly", GoalKind::RollUpright, "rest_tilt"},
      {"bath_duck", GoalKind::Float, "heel_angle", [](Options& o) { o.waterLevel = 0.4; }},
      {"hanging_fish", GoalKind::Hang, "hanging_angle"},
      {"game_piece", GoalKind::Mass, "mass_error",
       [](Options& o) {
         o.targetMass = 35.0;
         o.fillDensity = 5.0;
       }},
  };
  return list;
}

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

} // namespace

int main(int argc, char** argv) {
  const double wall = (argc > 1 ? std::atof(argv[1]) : 2.0) / 100.0;
  std::printf("Wall %.3g %% of the diagonal; one run each; seconds of wall time.\n", 100.0 * wall);
  std::printf("%-23s %-21s %-17s %8s %8s %8s  %-6s %9s %6s %6s %6s %7s\n", "goal", "sample",
              "judged by", "before", "after", "limit", "solved", "violation", "gap", "> 60°",
              "> 100°", "seconds");
  std::vector<double> gaps;
  for (const Case& c : cases()) {
    const TriangleMesh model = testing::sampleMesh(c.sample);
    Options options;
    options.goal = c.goal;
    options.innerLowerBound =
        wall * (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
    if (argc > 2) options.cavityShape = static_cast<CavityShape>(std::atoi(argv[2]));
    c.change(options);
    const Result result = optimizeMassProperties(model, options);
    const std::string verdict = c.verdict;
    gaps.push_back(number(result, "gap_to_limit"));
    std::printf("%-23s %-21s %-17s %8.2f %8.2f %8.2f  %-6s %9.1e %5.1f%% %5.2f%% %5.2f%% %7.2f\n",
                goalNames()[static_cast<std::size_t>(c.goal)].c_str(), c.sample, c.verdict,
                number(result, verdict + "_before"), number(result, verdict + "_after"),
                number(result, verdict + "_limit"),
                std::get<bool>(result.report.at("solved")) ? "yes" : "no",
                number(result, "max_constraint_violation"), 100.0 * gaps.back(),
                100.0 * testing::shareOfSharpEdges(result.inner, 60.0),
                100.0 * testing::shareOfSharpEdges(result.inner, 100.0),
                number(result, "seconds_total"));
    std::fflush(stdout);
  }
  std::sort(gaps.begin(), gaps.end());
  std::printf("Gap: median %.1f %%, largest %.1f %%.\n", 100.0 * gaps[gaps.size() / 2],
              100.0 * gaps.back());
}
