// Four triangles side by side in single precision: how far away they are at least takes little more
// time than of one of them.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// A number for each of four.
using Lanes = Eigen::Array4f;

/// Distances are in the unit of the corners. Bounds make room for their rounding; `rounding` is
/// what coordinates lose as floats: 8 units in the last place of the largest of the four triangles.
class TrianglePacket {
public:
  /// Triangle i, 0…3. Those that are not set lie in the origin.
  void set(int i, const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from a point: those of boxes and planes.
  Lanes squaredDistances(const Vec3& p, float rounding) const;

  struct Vectors {
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero();
  };
  const Vectors& corner(int k) const { return corners_[k]; }

private:
  Vectors corners_[3];
};

/// The triangle (a, b, c), to be compared with four at a time.
class QueryTriangle {
public:
  QueryTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from the triangles: the gaps along the normals.
  Lanes squaredDistances(const TrianglePacket& triangles, float rounding) const;

private:
  TrianglePacket::Vectors a_, b_, c_; ///< the others relative to a, each four times the same
  TrianglePacket::Vectors normal_;
  Lanes size_;
};

} // namespace massprops
