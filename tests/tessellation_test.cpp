// What a body can do does not depend on the triangles that its surface is given in, on their unit
// or their place.
#include "core/pipeline.h"

#include "core/mesh/decimation.h"
#include "judge/checks.h"
#include "judge/guarantee.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace massprops::testing {
namespace {

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

double diagonal(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

Points asFloats(const Points& points) {
  return points.cast<float>().cast<double>();
}

/// The cavity keeps what every run guarantees.
void expectValid(const TriangleMesh& model, const Result& result, double wall) {
  ASSERT_GT(result.inner.faces.rows(), 0);
  EXPECT_TRUE(isClosedAndOriented(result.inner));
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_EQ(intersectingPairs(result.inner, model), 0U);
  EXPECT_TRUE(isInside(result.inner, model));
  EXPECT_GE(leastDistance(result.inner, model), wall);
}

/// A body, in triangles of different kinds.
struct Tessellated {
  std::string name;
  GoalKind goal;
  std::string verdict; ///< key of what the goal is judged by
  std::vector<TriangleMesh> meshes;
};

TriangleMesh leaning(const TriangleMesh& mesh) {
  return transformed(mesh, shear(0.3));
}

std::vector<Tessellated> bodies() {
  const TriangleMesh dinosaur = sampleMesh("toy_dinosaur");
  const TriangleMesh smooth = blob(20);
  const auto fewer = [](const TriangleMesh& mesh, Eigen::Index vertices) {
    return decimated(mesh.vertices, mesh.faces, {vertices, vertices, 0.0}).mesh;
  };
  const TriangleMesh block = box({3, 2, 4});
  const TriangleMesh corner = bracket(12);
  return {
      {"box",
       GoalKind::Stand,
       "tip_angle",
       {leaning(block), leaning(unevenlyCut(block, 4)), leaning(box({3, 2, 4}, 40))}},
      {"bracket",
       GoalKind::Mass,
       "mass",
       {corner, unevenlyCut(corner, 3), subdivided(subdivided(subdivided(subdivided(corner))))}},
      // A lump's decimated copies are other bodies by the sagittas of their triangles: within three
      // thousandths.
      {"blob", GoalKind::Mass, "mass", {smooth, unevenlyCut(smooth, 1), fewer(smooth, 2000)}},
      {"dinosaur",
       GoalKind::Stand,
       "tip_angle",
       {dinosaur, unevenlyCut(fewer(dinosaur, 6000), 1), subdivided(fewer(dinosaur, 6000))}},
  };
}

void PrintTo(const Tessellated& body, std::ostream* os) {
  *os << body.name;
}

std::string nameOf(const ::testing::TestParamInfo<Tessellated>& body) {
  return body.param.name;
}

class EveryTessellation : public ::testing::TestWithParam<Tessellated> {};
INSTANTIATE_TEST_SUITE_P(Pipeline, EveryTessellation, ::testing::ValuesIn(bodies()), nameOf);

TEST_P(EveryTessellation, LeadsToTheSameVerdictWithinTwoPerCentOfTheGain) {
  const Tessellated& body = GetParam();
  Options options;
  options.goal = body.goal;
  std::vector<double> verdicts;
  double gain = 0.0;
  for (const bool inFloats : {false, true}) {
    if (inFloats) options.representable = asFloats;
    // One in floats tells what they change.
    const auto last = inFloats ? body.meshes.begin() + 1 : body.meshes.end();
    for (auto given = body.meshes.begin(); given != last; ++given) {
      TriangleMesh mesh = *given;
      if (inFloats) mesh.vertices = asFloats(mesh.vertices);
      options.innerLowerBound = 0.01 * diagonal(mesh);
      const Result result = optimizeMassProperties(mesh, options);
      verdicts.push_back(number(result, body.verdict + "_after"));
      gain = std::abs(verdicts.back() - number(result, body.verdict + "_before"));
    }
  }
  const auto [least, greatest] = std::minmax_element(verdicts.begin(), verdicts.end());
  EXPECT_LE(*greatest - *least, 0.02 * gain) << *least << " to " << *greatest;
}

TEST(PipelineTessellation, OfTwelveTrianglesServesEveryKindOfGoal) {
  const TriangleMesh block = leaning(box({3, 2, 4}));
  struct Asked {
    GoalKind goal;
    std::function<void(Options&)> change = [](Options&) {};
  };
  for (const Asked& asked : std::vector<Asked>{{GoalKind::Stand},
                                               {GoalKind::Mass},
                                               {GoalKind::Spin},
                                               {GoalKind::Float},
                                               {GoalKind::Hang}}) {
    for (const CavityShape shape : {CavityShape::Automatic, CavityShape::Offset}) {
      Options options;
      options.goal = asked.goal;
      options.cavityShape = shape;
      asked.change(options);
      const Result result = optimizeMassProperties(block, options);
      expectValid(block, result, 0.01 * diagonal(block));
      // It has room for more than a thin layer.
      EXPECT_LT(number(result, "gap_to_limit"), 0.1) << static_cast<int>(asked.goal);
    }
  }
}

TEST(PipelineTessellation, IsAsFineAsTheBasisAsksFor) {
  Options options;
  options.cavityShape = CavityShape::Offset;
  options.basisSize = 200;
  const TriangleMesh block = leaning(box({3, 2, 4}));
  expectValid(block, optimizeMassProperties(block, options), 0.01 * diagonal(block));
}

TEST(PipelineTessellation, CountsInAnyUnitAndPlace) {
  const TriangleMesh corner = bracket(12);
  Options options;
  options.goal = GoalKind::Mass;
  const Result original = optimizeMassProperties(corner, options);
  const double share = number(original, "volume_after") / number(original, "volume_before");
  for (const double unit : {1e-3, 1e6}) {
    const Result result = optimizeMassProperties(scaled(corner, unit), options);
    EXPECT_NEAR(number(result, "volume_after") / number(result, "volume_before"), share,
                0.02 * (1.0 - share));
    expectValid(scaled(corner, unit), result, 0.01 * unit * diagonal(corner));
  }
  // A float has a step of 6e-5 there, a two thousandth of the wall.
  TriangleMesh far = shifted(corner, {1000, -600, 200});
  far.vertices = asFloats(far.vertices);
  options.representable = asFloats;
  const Result result = optimizeMassProperties(far, options);
  EXPECT_NEAR(number(result, "volume_after") / number(result, "volume_before"), share,
              0.02 * (1.0 - share));
  expectValid(far, result, 0.01 * diagonal(far));
}

TEST(PipelineTessellation, IsToldWhereCoordinatesAreTooCoarseForTheWall) {
  const TriangleMesh block = leaning(box({3, 2, 4}));
  Options options;
  options.goal = GoalKind::Mass;
  options.representable = asFloats;
  options.innerLowerBound = 0.05;
  const auto message = [](const Result& result) {
    return std::get<std::string>(result.report.at("message"));
  };
  for (const double distance : {0.0, 50.0, 1e5}) {
    TriangleMesh mesh = shifted(block, {distance, 0, 0});
    mesh.vertices = asFloats(mesh.vertices);
    const Result result = optimizeMassProperties(mesh, options);
    const double largest = mesh.vertices.cwiseAbs().maxCoeff();
    const double step = static_cast<double>(std::nextafter(static_cast<float>(largest), INFINITY)) -
                        largest; // the largest is a float
    EXPECT_NEAR(number(result, "rounding_step") / step, 1.0, 0.05);
    EXPECT_EQ(message(result).find("stored in steps") != std::string::npos, step > 0.0005);
    expectValid(mesh, result, *options.innerLowerBound);
  }
  options.representable = nullptr;
  EXPECT_EQ(number(optimizeMassProperties(block, options), "rounding_step"), 0.0);
}

} // namespace
} // namespace massprops::testing
