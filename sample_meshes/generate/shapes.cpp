#include "shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace samples {
namespace {

/// A chain of round cones through balls given by centre and radius.
Implicit limb(const std::vector<std::pair<Vec3, double>>& chain) {
  Implicit solid = roundCone(chain[0].first, chain[0].second, chain[1].first, chain[1].second);
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    const auto& [a, radiusA] = chain[i];
    const auto& [b, radiusB] = chain[i + 1];
    solid = smoothUnion(solid, roundCone(a, radiusA, b, radiusB), 6);
  }
  return solid;
}

/// The part of the solid above the ground, all of it between two corners of a box.
Sample sampleOf(const char* name, const Implicit& solid, const Vec3& lower, const Vec3& upper,
                int vertexCount) {
  Sample sample{name, {}};
  sample.problem.solid = solid;
  sample.problem.lower = lower;
  sample.problem.upper = upper;
  sample.problem.vertexCount = vertexCount;
  return sample;
}

/// A box that stands on a cut-off corner, a little off its balance.
Sample boxOnCorner() {
  const Vec3 size(60, 50, 40);
  // The corner (−,−,−) points down, from there the space diagonal goes up; then it leans.
  const Vec3 down = -size.normalized();
  const Eigen::Matrix3d upright =
      Eigen::Quaterniond::FromTwoVectors(down, -Vec3::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d turn = rotation(Vec3(-0.64, 0.77, 0), 0.12) * upright;
  const double cut = 10;
  const Vec3 corner = turn * (-size / 2);
  const Vec3 center(-corner.x(), -corner.y(), -corner.z() - cut);
  return sampleOf("box_on_corner", moved(roundedBox(size, 3), turn, center), Vec3(-60, -60, 0),
                  Vec3(60, 60, 90), 6129);
}

/// A spinning top: an ellipsoid with three different radii, tilted and off the axis of its stick.
Sample tiltedEllipsoidTop() {
  const Implicit body = moved(ellipsoid(Vec3::Zero(), Vec3(27, 24, 15)),
                              rotation(Vec3(0.3, 1, 0), 0.07), Vec3(1.2, -0.6, 25));
  const Implicit stick = roundCone(Vec3(0, 0, 1.6), 2.6, Vec3(0, 0, 14), 5);
  const Implicit handle = roundCone(Vec3(0, 0, 20), 4.2, Vec3(0, 0, 58), 3.4);
  Sample sample =
      sampleOf("tilted_ellipsoid_top", smoothUnion(smoothUnion(body, stick, 9), handle, 9),
               Vec3(-34, -34, 0), Vec3(34, 34, 66), 750);
  sample.problem.relativeEdgeLength = [](const Vec3& p) {
    const double radius = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const double far = std::clamp(radius / 14, 0.0, 1.0);
    const double foot = std::clamp(p.z() / 12, 0.0, 1.0);
    return (0.55 + 0.45 * far) * (0.6 + 0.4 * foot);
  };
  return sample;
}

/// A toy dinosaur on two feet whose big head pulls it over.
Sample toyDinosaur() {
  Implicit trunk = roundCone(Vec3(-9, 0, 38), 17, Vec3(12, 0, 53), 15);
  trunk = smoothUnion(trunk, ellipsoid(Vec3(5, 0, 42), Vec3(18, 17, 17)), 6);
  trunk = smoothUnion(
      trunk, limb({{{-14, 0, 36}, 14}, {{-33, 0, 26}, 9}, {{-50, 0, 23}, 6}, {{-63, 0, 29}, 3.6}}),
      10);
  trunk = smoothUnion(trunk, roundCone(Vec3(13, 0, 56), 12, Vec3(22, 0, 76), 11), 8);

  // An open mouth between the snout and the lower jaw.
  Implicit head = ellipsoid(Vec3(26, 0, 85), Vec3(17, 15, 14));
  head = smoothUnion(head, roundCone(Vec3(35, 0, 84), 11.5, Vec3(56, 0, 82), 9), 6);
  head = smoothUnion(head, roundCone(Vec3(28, 0, 73), 9, Vec3(49, 0, 63), 5.5), 4);
  trunk = smoothUnion(trunk, head, 6);

  // The parts that come in pairs, on the side y > 0.
  Implicit leg = limb({{{-10, 12, 34}, 12}, {{-9, 14, 20}, 9}, {{-15, 14, 8}, 7}});
  Implicit foot = roundCone(Vec3(-16, 14, 4.2), 6.5, Vec3(-6, 15, 3.6), 6);
  for (const double side : {-4.8, 0.0, 4.8})
    foot = smoothUnion(foot, ball(Vec3(-0.5 - std::abs(side) / 4, 15 + side, 2.2), 3.9), 5);
  leg = smoothUnion(leg, foot, 5);
  Implicit arm = limb({{{17, 11, 53}, 6}, {{24, 18, 46}, 4.8}, {{32, 16, 47}, 4.4}});
  for (const double side : {-2.6, 2.6})
    arm = smoothUnion(
        arm, roundCone(Vec3(33, 15.5, 47 + side / 2), 3, Vec3(38, 15, 46.5 + side), 2.3), 3);
  const Implicit eye = ball(Vec3(34, 10.5, 93), 5);

  Implicit solid = smoothUnion(trunk, mirroredY(leg, 4), 6);
  solid = smoothUnion(solid, mirroredY(arm, 4), 4);
  solid = smoothUnion(solid, mirroredY(eye, 4), 3);

  return sampleOf("toy_dinosaur", solid, Vec3(-72, -30, 0), Vec3(70, 30, 106), 11000);
}

/// A long ring on a flat foot, leaning in its own plane.
Sample leaningRing() {
  const Eigen::Matrix3d turn = rotation(Vec3(0, 1, 0), 0.2);
  const Implicit ring = moved(chainLink(18, 9, 20), turn, turn * Vec3(0, 0, 42));
  const Implicit foot = ellipsoid(Vec3(0, 0, 3), Vec3(12, 13, 9));
  return sampleOf("leaning_ring", smoothUnion(ring, foot, 8), Vec3(-30, -20, 0), Vec3(64, 20, 88),
                  6000);
}

/// An egg that leans so far over its small foot that no cavity helps.
Sample leaningEgg() {
  const Eigen::Matrix3d turn = rotation(Vec3(0, 1, 0), 0.3);
  const Vec3 tip(9, 0, 18);
  const Implicit egg = roundCone(tip, 16, tip + turn * Vec3(0, 0, 18), 22);
  const Implicit foot = roundCone(Vec3(0, 0, 4.5), 6.5, Vec3(6, 0, 14), 7);
  return sampleOf("leaning_egg", smoothUnion(egg, foot, 8), Vec3(-30, -30, 0), Vec3(60, 30, 74),
                  3000);
}

/// A dog whose big head hangs out over its four feet.
Sample toyDog() {
  Implicit trunk = roundCone(Vec3(-22, 0, 37), 12, Vec3(18, 0, 40), 14);
  trunk = smoothUnion(trunk, roundCone(Vec3(22, 0, 42), 11, Vec3(42, 0, 60), 10), 8);
  Implicit head = ellipsoid(Vec3(52, 0, 68), Vec3(24, 20, 20));
  head = smoothUnion(head, roundCone(Vec3(64, 0, 64), 13, Vec3(80, 0, 60), 9), 6);
  trunk = smoothUnion(trunk, head, 6);
  trunk = smoothUnion(trunk, limb({{{-28, 0, 42}, 6}, {{-42, 0, 54}, 4.5}, {{-46, 0, 66}, 4}}), 5);
  // The parts that come in pairs, on the side y > 0.
  Implicit legs = limb({{{-22, 9, 32}, 9}, {{-24, 10, 16}, 7}, {{-22, 10, 5}, 7}});
  legs = smoothUnion(legs, limb({{{16, 9, 34}, 9}, {{14, 10, 16}, 7}, {{16, 10, 5}, 7}}), 4);
  const Implicit ear = roundCone(Vec3(46, 16, 83), 7, Vec3(42, 23, 66), 6);
  return sampleOf("toy_dog",
                  smoothUnion(smoothUnion(trunk, mirroredY(legs, 4), 6), mirroredY(ear, 4), 4),
                  Vec3(-56, -34, 0), Vec3(96, 34, 98), 5000);
}

/// A yo-yo of two unequal halves, one with a boss out of the middle.
Sample unevenYoYo() {
  Implicit solid = smoothUnion(ellipsoid(Vec3(0, 0, 11), Vec3(28, 28, 12)),
                               ellipsoid(Vec3(0.4, -0.3, 29), Vec3(27, 28, 12)), 2);
  solid = smoothUnion(solid, roundCone(Vec3(0, 0, 12), 9, Vec3(0, 0, 28), 9), 3);
  solid = smoothUnion(solid, ellipsoid(Vec3(10, 5, 38), Vec3(8, 7, 6)), 5);
  return sampleOf("uneven_yo_yo", solid, Vec3(-34, -34, 0), Vec3(34, 34, 50), 3000);
}

/// A jar on a foot, leaning; its inside takes a liquid.
Sample leaningJar() {
  const Implicit belly = roundCone(Vec3(5, 0, 18), 15, Vec3(15, 0, 40), 19);
  const Implicit neck = roundCone(Vec3(21, 0, 54), 11, Vec3(27, 0, 68), 9);
  const Implicit foot = roundCone(Vec3(0, 0, 3), 12, Vec3(2, 0, 12), 11);
  return sampleOf("leaning_jar", smoothUnion(smoothUnion(belly, neck, 8), foot, 6),
                  Vec3(-24, -24, 0), Vec3(46, 24, 84), 3000);
}

/// A tumbler: a round belly under a big head, so that the solid lies down on its side.
Sample rolyPoly() {
  Implicit solid = smoothUnion(ball(Vec3(0, 0, 25.5), 26), ball(Vec3(1.5, 0, 60), 18), 8);
  solid = smoothUnion(solid, roundCone(Vec3(1.5, 0, 76), 7, Vec3(3, 0, 84), 4), 6);
  const Implicit arm = roundCone(Vec3(6, 22, 32), 6, Vec3(14, 22, 26), 5);
  return sampleOf("roly_poly", smoothUnion(solid, mirroredY(arm, 4), 5), Vec3(-32, -34, 0),
                  Vec3(32, 34, 94), 4000);
}

/// A bath duck; made of one piece of plastic it sinks.
Sample bathDuck() {
  Implicit solid = ellipsoid(Vec3(-2, 0, 20), Vec3(36, 25, 20.5));
  solid = smoothUnion(solid, roundCone(Vec3(-28, 0, 26), 9, Vec3(-42, 0, 38), 4), 8);
  Implicit head = ball(Vec3(17, 0, 50), 17);
  head = smoothUnion(head, ellipsoid(Vec3(34, 0, 48), Vec3(9, 8, 4)), 3);
  return sampleOf("bath_duck", smoothUnion(solid, head, 8), Vec3(-52, -30, 0), Vec3(50, 30, 74),
                  4000);
}

/// An ornament on a knob that is not above its middle.
Sample hangingFish() {
  Implicit solid = ellipsoid(Vec3(6, 0, 19.6), Vec3(36, 13, 20));
  solid = smoothUnion(solid, roundCone(Vec3(-26, 0, 20), 7, Vec3(-42, 0, 32), 5.5), 8);
  solid = smoothUnion(solid, roundCone(Vec3(-26, 0, 20), 7, Vec3(-42, 0, 9), 5.5), 8);
  solid = smoothUnion(solid, roundCone(Vec3(-7, 0, 37), 5, Vec3(-7, 0, 47), 4), 4);
  return sampleOf("hanging_fish", solid, Vec3(-56, -20, 0), Vec3(50, 20, 56), 3000);
}

/// A skittle that stands neither solid nor hollow, but with a surface moved out a little.
Sample leaningSkittle() {
  const Eigen::Matrix3d turn = rotation(Vec3(0, 1, 0), 0.265);
  const Implicit belly = roundCone(Vec3(3, 0, 9), 12, turn * Vec3(6, 0, 34), 17);
  const Implicit head = roundCone(turn * Vec3(6, 0, 50), 9, turn * Vec3(7, 0, 66), 12);
  return sampleOf("leaning_skittle", smoothUnion(belly, head, 10), Vec3(-24, -24, 0),
                  Vec3(56, 24, 88), 3000);
}

/// A piece of a board game that shall feel as heavy as the others.
Sample gamePiece() {
  Implicit solid = ellipsoid(Vec3(0, 0, 5), Vec3(17, 17, 6.5));
  solid = smoothUnion(solid, roundCone(Vec3(0, 0, 10), 11, Vec3(0, 0, 34), 6), 5);
  solid = smoothUnion(solid, ball(Vec3(0, 0, 43), 11), 4);
  return sampleOf("game_piece", solid, Vec3(-24, -24, 0), Vec3(24, 24, 60), 1500);
}

} // namespace

std::vector<Sample> allSamples() {
  return {boxOnCorner(), tiltedEllipsoidTop(), toyDinosaur(), leaningRing(), leaningEgg(),
          toyDog(),      unevenYoYo(),         leaningJar(),  rolyPoly(),    bathDuck(),
          hangingFish(), leaningSkittle(),     gamePiece()};
}

} // namespace samples
