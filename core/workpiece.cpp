#include "core/workpiece.h"

namespace massprops {
namespace {

/// A wall that common printers print and that carries a hand-sized model.
constexpr double kDefaultWall = 0.01;
/// A pivot farther away, in diagonals, is a slip of the pen, and costs digits.
constexpr double kFarthestPivot = 10.0;

} // namespace

Workpiece makeWorkpiece(const Solid& solid, const Options& options) {
  Workpiece piece;
  piece.frame.rotation = rotationToUp(options.upAxis);
  const Points upright = solid.vertices() * piece.frame.rotation.transpose();
  std::optional<Vec2> radii;
  if (options.radiusX && options.radiusY) radii = Vec2(*options.radiusX, *options.radiusY);
  const GroundContact contact = groundContact(upright, radii);
  if (options.goal == GoalKind::Stand || options.goal == GoalKind::StandEmptyAndFilled) {
    requireArea(contact.area);
  }
  piece.frame.origin = piece.frame.rotation.transpose() * contact.centre;
  piece.frame.length = solid.diagonal();
  piece.contact = scaled(contact.area, solid.diagonal());
  piece.vertices = snapped(toWorking(piece.frame, solid.vertices()));
  piece.wall = options.innerLowerBound.value_or(kDefaultWall * solid.diagonal()) / solid.diagonal();
  if (options.pivot) {
    piece.pivot = toWorking(piece.frame, Points(options.pivot->transpose())).row(0).transpose();
    if (piece.pivot->norm() > kFarthestPivot) {
      throw InvalidInput("The pivot lies more than " + std::to_string(int(kFarthestPivot)) +
                         " times the model's diagonal away from the model: give pivot_x, pivot_y "
                         "and pivot_z in the coordinates of the scene.");
    }
  }
  piece.faces = solid.faces();
  piece.cavities = solid.cavities();
  piece.cavities.vertices = toWorking(piece.frame, solid.cavities().vertices);
  return piece;
}

} // namespace massprops
