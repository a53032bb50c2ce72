// In which directions a standing body may tip over, and how far it is from doing so.
#pragma once

#include "core/goals/goal.h"
#include "core/model/contact.h"

#include <vector>

namespace massprops {

/// A horizontal direction in which the body may tip over.
struct TippingDirection {
  Vec2 unit;
  double extent; ///< of the contact area
};

/// Outward normals of the area's edges, or of groups of neighbouring ones where there are more than
/// 64, and 72 directions all round for corners and ellipses.
std::vector<TippingDirection> tippingDirections(const ContactArea& area);

/// −1/s log Σ exp(−s (extent − u·c)/c_z) over the directions u: at most the tangent of the tipping
/// angle, and less by log(directions)/s at most; here negative, to be minimised. Smooth.
GoalValue negativeSmoothTipping(const std::vector<TippingDirection>& directions,
                                const Moments& massMoments);

/// The smooth maximum of both, of the same kind: of a body that may tip over in either state.
GoalValue smoothMaximum(const GoalValue& a, const GoalValue& b);

/// The level is the tangent of the tipping angle: u·S + t S_z − extent m ≤ 0 for all directions u,
/// S = m c. [PWLSH13, Sec. 4]
LinearConditions standingConditions(const std::vector<TippingDirection>& directions);

} // namespace massprops
