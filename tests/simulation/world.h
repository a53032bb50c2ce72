// One rigid body in a world of Bullet.
#pragma once

#include "simulation/body.h"

#include <memory>
#include <vector>

namespace simulation {

/// How the gyroscopic torque −ω × Iω enters a step: three ways of Bullet's own.
enum class Gyroscopic { Explicit, ImplicitInWorld, ImplicitInBody };

struct Settings {
  double step = 1e-3;
  double gravity = 1.0;
  /// Share of the velocities that a unit of time takes away. For settling only.
  double damping = 0.0;
  Gyroscopic gyroscopic = Gyroscopic::ImplicitInBody;
};

/// What meets the ground z = 0, without slip and without a rebound.
struct Contacts {
  /// Points of the body that may touch it.
  std::vector<Vector3d> points;
  /// Whether their convex hull touches it as one shape, for many points, instead of each of them.
  bool asHull = false;
};

/// Body coordinates are those of `Body`; world coordinates have the same unit, up = +z.
class World {
public:
  World(const Body& body, const Settings& settings, const Contacts& contacts = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// At rest, turned by `rotation` about the body's origin and moved there.
  void place(const Matrix3d& rotation, const Vector3d& origin);
  /// At rest, turned by `rotation`, the lowest of the contacts at that height.
  void setDown(const Matrix3d& rotation, double height = 0.0);
  /// Keeps that point of the body where it is now.
  void pin(const Vector3d& point);
  /// Sets angular velocity (world axes) and the velocity that leaves that point of the body at
  /// rest.
  void spin(const Vector3d& angularVelocity, const Vector3d& about);
  /// For the next step only; at the centre of mass.
  void push(const Vector3d& force, const Vector3d& torque);
  void step();
  /// Since the beginning.
  double time() const;

  Matrix3d rotation() const;
  /// Where a point of the body is.
  Vector3d at(const Vector3d& point) const;
  Vector3d angularVelocity() const;
  /// Kinetic energy with that of height.
  double energy() const;
  /// About the centre of mass, world axes.
  Vector3d angularMomentum() const;
  /// Greatest speed of a point within a unit of length from the centre.
  double speed() const;

private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

/// Between the body's +z and up, degrees.
double tilt(const Matrix3d& rotation);

} // namespace simulation
