// What is wrong with a cavity, vertex by vertex, measured on the triangles to be delivered.
#pragma once

#include "core/base/types.h"
#include "core/query/surface_distance.h"
#include "core/query/triangle_tree.h"

#include <functional>
#include <vector>

namespace massprops {

struct Inspection {
  /// Distance from the outer surface, see `Clearance`, exact below the wanted wall; n entries.
  Vector wall;
  double leastWall = 0.0; ///< exact; infinity when there is no cavity
  /// Vertices of faces that cross another face, or of a component that is not inside of the outer
  /// surface, is turned inside out or lies in another component; ascending.
  std::vector<int> crossing;
  /// Vertices of faces of a moved outer surface that cross each other, ascending.
  std::vector<int> outerCrossing;
  /// Vertices whose wall may be thinner than the wanted one, ascending.
  std::vector<int> thin;
  /// The outer face next to each vertex; −1 for a vertex without a face.
  std::vector<int> nearestFace;
  /// How far each vertex itself is from the outer surface at least, see `Clearance`.
  Vector wallOfVertexAtLeast;
  int components = 0;

  bool isClean() const { return crossing.empty() && outerCrossing.empty() && thin.empty(); }
};

/// Exact predicates for crossings and containment, double precision for distances: surfaces that
/// are a wall apart do not cross.
/// `inner`, `innerFaces`: the cavity, outward oriented as a body of its own. `wall`: wanted
/// distance, same unit. `clearance`: null, or made for `outer`; several inspections with one take
/// less time. `stored`: empty, or the points as the caller gets them, where faces must not cross,
/// either: what just passes by in one frame may touch in another, for both are rounded.
Inspection inspect(const Points& inner, const Faces& innerFaces, const TriangleTree& outer,
                   double wall, ClearanceQuery* clearance = nullptr,
                   const std::function<Points(const Points&)>& stored = {});

/// Vertices of faces of an outer surface that has moved which cross each other, ascending.
/// `stored`: as above.
std::vector<int> outerCrossings(const TriangleTree& outer,
                                const std::function<Points(const Points&)>& stored = {});

/// An inspection of the shell of an open surface (open_surface.h): skin, offset surface and strips
/// together are free of crossings and bound the material, and the offset surface, strips apart,
/// keeps the wall from the skin. `positions`: 2n×3, the last n those of the skin; `wall`,
/// `nearestFace` have 2n entries, the latter faces of the skin, the wall being 0 on the skin
/// itself; `crossing` and `thin` are vertices below n. `stored`: as above.
Inspection inspectShell(const Points& positions, const Faces& cavity, const TriangleTree& skin,
                        double wall, const std::function<Points(const Points&)>& stored = {});

} // namespace massprops
