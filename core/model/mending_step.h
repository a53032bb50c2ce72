// What the steps of the mending have in common.
#pragma once

#include "core/base/types.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>

namespace massprops {

/// Nothing that moves the surface less than the wall can be felt. Knows for which other walls all
/// that it was asked for would have had the same answer; copies know it together.
class FeltWall {
public:
  FeltWall(double length = 0.0) : length_(length) {} // NOLINT: a length is one

  bool hides(double distance) const {
    const bool isHidden = distance <= length_;
    (isHidden ? alike_->least : alike_->beyond) =
        isHidden ? std::max(alike_->least, distance) : std::min(alike_->beyond, distance);
    return isHidden;
  }
  double exactly() const {
    *alike_ = {length_, length_};
    return length_;
  }
  bool isLike(double length) const {
    return length == length_ || (alike_->least <= length && length < alike_->beyond);
  }

private:
  struct Range {
    double least = 0.0, beyond = std::numeric_limits<double>::infinity();
  };
  double length_;
  std::shared_ptr<Range> alike_ = std::make_shared<Range>();
};

/// What the steps may go by.
struct MendingTask {
  FeltWall wall;
  Mat3 rotation = Mat3::Identity(); ///< that puts the model upright, +z
  bool keepsOpenings = false;       ///< whether the surface is to become a shell with its openings
  /// Rounds points to what the caller can store.
  std::function<Points(const Points&)> representable = [](const Points& points) { return points; };
};

/// What a step made of a surface.
struct MendedMesh {
  TriangleMesh mesh;
  std::string done = {};    ///< "3 holes closed"; empty: there was nothing to do
  double distance = 0.0;    ///< the surface lies within this of where it was, length
  std::string warning = {}; ///< a sentence; empty: the mended model is as good as the given one
};

/// Takes any triangles with corners that differ and finite coordinates; does nothing where there is
/// nothing to do or where it fails.
using MendingStep = MendedMesh (*)(const TriangleMesh& mesh, const MendingTask& task);

/// "1 hole", "3 holes".
inline std::string counted(std::size_t n, const char* singular, const char* plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

/// Of the box around the vertices, length.
inline double diagonalOf(const Points& vertices) {
  if (vertices.rows() == 0) return 0.0;
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

/// A share of the diagonal: what is nearer is at the same place for any printer.
inline constexpr double kPlaceShare = 1e-5;

/// A length far above the rounding of floats near these vertices.
inline double wellAboveFloats(const Points& vertices) {
  constexpr double kFloat = 1e-6;
  return vertices.rows() == 0 ? 0.0 : kFloat * vertices.cwiseAbs().maxCoeff();
}

/// What is nearer than this is at the same place for any printer, and far above the rounding of a
/// float.
inline double placeTolerance(const Points& vertices) {
  return std::max(kPlaceShare * diagonalOf(vertices), wellAboveFloats(vertices));
}

/// Whether floats store these vertices far finer than mending tells places apart.
inline bool isFloatFineFor(const Points& vertices) {
  return wellAboveFloats(vertices) <= kPlaceShare * diagonalOf(vertices);
}

} // namespace massprops
