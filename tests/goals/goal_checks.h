// What the tests of all goals share: bodies, areas, and the check of derivatives.
#pragma once

#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"
#include "shapes.h"
#include "translated_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

namespace massprops::testing {

inline Moments momentsOf(const TriangleMesh& mesh) {
  return moments(mesh.vertices, mesh.faces);
}

inline ContactArea square(double side) {
  const double h = side / 2;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, {}};
}

inline ContactArea ellipse(double rx, double ry) {
  return {{}, Vec2(rx, ry)};
}

/// A body of mass `m` with its centre at `c` and the inertia of a ball.
inline Moments bodyAt(const Vec3& c, double m = 1.0) {
  const TriangleMesh ball = sphere(4);
  const Moments unit = momentsOf(ball) / momentsOf(ball)[0];
  return m * translated(unit, c);
}

/// A box of the given size that stands on the pivot, its centre above it.
inline Moments standingBox(const Vec3& size) {
  return momentsOf(transformed(box(size, 1), Mat3::Identity(), {0, 0, size.z() / 2 + 0.1}));
}

inline double number(const Report& report, const std::string& key) {
  return std::get<double>(report.at(key));
}

inline bool truth(const Report& report, const std::string& key) {
  return std::get<bool>(report.at(key));
}

inline Report described(const Verdict& verdict, const Moments& m) {
  Report report;
  verdict.describe(m, "after", report);
  return report;
}

/// All values of the goal in one vector: objective, equalities, inequalities.
inline Vector allValues(const Goal& goal, const Moments& m) {
  const Vector e = goal.equalities(m).values;
  const Vector g = goal.inequalities(m).values;
  Vector all(1 + e.size() + g.size());
  all << goal.objective(m).value, e, g;
  return all;
}

inline Matrix allGradients(const Goal& goal, const Moments& m) {
  const MomentGradients e = goal.equalities(m).gradients;
  const MomentGradients g = goal.inequalities(m).gradients;
  Matrix all(1 + e.rows() + g.rows(), 10);
  all.row(0) = goal.objective(m).gradient;
  if (e.rows() > 0) all.middleRows(1, e.rows()) = e;
  if (g.rows() > 0) all.bottomRows(g.rows()) = g;
  return all;
}

/// Smooth functions of order one: truncation h² = 1e-10, rounding 1e-16/h = 1e-11; both times the
/// third derivatives and values, some tens for the quotient of moments.
inline void expectGradientsMatch(const Goal& goal, const Moments& m, double h = 1e-5) {
  const Matrix gradients = allGradients(goal, m);
  for (int k = 0; k < 10; ++k) {
    Moments step = Moments::Zero();
    step[k] = h;
    const Vector difference = (allValues(goal, m + step) - allValues(goal, m - step)) / (2 * h);
    for (Eigen::Index r = 0; r < difference.size(); ++r) {
      EXPECT_NEAR(gradients(r, k), difference[r], 1e-6 * (1 + std::abs(difference[r])))
          << "value " << r << ", moment " << k;
    }
  }
}

} // namespace massprops::testing
