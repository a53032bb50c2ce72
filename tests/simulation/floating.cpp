#include "simulation/floating.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace simulation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.02;
constexpr double kDuration = 200.0;
constexpr double kDamping = 0.5;

using Tetrahedron = std::array<Vector3d, 4>;

double sixfoldVolume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).dot((c - a).cross(d - a));
}

/// Sums of tetrahedra whose volumes count with the sign `sign`, however their corners turn.
class Sum {
public:
  Sum(Submerged& total, double sign) : total_(total), sign_(sign) {}

  void add(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const double volume = sign_ * std::abs(sixfoldVolume(a, b, c, d)) / 6.0;
    total_.volume += volume;
    total_.first += volume / 4.0 * (a + b + c + d);
  }

private:
  Submerged& total_;
  double sign_;
};

Vector3d cut(const Vector3d& below, const Vector3d& above) {
  return below + below.z() / (below.z() - above.z()) * (above - below);
}

/// Of the corners, in ascending order of height, the first `wet` ones are below z = 0.
void addPart(const Tetrahedron& t, int wet, Sum sum) {
  if (wet == 4) sum.add(t[0], t[1], t[2], t[3]);
  if (wet == 1) sum.add(t[0], cut(t[0], t[1]), cut(t[0], t[2]), cut(t[0], t[3]));
  if (wet == 2) {
    // A wedge between the triangles at the two corners.
    const std::array<Vector3d, 3> p{t[0], cut(t[0], t[2]), cut(t[0], t[3])};
    const std::array<Vector3d, 3> q{t[1], cut(t[1], t[2]), cut(t[1], t[3])};
    sum.add(p[0], p[1], p[2], q[0]);
    sum.add(p[1], p[2], q[0], q[1]);
    sum.add(p[2], q[0], q[1], q[2]);
  }
  if (wet == 3) {
    // A wedge between the lower face and the cut.
    const std::array<Vector3d, 3> q{cut(t[0], t[3]), cut(t[1], t[3]), cut(t[2], t[3])};
    sum.add(t[0], t[1], t[2], q[0]);
    sum.add(t[1], t[2], q[0], q[1]);
    sum.add(t[2], q[0], q[1], q[2]);
  }
}

/// The surface where the world has it.
Mesh placed(const Mesh& mesh, const Matrix3d& rotation, const Vector3d& origin) {
  Mesh result;
  result.vertices = (mesh.vertices * rotation.transpose()).rowwise() + origin.transpose();
  result.faces = mesh.faces;
  return result;
}

/// How deep the body's origin has to be for the body to displace this volume.
double depthFor(const Body& body, const Matrix3d& rotation, double displaced) {
  double low = -2.0;
  double high = 2.0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    const Vector3d origin(0, 0, -middle);
    const Mesh mesh = placed(body.surface, rotation, origin - rotation * body.centre);
    (submerged(mesh, origin).volume < displaced ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace

Submerged submerged(const Mesh& mesh, const Vector3d& apex) {
  Submerged total;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const double heights[] = {mesh.vertices(mesh.faces(f, 0), 2),
                              mesh.vertices(mesh.faces(f, 1), 2),
                              mesh.vertices(mesh.faces(f, 2), 2), apex.z()};
    if (*std::min_element(std::begin(heights), std::end(heights)) >= 0.0) continue;
    Tetrahedron t{mesh.vertices.row(mesh.faces(f, 0)), mesh.vertices.row(mesh.faces(f, 1)),
                  mesh.vertices.row(mesh.faces(f, 2)), apex};
    const double sign = sixfoldVolume(apex, t[0], t[1], t[2]) < 0.0 ? -1.0 : 1.0;
    std::sort(t.begin(), t.end(),
              [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
    const auto wet =
        std::count_if(t.begin(), t.end(), [](const Vector3d& p) { return p.z() < 0.0; });
    addPart(t, static_cast<int>(wet), Sum(total, sign));
  }
  return total;
}

Floated floated(const Body& body, double displaced, double heel, double azimuth) {
  Settings settings;
  settings.step = kStep;
  settings.damping = kDamping;
  World world(body, settings);
  const Vector3d axis(std::cos(azimuth), std::sin(azimuth), 0.0);
  const Matrix3d heeled = Eigen::AngleAxisd(heel * kPi / 180.0, axis).toRotationMatrix();
  const double depth = depthFor(body, heeled, displaced);
  world.place(heeled, Vector3d(0, 0, -depth) - heeled * body.centre);
  double still = 0.0;
  while (world.time() < kDuration && still < 2.0) {
    const Vector3d centre = world.at(body.centre);
    if (centre.z() < -3.0) return {tilt(world.rotation()), std::numeric_limits<double>::infinity()};
    const Mesh mesh = placed(body.surface, world.rotation(), world.at(Vector3d::Zero()));
    const Submerged wet = submerged(mesh, centre);
    // The weight is 1, so that a unit of volume lifts with 1/displaced.
    const Vector3d torque = (wet.first - wet.volume * centre).cross(Vector3d::UnitZ()) / displaced;
    world.push(Vector3d(0, 0, wet.volume / displaced), torque);
    world.step();
    still = world.speed() < 1e-5 ? still + kStep : 0.0;
  }
  const Mesh mesh = placed(body.surface, world.rotation(), world.at(Vector3d::Zero()));
  return {tilt(world.rotation()), -mesh.vertices.col(2).minCoeff()};
}

} // namespace simulation
