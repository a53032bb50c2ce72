#include "core/workpiece.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace massprops {
namespace {

/// A wall that common printers print and that carries a hand-sized model.
constexpr double kDefaultWall = 0.01;
/// A pivot farther away, in diagonals, is a slip of the pen, and costs digits.
constexpr double kFarthestPivot = 10.0;

/// Faces in spatial order, vertices in the order in which these use them.
void arrangeInSpace(const Solid& solid, Workpiece& piece) {
  const Points working = snapped(toWorking(piece.frame, solid.vertices()));
  const std::vector<int>& faceOf = solid.spatialFaceOrder();
  std::vector<int> number(static_cast<std::size_t>(working.rows()), -1);
  piece.vertexOf.reserve(number.size());
  piece.faces.resize(solid.faces().rows(), 3);
  for (Eigen::Index f = 0; f < piece.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = solid.faces()(faceOf[static_cast<std::size_t>(f)], k);
      int& place = number[static_cast<std::size_t>(v)];
      if (place < 0) {
        place = static_cast<int>(piece.vertexOf.size());
        piece.vertexOf.push_back(v);
      }
      piece.faces(f, k) = place;
    }
  }
  if (!solid.isLid().empty()) {
    for (const int f : faceOf) piece.isLid.push_back(solid.isLid()[static_cast<std::size_t>(f)]);
    piece.open = openSurface(working.rows(), piece.faces, piece.isLid);
  }
  piece.vertices.resize(working.rows(), 3);
  for (Eigen::Index v = 0; v < working.rows(); ++v) {
    piece.vertices.row(v) = working.row(piece.vertexOf[static_cast<std::size_t>(v)]);
  }
}

Eigen::Index placeOf(Eigen::Index row, const std::vector<int>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  return row < n ? places[static_cast<std::size_t>(row)]
                 : n + places[static_cast<std::size_t>(row - n)];
}

/// Water that gets into the shell sinks it.
void requireDryOpenings(const Workpiece& piece, double waterLevel) {
  double lowest = 1.0;
  for (const int v : piece.open->rim) lowest = std::min(lowest, piece.vertices(v, 2));
  const double height = piece.vertices.col(2).maxCoeff();
  if (lowest > waterLevel * height) return;
  throw InvalidInput("The surface has an opening at " +
                     std::to_string(static_cast<int>(100.0 * lowest / height)) +
                     " % of its height, where the water would run in: lower water_level, or close "
                     "the opening with Remeshing > Close Holes, then run again.");
}

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
  piece.wall = options.innerLowerBound.value_or(kDefaultWall * solid.diagonal()) / solid.diagonal();
  if (options.pivot) {
    piece.pivot = toWorking(piece.frame, Points(options.pivot->transpose())).row(0).transpose();
    if (piece.pivot->norm() > kFarthestPivot) {
      throw InvalidInput("The pivot lies more than " + std::to_string(int(kFarthestPivot)) +
                         " times the model's diagonal away from the model: give pivot_x, pivot_y "
                         "and pivot_z in the coordinates of the scene.");
    }
  }
  arrangeInSpace(solid, piece);
  if (piece.open && options.goal == GoalKind::Float) requireDryOpenings(piece, options.waterLevel);
  piece.cavities = solid.cavities();
  piece.cavities.vertices = toWorking(piece.frame, solid.cavities().vertices);
  return piece;
}

std::vector<int> placesInSolid(const Workpiece& piece, const std::vector<int>& vertices) {
  const auto inSolid = [&](int v) {
    return static_cast<std::size_t>(piece.vertexOf[static_cast<std::size_t>(v)]);
  };
  std::vector<int> place(piece.vertexOf.size(), 0);
  for (const int v : vertices) place[inSolid(v)] = 1;
  std::exclusive_scan(place.begin(), place.end(), place.begin(), 0);
  std::vector<int> places;
  places.reserve(vertices.size());
  for (const int v : vertices) places.push_back(place[inSolid(v)]);
  return places;
}

Points placed(const Points& values, const std::vector<int>& places) {
  Points result(values.rows(), 3);
  for (Eigen::Index v = 0; v < values.rows(); ++v) result.row(placeOf(v, places)) = values.row(v);
  return result;
}

Vector placed(const Vector& values, const std::vector<int>& places) {
  Vector result(values.size());
  for (Eigen::Index v = 0; v < values.size(); ++v) result[placeOf(v, places)] = values[v];
  return result;
}

Faces placed(const Faces& faces, const std::vector<int>& places) {
  return faces.unaryExpr([&](int v) { return static_cast<int>(placeOf(v, places)); });
}

} // namespace massprops
