// Runs on a model that was used before are those on a fresh one, byte for byte.
#include "core/pipeline.h"

#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

void expectSame(const TriangleMesh& mesh, const TriangleMesh& wanted, const std::string& what) {
  EXPECT_EQ(mesh.vertices, wanted.vertices) << what;
  EXPECT_EQ(mesh.faces, wanted.faces) << what;
}

void expectSame(const std::optional<TriangleMesh>& mesh, const std::optional<TriangleMesh>& wanted,
                const std::string& what) {
  ASSERT_EQ(mesh.has_value(), wanted.has_value()) << what;
  if (mesh) expectSame(*mesh, *wanted, what);
}

void expectSame(const Result& result, const Result& wanted, const std::string& what) {
  expectSame(result.inner, wanted.inner, what);
  expectSame(result.outer, wanted.outer, what);
  expectSame(result.drilled, wanted.drilled, what);
  ASSERT_EQ(result.report.entries.size(), wanted.report.entries.size()) << what;
  for (std::size_t i = 0; i < wanted.report.entries.size(); ++i) {
    const auto& [key, value] = result.report.entries[i];
    EXPECT_EQ(key, wanted.report.entries[i].first) << what;
    if (key.rfind("seconds_", 0) == 0) continue;
    EXPECT_EQ(value, wanted.report.entries[i].second) << what << ": " << key;
  }
}

struct Wish {
  std::string name;
  std::function<void(Options&)> set;
};

/// One after the other on one model, whatever they throw, each as on a fresh one.
void expectTheSameInTurn(const TriangleMesh& mesh, const Options& common,
                         const std::vector<Wish>& wishes) {
  Model model(mesh);
  for (const Wish& wish : wishes) {
    Options options = common;
    wish.set(options);
    std::optional<Result> fresh;
    std::string refusal;
    try {
      fresh = optimizeMassProperties(mesh, options);
    } catch (const InvalidInput& reason) {
      refusal = reason.what();
    }
    try {
      const Result result = model.run(options);
      ASSERT_TRUE(fresh) << wish.name << ": " << refusal;
      expectSame(result, *fresh, wish.name);
    } catch (const InvalidInput& reason) {
      EXPECT_EQ(reason.what(), refusal) << wish.name;
    }
  }
}

const Wish kStand{"Stand", [](Options&) {}};
const Wish kMass{"Mass", [](Options& o) { o.goal = GoalKind::Mass; }};
const Wish kOffset{"Offset surface", [](Options& o) {
                     o.goal = GoalKind::Mass;
                     o.cavityShape = CavityShape::Offset;
                   }};

Wish wall(double length) {
  return {"wall " + std::to_string(length), [=](Options& o) { o.innerLowerBound = length; }};
}

TEST(PreparedModel, GivesTheSameBytesForAnyGoalAndWall) {
  LARGE_TEST();
  Options common;
  common.basisSize = 12;
  expectTheSameInTurn(figure(5), common,
                      {kStand,
                       kMass,
                       kOffset,
                       wall(0.12),
                       wall(30.0),
                       {"Hang by a point",
                        [](Options& o) {
                          o.goal = GoalKind::Hang;
                          o.pivot = Vec3(0.1, 0.2, 3.0);
                        }},
                       {"an offset surface with a thicker wall",
                        [](Options& o) {
                          kOffset.set(o);
                          o.innerLowerBound = 0.15;
                        }},
                       {"lying",
                        [](Options& o) {
                          o.goal = GoalKind::Mass;
                          o.upAxis = UpAxis::PlusY;
                        }},
                       {"with radii", [](Options& o) { o.radiusX = o.radiusY = 0.4; }},
                       {"ceilings", [](Options& o) { o.overhangAngle = 40.0; }},
                       {"outer surface moves",
                        [](Options& o) {
                          o.goal = GoalKind::Mass;
                          o.outerUpperBound = 0.05;
                        }},
                       kStand});
}

TEST(PreparedModel, GivesTheSameBytesOnFeet) {
  LARGE_TEST();
  expectTheSameInTurn(blob(9), {},
                      {kStand,
                       kMass,
                       kStand,
                       wall(0.05),
                       {"no foot", [](Options& o) { o.foot = FootCut::Never; }},
                       {"a given foot",
                        [](Options& o) {
                          o.foot = FootCut::Given;
                          o.footDepth = 0.1;
                        }},
                       {"another one",
                        [](Options& o) {
                          o.foot = FootCut::Given;
                          o.footDepth = 0.2;
                        }},
                       kStand});
}

TEST(PreparedModel, GivesTheSameBytesWhereTheModelIsMended) {
  LARGE_TEST();
  const TriangleMesh two = joined(blob(7), shifted(blob(6), {0.9, 0.3, 0.1}));
  expectTheSameInTurn(two, {},
                      {kMass,
                       {"not mended", [](Options& o) { o.mend = false; }},
                       wall(0.05),
                       kStand,
                       wall(0.1),
                       {"as an open surface", [](Options& o) { o.openSurface = true; }},
                       kMass});
}

TEST(PreparedModel, GivesTheSameBytesWhereSomeOfItStaysSolid) {
  LARGE_TEST();
  const TriangleMesh model = roundedBox({2, 2, 3}, 0.2, 6, 3);
  const auto keep = [&](Options& o, Eigen::Index first, double depth) {
    o.goal = GoalKind::Mass;
    o.keptSolid = {model.vertices, model.faces.middleRows(first, 20)};
    o.solidDepth = depth;
  };
  expectTheSameInTurn(model, {},
                      {kMass,
                       {"some faces", [&](Options& o) { keep(o, 0, 0.5); }},
                       {"others", [&](Options& o) { keep(o, 100, 0.5); }},
                       {"deeper", [&](Options& o) { keep(o, 100, 0.8); }},
                       {"drilled",
                        [&](Options& o) {
                          o.goal = GoalKind::Mass;
                          o.drainHoles = 1;
                          o.drainDiameter = 1.0;
                        }},
                       kMass});
}

} // namespace
} // namespace massprops::testing
