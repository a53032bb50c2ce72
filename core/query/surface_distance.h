// Distances between surfaces and chords through them.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// Length of the chord from row i of `points` along row i of `directions` (unit) to the first
/// triangle that does not contain the start, infinity where there is none. n entries.
Vector chords(const TriangleTree& surface, const Points& points, const Points& directions);

struct Clearance {
  /// For every vertex that a face uses: the least distance of the triangles around it from the
  /// other surface; infinity for other vertices. Below the horizon exact to a billionth; above it
  /// at least the horizon, at most 5 % more than the least over the triangles' corners.
  Vector distance;
  double least = 0.0;           ///< of all, exact to a billionth; infinity without faces
  std::vector<int> crossing;    ///< faces that cross the other surface, ascending
  std::vector<int> nearestFace; ///< of the other surface, for every vertex; −1 without a face
};

/// What a measurement against a surface leaves for the next one against the same: what has hardly
/// moved since needs no second look.
struct ClearanceMemory {
  Points vertices;
  std::vector<int> nearestFace;
  Faces faces;
  /// Vertices and faces are at least so far away.
  Vector vertexBounds, faceBounds;
};

/// How far a surface is from another one, edges and insides of faces included.
/// docs/math.md "Measuring the wall"
/// `memory`: empty, or of the same vertices at other places and with other faces; then of these.
Clearance clearanceOf(const Points& vertices, const Faces& faces, const TriangleTree& other,
                      double horizon, ClearanceMemory* memory = nullptr);

/// The distances alone.
Vector surfaceDistances(const Points& vertices, const Faces& faces, const Points& otherVertices,
                        const Faces& otherFaces, double horizon);

} // namespace massprops
