// Distances between surfaces and chords through them.
#pragma once

#include "core/triangle_tree.h"
#include "core/types.h"

namespace massprops {

/// Length of the chord from row i of `points` along row i of `directions` (unit) to the first
/// triangle that does not contain the start, infinity where there is none. n entries.
Vector chords(const TriangleTree& surface, const Points& points, const Points& directions);

struct Clearance {
  /// For every vertex that a face uses: the least distance of the triangles around it from the
  /// other surface; infinity for other vertices. Below the horizon, and for the least of all, exact
  /// up to rounding; above it the least over the triangles' corners, and beyond twice the horizon
  /// up to 5 % more than that.
  Vector distance;
  double least = 0.0;           ///< of all; infinity without faces
  std::vector<int> crossing;    ///< faces that cross the other surface, ascending
  std::vector<int> nearestFace; ///< of the other surface, for every vertex; −1 without a face
};

/// How far a surface is from another one, edges and insides of faces included.
/// docs/math.md "Measuring the wall"
/// `findLeast`: if not, the least of all is exact below the horizon only, too: quicker where most
/// is just beyond it.
Clearance clearanceOf(const Points& vertices, const Faces& faces, const TriangleTree& other,
                      double horizon, bool findLeast = true);

/// The distances alone.
Vector surfaceDistances(const Points& vertices, const Faces& faces, const Points& otherVertices,
                        const Faces& otherFaces, double horizon);

} // namespace massprops
