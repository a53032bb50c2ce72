// Closed triangle meshes with known geometry, in any resolution, for the tests and benchmarks.
// All are oriented outwards; unless said otherwise they are centred at the origin.
#pragma once

#include "core/base/types.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace massprops::testing {

/// Edges of lengths `size` along the axes; every side is an n×n grid of squares, cut in two.
TriangleMesh box(const Vec3& size, int n = 1);

/// A box whose edges and corners are rounded with `radius` ≤ min(size)/2. Every side has
/// `flatSegments` squares between the rounded parts and `arcSegments` on each half arc.
TriangleMesh roundedBox(const Vec3& size, double radius, int flatSegments, int arcSegments);

/// The corners in this order must have a positive determinant (b−a, c−a, d−a).
TriangleMesh tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Unit sphere: an icosahedron whose edges are cut in `frequency` parts; 10·frequency² + 2
/// vertices, all at distance 1.
TriangleMesh sphere(int frequency);

/// The sphere stretched by `radii`.
TriangleMesh ellipsoid(const Vec3& radii, int frequency);

/// Points radius(u)·u for the vertices u of the unit sphere; radius must be positive.
TriangleMesh starShaped(const std::function<double(const Vec3&)>& radius, int frequency);

/// A smooth lump without any symmetry, radii between 0.6 and 1.4.
TriangleMesh blob(int frequency);

/// An ellipsoid with half axes 1, 0.8, 0.6 that leans by `tilt` radians and has a rounded spike
/// downwards, like a badly balanced spinning top. The spike's tip is the lowest point.
TriangleMesh leaningTop(double tilt, int frequency);

/// Around the z axis; `tube` is the radius of the tube, `ring` that of its centre line.
TriangleMesh torus(double ring, double tube, int ringSegments, int tubeSegments);

/// The polygon (radius, height), listed downwards from the axis to the axis, turned about z. Only
/// the first and the last radius are 0.
TriangleMesh revolved(const std::vector<Vec2>& profile, int segments);

/// A cylinder with half-spherical ends along z: `radius`, and `length` between the two centres.
TriangleMesh capsule(double radius, double length, int segments);

/// The boundary of a union of unit cubes whose lowest corners are `cells`; every cube side is an
/// n×n grid. No two cubes may touch along an edge or at a corner only. Not centred.
TriangleMesh polycube(const std::vector<std::array<int, 3>>& cells, int n);

/// The counter-clockwise polygon as bottom at z = 0 and top at z = `height`, with as few triangles
/// as CAD programs take: long ones. Not centred.
TriangleMesh prism(const std::vector<Vec2>& outline, double height);

/// A bracket of two plates of thickness 1 at a right angle, 10 long, 6 high and 5 deep, whose inner
/// corner is a quarter of a circle of radius 2 in `arc` pieces; a prism that lies on its longer
/// plate. Not centred.
TriangleMesh bracket(int arc);

/// A figure with a body, a head that leans forwards, two arms and two legs on flat feet at z = 0.
/// Smooth except for the rims of the feet; every limb is `n` squares wide.
TriangleMesh figure(int n);

/// `iterations` rounds in which every vertex moves half way to the mean of its neighbours.
TriangleMesh smoothed(const TriangleMesh& mesh, int iterations);

/// Every coordinate moved by at most `amplitude`, always in the same way for the same seed.
TriangleMesh jittered(const TriangleMesh& mesh, double amplitude, std::uint32_t seed);

/// x ↦ x + by.
TriangleMesh shifted(const TriangleMesh& mesh, const Vec3& by);

/// Every triangle with corners of its own.
TriangleMesh unwelded(const TriangleMesh& mesh);

/// x ↦ linear·x + translation. `linear` must keep the orientation.
TriangleMesh transformed(const TriangleMesh& mesh, const Mat3& linear,
                         const Vec3& translation = Vec3::Zero());
TriangleMesh scaled(const TriangleMesh& mesh, double factor);
Mat3 rotation(const Vec3& axis, double radians);
/// A rotation about no special axis by no special angle.
Mat3 someRotation();
/// (x, y, z) ↦ (x + slope·z, y, z)
Mat3 shear(double slope);

/// The same surface seen from the other side.
TriangleMesh reversed(const TriangleMesh& mesh);
/// Every triangle cut in four at the middles of its edges.
TriangleMesh subdivided(const TriangleMesh& mesh);
/// Triangles on the side x < 0 of the mesh's middle cut in three at their centroids, `times` over:
/// needles there, and large triangles on the other side.
TriangleMesh unevenlyCut(const TriangleMesh& mesh, int times);
/// Both meshes side by side in one, nothing merged.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// Uniform in [−1, 1], the same sequence on every machine.
class Random {
public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  double operator()();
  Vec3 vector();
  Vector vector(Eigen::Index size);

private:
  std::uint64_t state_;
};

} // namespace massprops::testing
