// In which directions a standing body may tip over, and how far it is from doing so.
#pragma once

#include "core/goals/goal.h"
#include "core/model/contact.h"

#include <cstddef>
#include <vector>

namespace massprops {

/// A horizontal direction in which the body may tip over.
struct TippingDirection {
  Vec2 unit;
  double extent; ///< of the contact area
};

/// Of the body with these mass moments, degrees: contact.h.
double tippingAngleOf(const ContactArea& area, const Moments& massMoments);

/// Neighbouring edges of a convex polygon that count as one, from `first` to before `last`.
struct PolygonSide {
  std::size_t first, last;
};

/// One for each edge; where there are more of them than directions all round, one for those that
/// turn by no more than from one of these to the next, for the solver's time grows with them.
/// `normals`: of the edges, unit, one after the other.
std::vector<PolygonSide> polygonSides(const std::vector<Vec2>& normals);

/// Outward normals of a polygon's edges, the polygon being counter-clockwise.
std::vector<Vec2> edgeNormals(const std::vector<Vec2>& polygon);

/// Outward normals of the area's sides, and directions all round for corners and ellipses.
std::vector<TippingDirection> tippingDirections(const ContactArea& area);

/// Of soft maxima over tangents of tipping angles and over heights of metacentres, in diagonals.
/// Sharper ones were seen to stop the solver at kinks, softer ones to raise directions that the
/// body does not tip over in.
constexpr double kTippingSharpness = 70.0;

/// −1/s log Σ exp(−s (extent − u·c)/c_z) over the directions u: at most the tangent of the tipping
/// angle, and less by log(directions)/s at most; here negative, to be minimised. Smooth.
GoalValue negativeSmoothTipping(const std::vector<TippingDirection>& directions,
                                const Moments& massMoments);

/// The level is the tangent of the tipping angle: u·S + t S_z − extent m ≤ 0 for all directions u,
/// S = m c. [PWLSH13, Sec. 4]
LinearConditions standingConditions(const std::vector<TippingDirection>& directions);

} // namespace massprops
