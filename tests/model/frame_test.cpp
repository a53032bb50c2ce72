// The working frame is a rotation, a shift and a scale, and can be undone.
#include "core/model/frame.h"

#include "shapes.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr std::array<UpAxis, 6> kAxes = {UpAxis::PlusZ,  UpAxis::PlusY,  UpAxis::PlusX,
                                         UpAxis::MinusZ, UpAxis::MinusY, UpAxis::MinusX};
const std::array<Vec3, 6> kDirections = {Vec3(0, 0, 1),  Vec3(0, 1, 0),  Vec3(1, 0, 0),
                                         Vec3(0, 0, -1), Vec3(0, -1, 0), Vec3(-1, 0, 0)};

TEST(RotationToUp, TakesTheUpAxisToZAndIsARotation) {
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    const Mat3 R = rotationToUp(kAxes[i]);
    EXPECT_EQ(R * kDirections[i], Vec3::UnitZ());
    EXPECT_EQ(R * R.transpose(), Mat3::Identity());
    EXPECT_EQ(R.determinant(), 1.0);
  }
}

TEST(RotationToUp, PermutesTheAxesCyclicallyForPositiveAxes) {
  // x, y for +Z; z, x for +Y; y, z for +X become the horizontal axes in this order.
  EXPECT_EQ(rotationToUp(UpAxis::PlusZ) * Vec3::UnitX(), Vec3::UnitX());
  EXPECT_EQ(rotationToUp(UpAxis::PlusY) * Vec3::UnitZ(), Vec3::UnitX());
  EXPECT_EQ(rotationToUp(UpAxis::PlusX) * Vec3::UnitY(), Vec3::UnitX());
}

TEST(Frame, IsUndone) {
  const TriangleMesh mesh = transformed(blob(4), 50 * someRotation(), {300, -200, 100});
  for (const UpAxis up : kAxes) {
    const Frame frame{rotationToUp(up), {290, -210, 90}, 123.0};
    const Points back = toModel(frame, toWorking(frame, mesh.vertices));
    EXPECT_LT((back - mesh.vertices).cwiseAbs().maxCoeff(), 1e-12); // coordinates up to 350
  }
}

TEST(Frame, KeepsAnglesAndScalesLengths) {
  const TriangleMesh mesh = blob(3);
  const Frame frame{rotationToUp(UpAxis::MinusX), {1, 2, 3}, 4.0};
  const Points working = toWorking(frame, mesh.vertices);
  const Matrix before = (mesh.vertices.rowwise() - mesh.vertices.row(0)) *
                        (mesh.vertices.rowwise() - mesh.vertices.row(0)).transpose();
  const Matrix after =
      (working.rowwise() - working.row(0)) * (working.rowwise() - working.row(0)).transpose();
  EXPECT_LT((before - 16 * after).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Snapped, MovesByLessThanHalfAGridStepAndTwiceIsOnce) {
  const Points points = blob(6).vertices;
  const Points once = snapped(points);
  EXPECT_LE((once - points).cwiseAbs().maxCoeff(), std::ldexp(1.0, -33));
  EXPECT_EQ((snapped(once) - once).cwiseAbs().maxCoeff(), 0.0);
}

TEST(RoundOff, IsMoreThanWhatDistancesLoseOnTheirWayAndNotMuch) {
  Random random(1);
  for (const double far : {0.0, 3.0, 1e3, 1e6, 1e9}) {
    for (int trial = 0; trial < 1000; ++trial) {
      const Frame frame{rotationToUp(kAxes[static_cast<std::size_t>(trial) % 6]),
                        far * 77.0 * random.vector(), 77.0};
      const Points outer = toModel(frame, 0.5 * random.vector().transpose());
      const Points inner = toModel(frame, 0.5 * random.vector().transpose());
      const Points inspected = toWorking(frame, inner);
      const Points delivered = toModel(frame, inspected);
      const double measured = (inspected - snapped(toWorking(frame, outer))).norm();
      const double stored = (delivered - outer).norm() / frame.length;
      EXPECT_LE(std::abs(measured - stored), roundOff(frame)) << far;
    }
  }
  EXPECT_LT(roundOff(Frame{Mat3::Identity(), {1e4, 0, 0}, 1.0}), 1e-9);
}

} // namespace
} // namespace massprops::testing
