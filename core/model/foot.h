// A foot: a model that has too little to stand on is cut flat a little above its lowest point.
#pragma once

#include "core/base/options.h"
#include "core/model/contact.h"
#include "core/model/solid.h"

#include <optional>
#include <utility>
#include <vector>

namespace massprops {

/// How the model was cut.
struct Foot {
  double depth = 0.0;  ///< of the plane above the lowest point, length
  double spread = 0.0; ///< of the heights of the foot's vertices, length: rounding at most
};

/// The lowest part of a body, and what the body would stand on were it cut there.
class LowestPart {
public:
  /// `upright`: up is +z; faces with a corner no higher than `height` above the lowest vertex
  /// count.
  LowestPart(const Points& upright, const Faces& faces, double height);

  /// Of the cut at that depth: the hull of all that the plane cuts out.
  GroundContact contactAt(double depth) const;
  /// Near the wanted depth, where no vertex is near to the plane.
  double clearDepth(double wanted) const;
  /// That may be wanted, so that the clear one is still within the height.
  double deepestWanted() const;

private:
  double ground_, height_, diagonal_;
  std::vector<std::pair<Vec3, Vec3>> edges_; ///< from the lower to the higher end, by the former
  std::vector<double> heights_;              ///< of vertices above the lowest, ascending
};

/// A solid with a foot, if it needs one.
struct Footing {
  Solid solid;
  std::optional<Foot> foot;
  /// Of the model as it was, as high as a foot may be cut; empty where no depth is left to choose.
  std::optional<LowestPart> lowest;
};

/// Whether the goal is one of standing on the ground contacts, and a foot is not ruled out.
bool mayHaveFoot(const Options& options);

/// Whether it is to be cut: because that is asked for, or because its ground contacts hold no
/// circle with a radius of a hundredth of the diagonal.
bool needsFoot(const Solid& solid, const Options& options);

/// The solid cut flat: by the depth that is given, or by the least for which its ground contacts
/// hold such a circle or else the depth for which the circle is largest, a hundredth of the height
/// at most; by `wanted` where that has been found out to be better. Existing cavities that the cut
/// would open count as filled; the openings of an open surface are not touched. Bodies stay in one
/// piece. What cannot be cut stays. \throw InvalidInput when a depth is given that it cannot be cut
/// by; DefectiveSurface when it crosses itself
Footing onFoot(Solid solid, const Options& options, const std::optional<double>& wanted = {});

} // namespace massprops
