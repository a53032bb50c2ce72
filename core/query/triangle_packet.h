// Four triangles side by side in single precision: how far away they are at least takes little more
// time than of one of them.
#pragma once

#include "core/base/types.h"

#include <limits>

namespace massprops {

/// A number for each of four.
using Lanes = Eigen::Array4f;

/// More than a chain of a dozen operations with floats loses, as a share.
constexpr float kFloatRounding = 16.0F * std::numeric_limits<float>::epsilon();

/// Distances are in the unit of the corners. Bounds make room for their rounding; `rounding` is
/// what coordinates lose as floats: `kFloatRounding` of the largest of the four triangles.
class TrianglePacket {
public:
  /// Triangle i, 0…3. Those that are not set lie in the origin.
  void set(int i, const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from a point: those of boxes and planes, and where one of
  /// these is below `reach` those of the triangles themselves but for rounding, corners apart.
  Lanes squaredDistances(const Vec3& p, float rounding, double reach) const;

  struct Vectors {
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero();
  };
  const Vectors& corner(int k) const { return corners_[k]; }

private:
  Vectors corners_[3];
};

/// Between two planes each, all of one normal, lies what four boxes hold: a piece of surface that
/// is not along the axes is far thinner than its box.
struct PlanePacket {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< unit; 0: no planes are known
  Lanes above, below;                               ///< bounds of the inner products with it
};

/// Four boxes side by side.
struct BoxPacket {
  Lanes lower[3], upper[3];

  /// Not more than the squared distances from a point. `rounding`: as for triangles; `planes`: null
  /// where none are known.
  Lanes squaredDistances(const Vec3& p, float rounding, const PlanePacket* planes) const;
};

/// The triangle (a, b, c), to be compared with four things at a time.
class QueryTriangle {
public:
  QueryTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from the triangles: those of boxes turned as this one
  /// lies, what is beside its sides, and the gaps along the others' normals.
  Lanes squaredDistances(const TrianglePacket& triangles, float rounding) const;
  /// Not more than the squared distances from what boxes and planes hold.
  Lanes squaredDistances(const BoxPacket& boxes, float rounding, const PlanePacket* planes) const;

private:
  using Vectors = TrianglePacket::Vectors;

  Vectors a_, b_, c_;      ///< the others relative to a, each four times the same
  Vectors frame_[3];       ///< orthonormal: along a side, across it, normal
  Lanes low_[3], high_[3]; ///< of the triangle in the frame, relative to a
  Vectors beside_[2];      ///< unit, across the two shorter sides, outwards
  Lanes atSide_[2];        ///< where these are along them, relative to a
  Lanes size_;
};

/// Where a triangle was, and how far away from a surface at least.
struct EarlierTriangle {
  Vec3 corners[3];
  double distance;
};

/// The triangle (a, b, c) has come in straight lines from where it was. Of what it moved away from
/// it is farther away now: |x + u − p|² ≥ |x − p|² + 2u·(x − p) for a point x of it that moved by
/// u.
class WayOfTriangle {
public:
  WayOfTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const EarlierTriangle& earlier);

  /// Not more than the squared distances from what of the surface is in the boxes; below 0 where
  /// nothing is known. `rounding`: as for triangles.
  Lanes squaredDistances(const BoxPacket& boxes, float rounding) const;

private:
  using Vectors = TrianglePacket::Vectors;

  Vectors a_;      ///< four times the same, like all others
  Vectors by_[3];  ///< that the corners moved
  Lanes least_[3]; ///< u·x of where it was, x relative to a
  Lanes before_;   ///< squared
  Lanes size_;
  Lanes ways_; ///< the longest, |x| + |y| + |z|
};

} // namespace massprops
