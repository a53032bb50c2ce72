#include "simulation/world.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <limits>

extern btScalar gContactBreakingThreshold; // NOLINT(readability-redundant-declaration)

namespace simulation {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
/// Contacts count below this height: far below what turns a result.
constexpr double kContactReach = 1e-3;

btVector3 toBullet(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Vector3d fromBullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

btMatrix3x3 toBullet(const Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

Matrix3d fromBullet(const btMatrix3x3& m) {
  Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result(i, j) = m[i][j];
  }
  return result;
}

int flagOf(Gyroscopic gyroscopic) {
  switch (gyroscopic) {
  case Gyroscopic::Explicit:
    return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
  case Gyroscopic::ImplicitInWorld:
    return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
  case Gyroscopic::ImplicitInBody:
    return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
  }
  return 0;
}

} // namespace

struct World::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::unique_ptr<btRigidBody> body, ground;
  std::unique_ptr<btPoint2PointConstraint> joint;

  Matrix3d principal; ///< axes of the body in columns, right-handed
  Vector3d moments;
  Vector3d centre;
  Contacts contacts;
  Settings settings;
  long steps = 0;

  /// A point of the body in the frame of its principal axes, which is Bullet's.
  btVector3 local(const Vector3d& point) const {
    return toBullet(Vector3d(principal.transpose() * (point - centre)));
  }

  void addBody() {
    btRigidBody::btRigidBodyConstructionInfo info(1.0, nullptr, contactShape(), toBullet(moments));
    info.m_friction = 10.0;
    info.m_linearDamping = info.m_angularDamping = settings.damping;
    body = std::make_unique<btRigidBody>(info);
    body->setFlags(flagOf(settings.gyroscopic));
    body->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(body.get());
  }

  btCollisionShape* contactShape() {
    if (contacts.points.empty()) return keep(std::make_unique<btEmptyShape>());
    if (contacts.asHull) return keep(hullOf(contacts.points));
    auto compound = std::make_unique<btCompoundShape>();
    for (const Vector3d& point : contacts.points) {
      compound->addChildShape(btTransform::getIdentity(), keep(hullOf({point})));
    }
    return keep(std::move(compound));
  }

  std::unique_ptr<btConvexHullShape> hullOf(const std::vector<Vector3d>& points) const {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vector3d& point : points) hull->addPoint(local(point), false);
    hull->setMargin(0.0);
    hull->recalcLocalAabb();
    return hull;
  }

  btCollisionShape* keep(std::unique_ptr<btCollisionShape> shape) {
    shapes.push_back(std::move(shape));
    return shapes.back().get();
  }

  void addGround() {
    auto* plane = keep(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0.0));
    ground = std::make_unique<btRigidBody>(0.0, nullptr, plane);
    ground->setFriction(10.0);
    world.addRigidBody(ground.get());
  }
};

World::World(const Body& body, const Settings& settings, const Contacts& contacts)
    : bullet_(std::make_unique<Bullet>()) {
  Bullet& b = *bullet_;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(body.inertia);
  b.principal = eigen.eigenvectors();
  if (b.principal.determinant() < 0.0) b.principal.col(0) *= -1.0;
  b.moments = eigen.eigenvalues();
  b.centre = body.centre;
  b.contacts = contacts;
  b.settings = settings;

  gContactBreakingThreshold = kContactReach;
  b.dispatcher.setDispatcherFlags(
      b.dispatcher.getDispatcherFlags() &
      ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
  b.configuration.setPlaneConvexMultipointIterations();
  btContactSolverInfo& info = b.world.getSolverInfo();
  info.m_numIterations = 50;
  info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  // Depth is mended without giving energy.
  info.m_splitImpulsePenetrationThreshold = 0.0;
  b.world.setGravity({0, 0, -settings.gravity});
  b.addBody();
  if (!contacts.points.empty()) b.addGround();
}

World::~World() {
  Bullet& b = *bullet_;
  if (b.joint) b.world.removeConstraint(b.joint.get());
  if (b.ground) b.world.removeRigidBody(b.ground.get());
  b.world.removeRigidBody(b.body.get());
}

void World::place(const Matrix3d& rotation, const Vector3d& origin) {
  Bullet& b = *bullet_;
  const btTransform pose(toBullet(Matrix3d(rotation * b.principal)),
                         toBullet(Vector3d(origin + rotation * b.centre)));
  b.body->setCenterOfMassTransform(pose);
  b.body->setLinearVelocity({0, 0, 0});
  b.body->setAngularVelocity({0, 0, 0});
}

void World::setDown(const Matrix3d& rotation, double height) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : bullet_->contacts.points) {
    lowest = std::min(lowest, rotation.row(2).dot(point));
  }
  place(rotation, {0, 0, height - lowest});
}

void World::pin(const Vector3d& point) {
  Bullet& b = *bullet_;
  b.joint = std::make_unique<btPoint2PointConstraint>(*b.body, b.local(point));
  b.world.addConstraint(b.joint.get());
}

void World::spin(const Vector3d& angularVelocity, const Vector3d& about) {
  Bullet& b = *bullet_;
  const Vector3d arm = at(b.centre) - at(about);
  b.body->setAngularVelocity(toBullet(angularVelocity));
  b.body->setLinearVelocity(toBullet(Vector3d(angularVelocity.cross(arm))));
}

void World::push(const Vector3d& force, const Vector3d& torque) {
  bullet_->body->applyCentralForce(toBullet(force));
  bullet_->body->applyTorque(toBullet(torque));
}

void World::step() {
  bullet_->world.stepSimulation(bullet_->settings.step, 0);
  ++bullet_->steps;
}

double World::time() const {
  return static_cast<double>(bullet_->steps) * bullet_->settings.step;
}

Matrix3d World::rotation() const {
  const Bullet& b = *bullet_;
  return fromBullet(b.body->getCenterOfMassTransform().getBasis()) * b.principal.transpose();
}

Vector3d World::at(const Vector3d& point) const {
  return fromBullet(bullet_->body->getCenterOfMassTransform() * bullet_->local(point));
}

Vector3d World::angularVelocity() const {
  return fromBullet(bullet_->body->getAngularVelocity());
}

Vector3d World::angularMomentum() const {
  const Matrix3d axes = rotation() * bullet_->principal;
  return axes * bullet_->moments.asDiagonal() * axes.transpose() * angularVelocity();
}

double World::energy() const {
  const Bullet& b = *bullet_;
  return 0.5 * b.body->getLinearVelocity().length2() +
         0.5 * angularVelocity().dot(angularMomentum()) +
         b.settings.gravity * b.body->getCenterOfMassPosition().z();
}

double World::speed() const {
  return bullet_->body->getLinearVelocity().length() + angularVelocity().norm();
}

double tilt(const Matrix3d& rotation) {
  // Accurate near 0 as well.
  return std::atan2(rotation.col(2).head<2>().norm(), rotation(2, 2)) * kDegrees;
}

} // namespace simulation
