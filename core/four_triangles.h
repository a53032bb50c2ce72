// Four triangles side by side in single precision: how far away they are at least takes little more
// time than of one of them.
#pragma once

#include "core/types.h"

namespace massprops {

/// A number for each of four triangles.
using Lanes = Eigen::Array4f;

/// Bounds make room for their rounding; `rounding` is what coordinates lost when they became
/// floats, 8 units of the largest of them.
class FourTriangles {
public:
  /// `i`: 0…3
  void set(int i, const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from a point: those of boxes and planes.
  Lanes squaredDistances(const Vec3& p, float rounding) const;

  struct Vectors {
    Lanes x, y, z;
  };
  const Vectors& corner(int k) const { return corners_[k]; }

private:
  Vectors corners_[3];
};

/// A triangle as the four see it.
class LoneTriangle {
public:
  LoneTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Not more than the squared distances from the triangles: the gaps along the normals.
  Lanes squaredDistances(const FourTriangles& triangles, float rounding) const;

private:
  FourTriangles::Vectors a_, b_, c_; ///< the others relative to a, each four times the same
  FourTriangles::Vectors normal_;
  Lanes size_;
};

} // namespace massprops
