// How far a surface is from another one, edges and insides of faces included.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

struct Clearance {
  /// For every vertex that a face uses: its distance from the other surface or, where a triangle
  /// around it comes nearer than the triangle's corners, that of the triangle; infinity for other
  /// vertices. Below the horizon exact to a billionth; above it at least the horizon.
  Vector distance;
  double least = 0.0;           ///< of all, exact to a billionth; infinity without faces
  std::vector<int> crossing;    ///< faces that cross the other surface, ascending
  std::vector<int> nearestFace; ///< of the other surface, for every vertex; −1 without a face
  /// How far every vertex itself is from the other surface at least; 0 without a face.
  Vector vertexBounds;
};

/// Measures surfaces against one that rests, and remembers: what has hardly moved since the last
/// measurement needs no second look. docs/math.md "Measuring the wall"
class ClearanceQuery {
public:
  /// Refers to the tree, which needs all its queries.
  explicit ClearanceQuery(const TriangleTree& other) : other_(other) {}

  /// `vertices`, `faces`: in later calls the same vertices at other places, more or fewer of them,
  /// and other faces.
  /// `horizon`: distances above it need not be exact.
  Clearance measure(const Points& vertices, const Faces& faces, double horizon);

  /// For every face alone: below the horizon exact to a billionth, above it at least the horizon.
  const Vector& measureFaces(const Points& vertices, const Faces& faces, double horizon);

  /// For every face at most, quicker by far: how near it comes to the faces that are next to its
  /// corners; above the horizon at least that.
  Vector faceDistancesAtMost(const Points& vertices, const Faces& faces, double horizon);

  /// Of the last measurement, for every vertex; −1 without a face.
  const std::vector<int>& nearestFace() const { return memory_.nearestFace; }

  const TriangleTree& other() const { return other_; }

  /// Where vertices and faces were, and how far away they are at least.
  struct Memory {
    Points vertices;
    std::vector<int> nearestFace;
    Faces faces;
    Vector vertexBounds, faceBounds;
  };

private:
  const TriangleTree& other_;
  Memory memory_;
};

} // namespace massprops
