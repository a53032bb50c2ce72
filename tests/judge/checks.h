// Second opinions: slow and simple ways to measure a mesh that share no code with core/.
#pragma once

#include "core/base/types.h"

#include <cstddef>

namespace massprops::testing {

/// Every directed edge once and together with its reverse; every vertex used.
bool isClosedAndOriented(const TriangleMesh& mesh);

/// Vertices − edges + faces: 2 for a sphere, 0 for a torus, added over components.
long eulerCharacteristic(const TriangleMesh& mesh);

/// Share of the edges at which the surface turns by more than so many degrees, 0…1: a crumpled
/// surface has many. \pre closed and oriented
double shareOfSharpEdges(const TriangleMesh& mesh, double degrees);

/// Number of triangles whose corners lie on a line. Exact.
std::size_t facesWithoutArea(const TriangleMesh& mesh);

/// Number of pairs of triangles that meet elsewhere than in the corners and edges they share. Pair
/// by pair with exact predicates.
std::size_t intersectingPairs(const TriangleMesh& mesh);

/// Number of pairs of a triangle of `a` and a triangle of `b` that meet. Exact.
std::size_t intersectingPairs(const TriangleMesh& a, const TriangleMesh& b);

/// How often the surface winds around the point: 1 inside, 0 outside, the sum of the signed solid
/// angles of all triangles over 4π.
double windingNumber(const TriangleMesh& mesh, const Vec3& point);

/// Whether all vertices of `inner` are inside of `outer`.
bool isInside(const TriangleMesh& inner, const TriangleMesh& outer);

/// Least distance between two triangles, over all pairs. Both meshes need faces.
double leastDistance(const TriangleMesh& a, const TriangleMesh& b);

/// Volume integrals of 1, x, y, z, xx, yy, zz, xy, yz, zx by the divergence theorem and Gauss
/// quadrature on the triangles, exact for these polynomials.
Eigen::Matrix<double, 10, 1> quadratureMoments(const TriangleMesh& mesh);

/// Volume integrals of 1, x, y, z over what lies below the plane `up`·x = `level`: columns from the
/// clipped triangles up to the plane. `up`: unit.
Eigen::Vector4d momentsOfColumns(const TriangleMesh& mesh, const Vec3& up, double level);

/// Mass, centre of mass and central inertia tensor from given moments of mass.
struct Body {
  double mass;
  Vec3 centre;
  Mat3 inertia;
};
Body bodyOf(const Eigen::Matrix<double, 10, 1>& massMoments);

} // namespace massprops::testing
