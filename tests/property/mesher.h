// A closed triangle mesh of the inside of an implicit function.
#pragma once

#include "core/base/types.h"

#include <functional>

namespace massprops::testing {

/// Negative inside, positive outside, about the distance near the surface.
using Implicit = std::function<double(const Vec3&)>;

/// The least of two functions, rounded where they differ by less than `blend`.
double smoothMinimum(double a, double b, double blend);
/// Distance to the segment from `a` to `b`, less a radius that goes from `ra` to `rb`.
double capsuleDistance(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb);
/// Distance to a torus around `axis` (unit) at `centre`.
double torusDistance(const Vec3& p, const Vec3& centre, const Vec3& axis, double ring, double tube);
/// Distance to a box with rounded edges and corners, centred at the origin.
double roundedBoxDistance(const Vec3& p, const Vec3& half, double radius);

/// Marching tetrahedra over a lattice of cubes with edge `step` in the box from `lower` to `upper`,
/// outside of which nothing may lie, then `relaxations` rounds in which every vertex moves towards
/// the middle of its neighbours and back onto the surface. Without any the triangles are as thin
/// as chance has it. `solid` must be nowhere exactly 0 on the lattice; it need not be smooth.
TriangleMesh implicitMesh(const Implicit& solid, const Vec3& lower, const Vec3& upper, double step,
                          int relaxations);

} // namespace massprops::testing
