// Skins under tension: planes stay planes, membranes and plates bend as they are known to.
#include "core/reduced/fairing.h"

#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

/// A slab's upper side, 2×2, and its vertices off the edges.
struct Side {
  TriangleMesh slab = box({2, 2, 0.5}, 40);
  std::vector<char> isFree;
  Eigen::Index middle = 0;

  Side() {
    for (Eigen::Index v = 0; v < slab.vertices.rows(); ++v) {
      const Vec3 x = slab.vertices.row(v).transpose();
      const bool isOnTop = x.z() > 0.24 && x.head<2>().cwiseAbs().maxCoeff() < 0.99;
      isFree.push_back(isOnTop ? 1 : 0);
      if (isOnTop && x.head<2>().norm() < 1e-9) middle = v;
    }
  }

  double deflection(double length) const {
    const Skin skin(slab.vertices, slab.faces, isFree, length);
    EXPECT_TRUE(skin.isSolvable());
    return skin.deflections(RowMatrix::Ones(slab.vertices.rows(), 1))(middle, 0);
  }
};

TEST(Skin, OfAFlatBorderIsFlat) {
  const Side side;
  const Points rest = Skin(side.slab.vertices, side.slab.faces, side.isFree, 0.0).atRest();
  EXPECT_LT((rest - side.slab.vertices).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Skin, UnderTensionAloneIsAMembrane) {
  // −Δw = 1 in the square [−1, 1]²: w = 1/2 − (16/π³) Σ (−1)^k / ((2k+1)³ cosh((2k+1)π/2)).
  constexpr double kPi = 3.14159265358979323846;
  double expected = 0.5;
  for (int k = 0; k < 20; ++k) {
    const double odd = 2 * k + 1;
    expected += (k % 2 == 0 ? -16.0 : 16.0) /
                (std::pow(kPi, 3) * std::pow(odd, 3) * std::cosh(0.5 * odd * kPi));
  }
  EXPECT_NEAR(Side().deflection(0.0), expected, 1e-3 * expected);
}

TEST(Skin, ThatIsStiffIsAClampedPlate) {
  // 0.00126532 p a⁴ / D in the middle of a square plate with the side a; second order in the grid.
  constexpr double kStiff = 100.0; // so that tension counts for nothing
  const double expected = 0.00126532 * std::pow(2.0, 4) / (kStiff * kStiff);
  EXPECT_NEAR(Side().deflection(kStiff), expected, 0.05 * expected);
}

TEST(Skin, JoinsWhatItHangsOnWithoutACrease) {
  // A capsule's end, cut off where it begins to be round.
  TriangleMesh mesh = capsule(1.0, 4.0, 32);
  std::vector<char> isFree;
  for (const auto& x : mesh.vertices.rowwise()) isFree.push_back(x[2] > 1.9 ? 1 : 0);
  const auto sharp = [&](double length) {
    const Skin skin(mesh.vertices, mesh.faces, isFree, length);
    return shareOfSharpEdges({skin.atRest(), mesh.faces}, 40.0);
  };
  EXPECT_GT(sharp(0.0), 0.0);
  EXPECT_EQ(sharp(1.0), 0.0);
}

} // namespace
} // namespace massprops::testing
