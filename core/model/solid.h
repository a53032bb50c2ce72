// A surface that is known to bound a solid: validated once, so later stages need no checks.
#pragma once

#include "core/base/types.h"
#include "core/model/repair.h"

#include <vector>

namespace massprops {

class TriangleTree;

/// A surface that bounds no solid; mending.h may make it do so.
class DefectiveSurface : public InvalidInput {
public:
  using InvalidInput::InvalidInput;
};

/// One or more disjoint bodies, each bounded by a closed 2-manifold of its own with triangles
/// counter-clockwise seen from outside; no crossings (but see
/// `requireNoCrossings`), every vertex used,
/// positive volume. Only `makeSolid` makes one.
class Solid {
public:
  const Points& vertices() const { return mesh_.vertices; }
  const Faces& faces() const { return mesh_.faces; }
  /// Surfaces of cavities that the model has already, oriented into them; often empty.
  const TriangleMesh& cavities() const { return cavities_; }
  /// Length of the bounding box's diagonal.
  double diagonal() const { return diagonal_; }
  const Repairs& repairs() const { return repairs_; }
  /// For every face whether it is one of a lid that closes an opening of the input; empty when the
  /// input was closed.
  const std::vector<char>& isLid() const { return isLid_; }
  /// The faces without lids.
  Faces skin() const;
  /// Vertices along the openings that have lids.
  std::vector<int> rim() const;
  /// The faces' numbers in the order of `spatialOrder`, seen in the frame that was given.
  const std::vector<int>& spatialFaceOrder() const { return spatialFaceOrder_; }

private:
  friend Solid makeSolid(TriangleMesh input, bool closeOpenings, const Mat3& rotation,
                         const Repairs& before);
  friend void requireNoCrossings(const Solid& solid);
  friend void requireNoCrossings(const Solid& solid, const TriangleTree& posed, double apart);
  friend Solid withoutCrossings(Solid solid);
  TriangleMesh mesh_;
  TriangleMesh cavities_;
  double diagonal_ = 0.0;
  Repairs repairs_;
  std::vector<char> isLid_;
  std::vector<int> spatialFaceOrder_;
  bool mayCross_ = false;
};

/// Mends what `repair.h` mends, flips components that face the wrong way throughout, and sets
/// components that lie inside of another one aside as existing cavities.
/// `closeOpenings`: boundary loops get lids (hole_filling.h); otherwise an open surface is refused.
/// `rotation`: of the frame in which `spatialFaceOrder` is the same for a model that is turned.
/// `before`: what was mended already.
/// \throw DefectiveSurface with the number of defects and the MeshLab filter that mends them;
/// InvalidInput where there is no surface
Solid makeSolid(TriangleMesh input, bool closeOpenings = false,
                const Mat3& rotation = Mat3::Identity(), const Repairs& before = {});

/// Looks for crossings where `makeSolid` has not: of a single closed surface, for that is most of
/// the work and may be done beside the first stages that use the solid.
/// \throw DefectiveSurface as `makeSolid` does
void requireNoCrossings(const Solid& solid);
/// The same with a tree over the solid's faces, in their spatial order, in another frame, where
/// the two places of one point are at most `apart` apart.
void requireNoCrossings(const Solid& solid, const TriangleTree& posed, double apart);

/// The same, for which `requireNoCrossings` has nothing left to do. \throw DefectiveSurface
Solid withoutCrossings(Solid solid);

} // namespace massprops
