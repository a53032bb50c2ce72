// A coarse copy of a surface, and functions on it carried over to the surface.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// Values at a surface's vertices as weighted means of values at a proxy's vertices, at most three
/// each: the matrix P of n rows and p columns, whose rows are positive and sum to 1.
class Interpolation {
public:
  /// `corners`, `weights`: n×3
  Interpolation(Faces corners, Points weights, Eigen::Index proxySize);
  /// P = 1.
  static Interpolation identity(Eigen::Index size);

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return cols_; }
  bool isIdentity() const { return corners_.rows() == 0; }

  Vector operator*(const Vector& values) const;
  Points operator*(const Points& values) const;
  /// PᵀY, p×m, for Y n×m with few columns.
  RowMatrix transposeTimes(const Eigen::Ref<const RowMatrix>& values) const;

private:
  Interpolation() = default;

  Eigen::Index rows_ = 0;
  Eigen::Index cols_ = 0;
  Faces corners_;
  Points weights_;
};

struct CoarseCopy {
  /// Closed manifolds, as many as the surface has components; may cross themselves a little.
  TriangleMesh mesh;
  /// For every vertex of the copy the vertex of the surface that it is.
  std::vector<int> vertexOf;
};

/// How coarse: about `most` vertices, and fewer, down to `least`, where those that go are within
/// `distance` of the planes of the faces that they belonged to, in the mean square; a length in the
/// vertices' unit.
struct Coarseness {
  Eigen::Index most, least;
  double distance;
};

/// Collapses edges, those first that change the shape least [GH97] and are shortest. The surface
/// itself where it has not clearly more vertices.
/// \pre closed manifold components
CoarseCopy coarseCopy(const Points& vertices, const Faces& faces, const Coarseness& wanted);

struct Proxy {
  TriangleMesh mesh; ///< a coarse copy
  /// For every vertex of the proxy the vertex of the surface that it is, and for every one of the
  /// surface that of the proxy that it fell together with; empty where the proxy is the surface.
  std::vector<int> vertexOf, vertexFor;
};

/// A coarse copy that carries functions.
/// \pre closed manifold components
Proxy makeProxy(const Points& vertices, const Faces& faces, const Coarseness& wanted);

/// The surface's vertices by the proxy's, at the points of the proxy next to them.
/// `vertices`: those of the surface that the proxy was made for.
Interpolation interpolationFrom(const Proxy& proxy, const Points& vertices);

} // namespace massprops
