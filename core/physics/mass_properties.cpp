#include "core/physics/mass_properties.h"

namespace massprops {

Moments shellMoments(const Moments& outer, const Moments& inner, double density,
                     double fillDensity) {
  return density * (outer - inner) + fillDensity * inner;
}

MassProperties massProperties(const Moments& massMoments) {
  MassProperties body;
  body.mass = massMoments[0];
  body.centerOfMass = massMoments.segment<3>(1) / body.mass;
  const Vec3& c = body.centerOfMass;
  const Mat3 central = secondMoment(massMoments) - body.mass * c * c.transpose();
  body.inertiaTensor = central.trace() * Mat3::Identity() - central;
  return body;
}

MassPropertyGradients massPropertyGradients(const MassProperties& body) {
  // c = S/m:            dc_i = (dS_i − c_i dm)/m
  // C = Q − S Sᵀ/m:     dC_ij = dQ_ij − c_i dS_j − c_j dS_i + c_i c_j dm
  const Vec3& c = body.centerOfMass;
  MassPropertyGradients gradients;
  gradients.centerOfMass.setZero();
  for (int i = 0; i < 3; ++i) {
    gradients.centerOfMass(i, 0) = -c[i] / body.mass;
    gradients.centerOfMass(i, 1 + i) = 1.0 / body.mass;
  }
  constexpr int first[6] = {0, 1, 2, 0, 1, 2};
  constexpr int second[6] = {0, 1, 2, 1, 2, 0};
  Eigen::Matrix<double, 6, 10> central = Eigen::Matrix<double, 6, 10>::Zero();
  for (int p = 0; p < 6; ++p) {
    const int i = first[p];
    const int j = second[p];
    central(p, 0) = c[i] * c[j];
    central(p, 1 + j) -= c[i];
    central(p, 1 + i) -= c[j];
    central(p, 4 + p) = 1.0;
  }
  // I = tr(C)·1 − C
  gradients.inertiaTensor = -central;
  for (int p = 0; p < 3; ++p) {
    gradients.inertiaTensor.row(p) += central.row(0) + central.row(1) + central.row(2);
  }
  return gradients;
}

} // namespace massprops
