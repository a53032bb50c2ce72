// Where a body touches the ground, and what that means for tipping over.
#pragma once

#include "core/base/types.h"

#include <optional>
#include <vector>

namespace massprops {

/// A convex region of the ground plane, relative to its own centre. Coordinates are the two
/// horizontal ones of the working frame.
struct ContactArea {
  /// Convex polygon, counter-clockwise, at least three corners or none; unused when `radii` is
  /// given.
  std::vector<Vec2> polygon;
  /// Half axes of an ellipse that takes the polygon's place.
  std::optional<Vec2> radii;
};

struct GroundContact {
  Vec3 centre; ///< centroid of the contact polygon; of the contact points if that has no area
  ContactArea area;
};

/// Corners of the convex hull, counterclockwise, without those on its sides.
std::vector<Vec2> convexHull(const std::vector<Vec2>& points);

/// The hull of these points of the ground. The polygon is empty when it has an area of no more than
/// 1e-8 of the squared diagonal.
GroundContact contactOf(const std::vector<Vec2>& touching, double ground, double diagonal);

/// All vertices within 1e-4 of the diagonal above the lowest one touch the ground, or those within
/// `height`. `upright`: n×3, up is +z, any unit. `radii`: half axes instead of the polygon, same
/// unit. The polygon is empty when the contact points span no area.
GroundContact groundContact(const Points& upright, const std::optional<Vec2>& radii,
                            const std::optional<double>& height = {});

/// \throw InvalidInput when there is neither a polygon nor an ellipse
void requireArea(const ContactArea& area);

/// The area scaled: a corner p becomes p / length.
ContactArea scaled(const ContactArea& area, double length);

/// The area's size, length²; 0 where there is none.
double sizeOf(const ContactArea& area);

/// Radius of the largest circle within the area; 0 where there is none.
double inradius(const ContactArea& area);

/// Whether a circle of this radius has room in the area.
bool holdsCircle(const ContactArea& area, double radius);

/// Farthest extent of the area in the unit direction `u` (support function), ≥ 0.
double extent(const ContactArea& area, const Vec2& u);

/// Corners of the area, counter-clockwise; an ellipse by 64 points.
std::vector<Vec2> outline(const ContactArea& area);

/// The unit direction u with the least extent(u) − u·c.
Vec2 weakestDirection(const ContactArea& area, const Vec2& c);

/// Distance of `c` from the area's border, positive inside, negative outside: the minimum over all
/// unit directions u of extent(u) − u·c.
double signedDistance(const ContactArea& area, const Vec2& c);

/// Smallest angle, in degrees, by which a body must be tilted until it falls, its centre of mass
/// being at `centre` above the ground and relative to the area's centre: the minimum over all
/// horizontal directions u of atan2(extent(u) − u·c, c_z). Negative: it falls by itself.
/// [PWLSH13, Sec. 4]
double tippingAngle(const ContactArea& area, const Vec3& centre);

} // namespace massprops
