#include "core/model/posed_model.h"

#include "core/base/tolerances.h"
#include "core/mesh/signed_volume.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace massprops {
namespace {

/// A pivot farther away, in diagonals, is a slip of the pen, and costs digits.
constexpr double kFarthestPivot = 10.0;

/// Faces in spatial order, vertices in the order in which these use them.
void arrangeInSpace(const Solid& solid, PosedModel& posed) {
  const Points working = snapped(toWorking(posed.frame, solid.vertices()));
  const std::vector<int>& faceOf = solid.spatialFaceOrder();
  std::vector<int> number(static_cast<std::size_t>(working.rows()), -1);
  posed.vertexOf.reserve(number.size());
  posed.faces.resize(solid.faces().rows(), 3);
  for (Eigen::Index f = 0; f < posed.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = solid.faces()(faceOf[static_cast<std::size_t>(f)], k);
      int& place = number[static_cast<std::size_t>(v)];
      if (place < 0) {
        place = static_cast<int>(posed.vertexOf.size());
        posed.vertexOf.push_back(v);
      }
      posed.faces(f, k) = place;
    }
  }
  if (!solid.isLid().empty()) {
    for (const int f : faceOf) posed.isLid.push_back(solid.isLid()[static_cast<std::size_t>(f)]);
    posed.open = openSurface(working.rows(), posed.faces, posed.isLid);
  }
  posed.vertices.resize(working.rows(), 3);
  for (Eigen::Index v = 0; v < working.rows(); ++v) {
    posed.vertices.row(v) = working.row(posed.vertexOf[static_cast<std::size_t>(v)]);
  }
}

/// Sides nearer than the grid of `snapped` may have been joined.
void requireVolume(const PosedModel& posed) {
  if (signedVolume(posed.vertices, posed.faces) > kLeastVolume) return;
  throw InvalidInput(
      "The surface encloses no volume that can be calculated with, it is thinner than "
      "a billionth of its diagonal: open a model that is a solid body.");
}

ContactArea snappedArea(ContactArea area) {
  const auto snap = [](Vec2& p) {
    p = snapped(Points(Eigen::RowVector3d(p.x(), p.y(), 0.0))).row(0).head<2>().transpose();
  };
  for (Vec2& corner : area.polygon) snap(corner);
  if (area.radii) snap(*area.radii);
  return area;
}

Eigen::Index placeOf(Eigen::Index row, const std::vector<int>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  return row < n ? places[static_cast<std::size_t>(row)]
                 : n + places[static_cast<std::size_t>(row - n)];
}

/// Water that gets into the shell sinks it.
void requireDryOpenings(const PosedModel& posed, double waterLevel) {
  double lowest = 1.0;
  for (const int v : posed.open->rim) lowest = std::min(lowest, posed.vertices(v, 2));
  const double height = posed.vertices.col(2).maxCoeff();
  if (lowest > waterLevel * height) return;
  throw InvalidInput("The surface has an opening at " +
                     std::to_string(static_cast<int>(100.0 * lowest / height)) +
                     " % of its height, where the water would run in: lower water_level, or close "
                     "the opening with Remeshing > Close Holes, then run again.");
}

} // namespace

PosedModel posedModel(const Solid& solid, UpAxis up, const std::optional<Vec2>& radii,
                      const std::optional<Foot>& foot) {
  PosedModel posed;
  posed.foot = foot;
  posed.frame.rotation = rotationToUp(up);
  const Points upright = solid.vertices() * posed.frame.rotation.transpose();
  const GroundContact contact =
      groundContact(upright, radii, foot ? std::optional(foot->spread) : std::nullopt);
  posed.frame.origin = posed.frame.rotation.transpose() * contact.centre;
  posed.frame.length = solid.diagonal();
  posed.contact = snappedArea(scaled(contact.area, solid.diagonal()));
  arrangeInSpace(solid, posed);
  requireVolume(posed);
  posed.cavities = solid.cavities();
  posed.cavities.vertices = toWorking(posed.frame, solid.cavities().vertices);
  return posed;
}

std::optional<Vec2> givenRadii(const Options& options) {
  if (!options.radiusX || !options.radiusY) return std::nullopt;
  return Vec2(*options.radiusX, *options.radiusY);
}

void takeWishes(const Options& options, PosedModel& posed) {
  if (standsOnContacts(options.goal)) requireArea(posed.contact);
  const double diagonal = posed.frame.length;
  posed.wall = snappedUp(options.innerLowerBound.value_or(kDefaultWall * diagonal) / diagonal +
                         roundOff(posed.frame));
  posed.pivot.reset();
  if (options.pivot) {
    posed.pivot = toWorking(posed.frame, Points(options.pivot->transpose())).row(0).transpose();
    if (posed.pivot->norm() > kFarthestPivot) {
      throw InvalidInput("The pivot lies more than " + std::to_string(int(kFarthestPivot)) +
                         " times the model's diagonal away from the model: give pivot_x, pivot_y "
                         "and pivot_z in the coordinates of the scene.");
    }
  }
  if (posed.open && options.goal == GoalKind::Float) requireDryOpenings(posed, options.waterLevel);
}

PosedModel makePosedModel(const Solid& solid, const Options& options,
                          const std::optional<Foot>& foot) {
  PosedModel posed = posedModel(solid, options.upAxis, givenRadii(options), foot);
  takeWishes(options, posed);
  return posed;
}

std::vector<int> placesInSolid(const PosedModel& posed, const std::vector<int>& vertices) {
  const auto inSolid = [&](int v) {
    return static_cast<std::size_t>(posed.vertexOf[static_cast<std::size_t>(v)]);
  };
  std::vector<int> place(posed.vertexOf.size(), 0);
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
