#include "core/workpiece.h"

namespace massprops {
namespace {

/// A wall that common printers print and that carries a hand-sized model.
constexpr double kDefaultWall = 0.01;

} // namespace

Workpiece makeWorkpiece(const Solid& solid, const Options& options) {
  Workpiece piece;
  piece.frame.rotation = rotationToUp(options.upAxis);
  const Points upright = solid.vertices() * piece.frame.rotation.transpose();
  std::optional<Vec2> radii;
  if (options.radiusX && options.radiusY) radii = Vec2(*options.radiusX, *options.radiusY);
  const GroundContact contact = groundContact(upright, radii);
  if (options.goal == GoalKind::Stand) requireArea(contact.area);
  piece.frame.origin = piece.frame.rotation.transpose() * contact.centre;
  piece.frame.length = solid.diagonal();
  piece.contact = scaled(contact.area, solid.diagonal());
  piece.vertices = snapped(toWorking(piece.frame, solid.vertices()));
  piece.wall = options.innerLowerBound.value_or(kDefaultWall * solid.diagonal()) / solid.diagonal();
  piece.faces = solid.faces();
  piece.cavities = solid.cavities();
  piece.cavities.vertices = toWorking(piece.frame, solid.cavities().vertices);
  return piece;
}

} // namespace massprops
