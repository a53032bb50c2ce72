// Conventions of the whole library, and the plain types that carry data through it.
//
// - Arrays are row-major, one point or one triangle a row; indices are 0-based.
// - A closed surface is oriented outwards: its triangles are counter-clockwise seen from outside.
// - Lengths are in model units, read as millimetres where grams are reported. Densities are g/cm³.
// - Inside the optimisation everything lives in the working frame of `frame.h`: up is +z, the
//   goal's reference point is the origin, the bounding-box diagonal is 1.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <stdexcept>

namespace massprops {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
/// Row-major as the points are, so that a point's values lie side by side.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// n×3, one point a row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// m×3, one triangle a row, indices into Points.
using Faces = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Some of a list of indices.
struct IndexRange {
  const int* first;
  const int* last;
  const int* begin() const { return first; }
  const int* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// Any triangles: nothing is promised about them.
struct TriangleMesh {
  Points vertices;
  Faces faces;
};

/// A caller's mistake. The message says what is wrong and what to do about it in MeshLab.
class InvalidInput : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace massprops
