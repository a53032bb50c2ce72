// From the ten moments to what a body does: mass, centre of mass, inertia tensor.
#pragma once

#include "core/physics/moments.h"

namespace massprops {

struct MassProperties {
  double mass = 0.0;
  Vec3 centerOfMass = Vec3::Zero();
  /// About the centre of mass, along the coordinate axes; the products of inertia carry the minus
  /// sign that L = Iω needs: I_xy = −∫ρxy.
  Mat3 inertiaTensor = Mat3::Zero();
};

/// Density-weighted moments of a shell: `density` between outer and inner surface,
/// `fillDensity` inside the inner one. Both surfaces oriented outwards.
Moments shellMoments(const Moments& outer, const Moments& inner, double density,
                     double fillDensity);

/// \pre massMoments[0] > 0
MassProperties massProperties(const Moments& massMoments);

/// Derivatives with respect to the ten mass moments.
struct MassPropertyGradients {
  Eigen::Matrix<double, 3, 10> centerOfMass;
  /// Rows xx, yy, zz, xy, yz, zx of the inertia tensor.
  Eigen::Matrix<double, 6, 10> inertiaTensor;
};

MassPropertyGradients massPropertyGradients(const MassProperties& body);

} // namespace massprops
