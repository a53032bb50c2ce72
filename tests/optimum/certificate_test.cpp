// Proofs that no cavity can do what is asked for, against closed forms.
#include "core/optimum/certificate.h"

#include "cells.h"
#include "core/base/angles.h"
#include "core/base/cube_cut.h"
#include "core/goals/mass.h"
#include "core/goals/registry.h"
#include "core/goals/stand.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/optimum/optimal_bound.h"
#include "core/physics/moments.h"
#include "large_test.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace massprops::testing {
namespace {

TEST(CubeCut, IsExactWhereAPlaneCutsOffACorner) {
  const Vec3 diagonal = Vec3::Ones().normalized();
  // x + y + z ≥ 1 of [0, 1]³ is all but a sixth; about the middle the plane is half an edge off.
  const CubeCut most = cubeCut(diagonal, (1.0 - 1.5) / std::sqrt(3.0));
  EXPECT_NEAR(most.volume, 5.0 / 6.0, 1e-14);
  // The corner's centroid is a quarter of an edge from the corner: (1/2 − 1/24)/(5/6) of [0, 1].
  EXPECT_NEAR(most.centroid.x(), (0.5 - 1.0 / 24.0) / (5.0 / 6.0) - 0.5, 1e-14);
  EXPECT_NEAR(cubeCut(diagonal, 0.0).volume, 0.5, 1e-14);
  const double quarter = 0.25 * 3.0 / std::sqrt(3.0); // a quarter of the width off the middle
  EXPECT_NEAR(cubeCut(diagonal, -quarter).volume, 1.0 - std::pow(0.75, 3) / 6.0, 1e-14); // 0.929…
}

TEST(CubeCut, AgreesWithSamples) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 normal = Vec3(random(), random(), random()).normalized();
    const double depth = 0.6 * random();
    int hits = 0;
    Vec3 sum = Vec3::Zero();
    constexpr int kAlong = 60;
    for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
      const Vec3 x(((i % kAlong) + 0.5) / kAlong - 0.5,
                   ((i / kAlong % kAlong) + 0.5) / kAlong - 0.5,
                   ((i / kAlong / kAlong) + 0.5) / kAlong - 0.5);
      if (normal.dot(x) < depth) continue;
      ++hits;
      sum += x;
    }
    const CubeCut cut = cubeCut(normal, depth);
    const double volume = hits / std::pow(kAlong, 3);
    // Cells are in or out by their middles, normals are turned by up to 0.6°.
    EXPECT_NEAR(cut.volume, volume, 0.012) << normal.transpose() << ", " << depth;
    if (hits == 0) continue;
    EXPECT_LT((cut.volume * cut.centroid - volume * sum / hits).norm(), 0.012);
  }
}

/// Of 1 along each side, its foot on the ground.
TriangleMesh standingCube() {
  return transformed(box({1, 1, 1}, 6), Mat3::Identity(), Vec3(0, 0, 0.5));
}

class Proof : public ::testing::Test {
protected:
  Proof()
      : mesh_(sampleMesh("leaning_egg")), posed_(makePosedModel(makeSolid(mesh_), {})),
        surface_(posed_.vertices, posed_.faces), solid_(moments(posed_.vertices, posed_.faces)),
        conditions_(makeStandGoal(posed_.contact, {})->conditions().front()),
        bound_(greatestLevel(conditions_, solid_, {{}}, cellsBehind(surface_, posed_.wall))) {}

  std::optional<Certificate> prove(double angle) const {
    return certificate(conditions_, std::tan(angle / kDegrees), bound_, solid_, {{}}, surface_,
                       posed_.wall);
  }
  double best() const { return std::atan(bound_.reached) * kDegrees; }

  TriangleMesh mesh_;
  PosedModel posed_;
  TriangleTree surface_;
  Moments solid_;
  LinearConditions conditions_;
  LevelBound bound_;
};

TEST_F(Proof, IsFoundWhereTheBestFailsByAFifthOfADegree) {
  const auto proof = prove(best() + 0.2);
  ASSERT_TRUE(proof);
  EXPECT_GT(proof->margin, 0.0);
  EXPECT_GE(proof->multipliers.minCoeff(), 0.0);
  // The functional is the sum of the conditions, and positive for solid and best body.
  EXPECT_LT((proof->rows.transpose() * proof->multipliers - proof->functionals).norm(), 1e-12);
  for (const Moments& body : {solid_, bound_.states.front()}) {
    EXPECT_GE(proof->functionals.col(0).head<10>().dot(body) + proof->functionals(10, 0),
              0.9 * proof->margin);
  }
}

TEST_F(Proof, IsNotFoundForWhatABodyReaches) {
  LARGE_TEST();
  EXPECT_FALSE(prove(best() - 0.01));
}

TEST_F(Proof, BoundsTheBestBodyCloselyByDuality) {
  EXPECT_NEAR(std::atan(bound_.level) * kDegrees, best(), 0.02);
  EXPECT_GE(bound_.level, bound_.reached);
}

TEST_F(Proof, OfALevelLiesHardlyAboveTheBest) {
  LARGE_TEST();
  const double ofSolid = std::atan(levelReached(conditions_, solid_)) * kDegrees;
  const double gain = best() - ofSolid;
  for (const auto& [cubes, share] : {std::pair(300000, 0.02), std::pair(1000000, 0.005)}) {
    const auto level = provedLevel(conditions_, bound_, solid_, {{}}, surface_, posed_.wall,
                                   static_cast<std::size_t>(cubes));
    ASSERT_TRUE(level);
    const double angle = std::atan(*level) * kDegrees;
    // Cells take the border for planes: what they tell lies within a thousandth of the gain.
    EXPECT_GT(angle, best() - 0.001 * gain);
    EXPECT_LT(angle, best() + share * gain);
    EXPECT_TRUE(prove(angle));
  }
}

HalfSpaces halfSpace(const Vec3& normal, double limit) {
  return {normal.transpose(), Vector::Constant(1, limit)};
}

TEST(Certificate, IsOnlyFoundForHalfSpacesThatHoldAllCentres) {
  LARGE_TEST();
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  const Moments solid = moments(cube.vertices, cube.faces);
  // Hollow above h, walls of 0.1: c_z = (1/2 − 0.64 (0.9² − h²)/2)/(1 − 0.64 (0.9 − h)).
  double lowest = 1.0;
  for (double h = 0.1; h < 0.9; h += 1e-4) {
    lowest = std::min(lowest, (0.5 - 0.32 * (0.81 - h * h)) / (1 - 0.64 * (0.9 - h)));
  }
  for (const double beyond : {2e-3, -2e-3}) {
    const auto proofs =
        certificates(halfSpace(-Vec3::UnitZ(), -lowest + beyond), solid, {}, surface, 0.1);
    ASSERT_EQ(proofs.size(), beyond > 0.0 ? 1U : 0U);
    if (proofs.empty()) continue;
    EXPECT_GT(proofs.front().margin, 0.0);
    EXPECT_EQ(proofs.front().functionals(3, 0), 1.0);
    EXPECT_EQ(proofs.front().functionals(0, 0), -lowest + beyond);
  }
}

TEST(Certificate, OfManyHalfSpacesIsThatOfEachAloneOrNone) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  const Moments solid = moments(cube.vertices, cube.faces);
  // No body whose walls are 0.1 has its centre of mass farther than 0.2 from the cube's middle.
  Random random(4);
  HalfSpaces set{Points(30, 3), Vector(30)};
  for (Eigen::Index i = 0; i < 30; ++i) {
    const Vec3 u = random.vector().normalized();
    set.normals.row(i) = u.transpose();
    set.limits[i] = u.dot(Vec3(0, 0, 0.5)) + 0.2;
  }
  const auto proofs = certificates(set, solid, {}, surface, 0.1);
  ASSERT_EQ(proofs.size(), 30U);
  for (Eigen::Index i = 0; i < 30; ++i) {
    const Certificate& proof = proofs[static_cast<std::size_t>(i)];
    const auto alone = certificates(halfSpace(set.normals.row(i).transpose(), set.limits[i]), solid,
                                    {}, surface, 0.1);
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(proof.margin, alone.front().margin);
    EXPECT_EQ(proof.functionals, alone.front().functionals);
  }
  set.limits[17] -= 0.2; // through the middle, where that of the solid is
  EXPECT_TRUE(certificates(set, solid, {}, surface, 0.1).empty());
}

/// Stands on its middle column, with a low arm to one side and a high one to the other: what is
/// poured into its cavity fills the low arm first.
struct TwoArms {
  TriangleMesh mesh =
      smoothed(polycube({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {-1, 0, 1}, {1, 0, 2}}, 5), 2);
  PosedModel posed = makePosedModel(makeSolid(mesh), {});
  TriangleTree surface{posed.vertices, posed.faces};
  Moments solid = moments(posed.vertices, posed.faces);
  AdmissibleCells cells = cellsBehind(surface, posed.wall);
  LinearConditions conditions = makeStandGoal(posed.contact, {})->conditions().front();
  Fillings ends{{}, {0.6}};
  Fillings everyLevel = ends;

  TwoArms() {
    for (const double height : layerHeights(regionBehind(surface, posed.wall), kCellsInBox))
      everyLevel.push_back({0.6, height});
  }
};

/// The level that a cavity of the cells reaches in all states, straight from the cells.
double reachedBy(const TwoArms& scene, const std::function<bool(const Vec3&)>& isHollow) {
  double least = std::numeric_limits<double>::infinity();
  for (const Filling& filling : scene.everyLevel) {
    Moments body = scene.solid;
    for (Eigen::Index c = 0; c < scene.cells.rows(); ++c) {
      const Moments cell = scene.cells.row(c).transpose();
      const Vec3 centre = cell.segment<3>(1) / cell[0];
      if (!isHollow(centre)) continue;
      body -= (centre.z() < filling.level ? 1.0 - filling.density : 1.0) * cell;
    }
    least = std::min(least, levelReached(scene.conditions, body));
  }
  return least;
}

TEST(LevelBound, CountsEveryLevelOfTheContents) {
  const TwoArms scene;
  const LevelBound ends = greatestLevel(scene.conditions, scene.solid, scene.ends, scene.cells);
  const LevelBound every =
      greatestLevel(scene.conditions, scene.solid, scene.everyLevel, scene.cells);
  ASSERT_EQ(every.states.size(), scene.everyLevel.size());
  // A tenth of a degree below what empty and full allow, and known to a fiftieth.
  EXPECT_LT(every.level, ends.level - 0.1 / kDegrees);
  EXPECT_GE(every.level, every.reached);
  EXPECT_NEAR(every.level, every.reached, 0.02 / kDegrees);
  // The best body is one: its own cavity, where hollowing is worth it, reaches no less than others.
  const double own = reachedBy(scene, [&](const Vec3& x) { return every.worth.valueAt(x) > 0.0; });
  EXPECT_NEAR(own, every.level, 0.1 / kDegrees);
  EXPECT_LE(own, every.level);
  const double ofEnds =
      reachedBy(scene, [&](const Vec3& x) { return ends.worth.valueAt(x) > 0.0; });
  EXPECT_LT(ofEnds, every.level);
  Random random(9);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 normal = random.vector().normalized();
    const double offset = 0.3 * random();
    const double reached =
        reachedBy(scene, [&](const Vec3& x) { return normal.dot(x - Vec3(0, 0, 0.4)) > offset; });
    EXPECT_LE(reached, every.level);
  }
}

TEST(Certificate, OfEveryLevelExcludesWhatEmptyAndFullAllow) {
  LARGE_TEST();
  const TwoArms scene;
  const LevelBound ends = greatestLevel(scene.conditions, scene.solid, scene.ends, scene.cells);
  const LevelBound every =
      greatestLevel(scene.conditions, scene.solid, scene.everyLevel, scene.cells);
  const double wanted = 0.1 * every.level + 0.9 * ends.reached;
  EXPECT_FALSE(certificate(scene.conditions, wanted, ends, scene.solid, scene.ends, scene.surface,
                           scene.posed.wall));
  const auto proof = certificate(scene.conditions, wanted, every, scene.solid, scene.everyLevel,
                                 scene.surface, scene.posed.wall);
  ASSERT_TRUE(proof);
  EXPECT_TRUE(std::any_of(proof->fillings.begin(), proof->fillings.end(),
                          [](const Filling& filling) { return filling.isPartial(); }));
  EXPECT_LT((proof->rows.transpose() * proof->multipliers - proof->functionals).norm(), 1e-12);
  // Positive for the best body in the states that count.
  double sum = 0.0;
  for (Eigen::Index s = 0; s < proof->functionals.cols(); ++s) {
    const Filling& filling = proof->fillings[static_cast<std::size_t>(s)];
    for (std::size_t i = 0; i < scene.everyLevel.size(); ++i) {
      if (scene.everyLevel[i].density != filling.density) continue;
      if (scene.everyLevel[i].level != filling.level) continue;
      sum += proof->functionals.col(s).head<10>().dot(every.states[i]) + proof->functionals(10, s);
    }
  }
  EXPECT_GE(sum, 0.9 * proof->margin);
}

TEST(Certificate, IsOnlyFoundForMassesBelowTheLeast) {
  LARGE_TEST();
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  const Moments solid = moments(cube.vertices, cube.faces);
  const double least = 1.0 - std::pow(0.8, 3);
  for (const double excess : {-0.005, 0.005}) {
    const auto goal = makeMassGoal(1.0, least + excess, {});
    const LinearConditions conditions = goal->conditions().front();
    const LevelBound bound = greatestLevel(conditions, solid, {{}}, cellsBehind(surface, 0.1));
    EXPECT_EQ(certificate(conditions, 0.0, bound, solid, {{}}, surface, 0.1).has_value(),
              excess < 0.0);
  }
}

} // namespace
} // namespace massprops::testing
