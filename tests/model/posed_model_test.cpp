// What the working frame refuses of a solid.
#include "core/model/posed_model.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <string>

namespace massprops::testing {
namespace {

PosedModel flattenedBall(double share) {
  Options options;
  options.goal = GoalKind::Mass;
  const TriangleMesh ball = transformed(sphere(6), Mat3(Vec3(share, 1.0, 1.0).asDiagonal()));
  return makePosedModel(makeSolid(ball), options);
}

TEST(MakePosedModel, RefusesASheetThatSnappingLeavesNothingOf) {
  try {
    // It encloses 10⁻¹⁰ of what the ball does, and is thinner than 2⁻³² diagonals.
    flattenedBall(1e-10);
    FAIL() << "accepted";
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("encloses no volume"), std::string::npos) << e.what();
  }
  EXPECT_NO_THROW(flattenedBall(1e-8));
}

} // namespace
} // namespace massprops::testing
