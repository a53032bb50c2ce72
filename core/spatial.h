// Distances and rays against a triangle mesh.
#pragma once

#include "core/types.h"

#include <memory>
#include <vector>

namespace massprops {

/// A search structure over the triangles of one mesh, which it copies.
class SurfaceIndex {
public:
  SurfaceIndex(const Points& vertices, const Faces& faces);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  /// Length of the chord from row i of `points` along row i of `directions` (unit) to the first
  /// triangle that does not contain the start, infinity where there is none. n entries.
  Vector chords(const Points& points, const Points& directions) const;

  struct Nearest {
    double distance;
    int face;
    Vec3 point; ///< on that face
  };
  /// The nearest point of the surface and the triangle it lies on; quicker with any point of the
  /// surface that is known to be near.
  Nearest nearest(const Vec3& point) const;
  Nearest nearest(const Vec3& point, const Nearest& hint) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// For every vertex the vertex itself, as a point of a triangle around it: a hint for `nearest`.
/// Vertices without a face have face −1.
std::vector<SurfaceIndex::Nearest> verticesAsHints(const Points& vertices, const Faces& faces);

/// Least distance between two disjoint surfaces, faces and edges included, told for every vertex of
/// the first that a face uses: the least over the triangles around it; infinity for other vertices.
/// Exact (up to rounding) wherever it is below `horizon`, and the least of all always is.
Vector surfaceDistances(const Points& vertices, const Faces& faces, const Points& otherVertices,
                        const Faces& otherFaces, double horizon);

} // namespace massprops
