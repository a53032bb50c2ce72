#include "simulation/hanging.h"

namespace simulation {

double hangingAngle(const Body& body, const Vector3d& suspension) {
  Settings settings;
  settings.damping = 0.3;
  World world(body, settings);
  world.place(Eigen::AngleAxisd(0.175, Vector3d::UnitX()).toRotationMatrix(), {0, 0, 0});
  world.pin(suspension);
  for (int i = 0; i < 100 || (world.speed() > 1e-7 && i < 200000); ++i) world.step();
  return tilt(world.rotation());
}

} // namespace simulation
