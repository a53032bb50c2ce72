// What the coarse copies of the surface cost: the result against the one that skeleton, basis and
// cavity on the whole surface give.
#include "core/pipeline.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace massprops::testing {
namespace {

struct Sample {
  const char* name;
  GoalKind goal;
  int subdivisions;
};

class Shortcuts : public ::testing::TestWithParam<Sample> {};

TEST_P(Shortcuts, CostAtMostTwoPercentOfTheImprovement) {
  TriangleMesh mesh = sampleMesh(GetParam().name);
  for (int i = 0; i < GetParam().subdivisions; ++i) mesh = subdivided(mesh);
  Options options;
  options.goal = GetParam().goal;
  const Report quick = optimizeMassProperties(mesh, options).report;
  options.fullResolution = true;
  const Report full = optimizeMassProperties(mesh, options).report;
  EXPECT_TRUE(std::get<bool>(full.at("solved")));
  EXPECT_TRUE(std::get<bool>(quick.at("solved")));
  EXPECT_LE(std::get<double>(quick.at("max_constraint_violation")), 1e-6);
  const double before = std::get<double>(full.at("objective_before"));
  const double best = std::get<double>(full.at("objective_after"));
  const double cost = (std::get<double>(quick.at("objective_after")) - best) / (before - best);
  std::printf("%s, %ld vertices: improvement %.4f, cost of the shortcuts %.2f %%\n",
              GetParam().name, static_cast<long>(mesh.vertices.rows()), before - best,
              100.0 * cost);
  EXPECT_LE(cost, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Samples, Shortcuts,
                         ::testing::Values(Sample{"box_on_corner", GoalKind::Stand, 0},
                                           Sample{"toy_dinosaur", GoalKind::Stand, 0},
                                           Sample{"toy_dinosaur", GoalKind::Stand, 1},
                                           Sample{"leaning_ring", GoalKind::Stand, 0},
                                           Sample{"leaning_ring", GoalKind::Stand, 1},
                                           Sample{"toy_dog", GoalKind::Stand, 0},
                                           Sample{"toy_dog", GoalKind::Stand, 1},
                                           Sample{"tilted_ellipsoid_top", GoalKind::Spin, 2}),
                         [](const auto& sample) {
                           return std::string(sample.param.name) + "_" +
                                  std::to_string(sample.param.subdivisions);
                         });

} // namespace
} // namespace massprops::testing
