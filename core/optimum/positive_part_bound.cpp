#include "core/optimum/positive_part_bound.h"

#include "core/base/cube_cut.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/query/point_in_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace massprops {
namespace {

constexpr int kFirstAlongASide = 16;
/// Of what a cube at the border contributes: dividing it may tell that much, whatever the rest.
constexpr double kLeastSlack = 0.1;

/// What is known of a cube, whatever is integrated over it.
struct Place {
  enum class Hollow : char {
    Unknown,   ///< nobody has asked yet
    Nothing,   ///< none of it may be hollow
    Anything,  ///< all of it may be
    Something, ///< part of it may be, and no better is known
    Beyond     ///< at most a share of it
  };
  Hollow hollow = Hollow::Unknown;
  bool isInside = false;  ///< whether it is known that its centre is
  int nearFace = -1;      ///< one that is near its centre, if any is known
  int firstPart = -1;     ///< the first of the places of its eight parts, if they have any
  double clearance = 0.0; ///< at most the distance of its centre from the surface
  double share = 1.0;     ///< that may be hollow at most
  double wished = 1.0;    ///< what that would be about if the surface were known to be a plane
};

/// A cube with what is integrated over it.
struct Cube {
  Vec3 centre;
  double edge;
  int place;
  double upper = 0.0; ///< of its contribution
  double slack = 0.0; ///< by how much that may be too large; 0: nothing to be gained by dividing
};

/// A quadric over a box. What is linear in each coordinate lies below its values at the corners,
/// interpolated; −x² lies above them by a quarter of the squared edge at most.
struct Bounds {
  double meanOfPositive = 0.0; ///< at least the mean of max(0, q)
  double greatest = 0.0;       ///< at least max(0, q)
  double slack = 0.0;          ///< of the mean
};

Bounds boundsOver(const Moments& quadric, const Vec3& centre, const Vec3& size) {
  const Vec3 curvature = quadric.segment<3>(4).cwiseProduct(size.cwiseAbs2());
  const double over = 0.25 * (-curvature).cwiseMax(0.0).sum();
  const double under = 0.25 * curvature.cwiseMax(0.0).sum();
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 step((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                    (corner & 4) != 0 ? 0.5 : -0.5);
    const double value = quadric.dot(monomials(centre + size.cwiseProduct(step)));
    sum += std::max(0.0, value + over);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  if (greatest + over <= 0.0) return {};
  if (least - under >= 0.0) {
    // Positive throughout: the mean is that of the quadric itself.
    const double mean = quadric.dot(monomials(centre)) + curvature.sum() / 12.0;
    return {mean, greatest + over, 0.0};
  }
  const double mean = sum / 8.0;
  return {mean, greatest + over, std::min(mean, 0.25 * (greatest - least) + over + under)};
}

/// Those of the parts of the cube in its layers.
Bounds boundsOver(const LayeredQuadric& q, const Cube& cube) {
  const double bottom = cube.centre.z() - 0.5 * cube.edge;
  const double top = cube.centre.z() + 0.5 * cube.edge;
  const std::size_t first = q.layerAt(bottom);
  const std::size_t last = q.layerAt(top);
  if (first == last) {
    return boundsOver(q.quadrics[first], cube.centre, Vec3::Constant(cube.edge));
  }
  Bounds all;
  for (std::size_t layer = first; layer <= last; ++layer) {
    const double low = layer > first ? q.heights[layer - 1] : bottom;
    const double high = layer < last ? q.heights[layer] : top;
    const Bounds part =
        boundsOver(q.quadrics[layer], {cube.centre.x(), cube.centre.y(), 0.5 * (low + high)},
                   {cube.edge, cube.edge, high - low});
    const double share = (high - low) / cube.edge;
    all.meanOfPositive += share * part.meanOfPositive;
    all.slack += share * part.slack;
    all.greatest = std::max(all.greatest, part.greatest);
  }
  return all;
}

double halfDiagonal(double edge) {
  return 0.5 * std::sqrt(3.0) * edge;
}

/// At least the share of a cube that lies farther along a unit vector from its centre than `depth`.
double shareBeyond(const Vec3& away, double depth, double edge) {
  // The cut turns planes off the cube's axes: by no more than this at its corners.
  constexpr double kTurned = 0.5 * 3.0 * 0.01;
  const double turned =
      std::min(kTurned, 0.5 * (Vec3::Constant(0.01) - away.cwiseAbs()).cwiseMax(0.0).sum());
  return cubeCut(away, depth / edge - turned - kOutwards).volume;
}

} // namespace

class PositivePartBounds::Places {
public:
  Places(const TriangleTree& surface, double wall)
      : surface_(surface), inside_(surface), wall_(wall) {}

  /// Rounds of division, each of the cubes with the most to gain.
  double bound(const LayeredQuadric& q, double enough, std::size_t mostCubes) {
    std::vector<Cube> cubes = first();
    std::vector<Cube> waiting; // that more divisions would tell more about
    std::size_t asked = 0;
    double decided = 0.0;
    while (true) {
      evaluate(q, cubes);
      asked += cubes.size();
      double open = 0.0;
      for (const Cube& cube : cubes) (cube.slack > 0.0 ? open : decided) += cube.upper;
      for (const Cube& cube : waiting) open += cube.upper;
      const double total = (decided + open) * (1.0 + kOutwards);
      if (total <= enough || asked >= mostCubes) return total;
      for (const Cube& cube : cubes) {
        if (cube.slack > 0.0) waiting.push_back(cube);
      }
      if (waiting.empty()) return total;
      cubes = mostPromising(waiting, mostCubes - asked);
    }
  }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  std::vector<Cube> first() {
    // Of 40 bytes each: what was asked for one integrand is forgotten before it fills the memory.
    constexpr std::size_t kMostKept = 3000000;
    if (places_.size() > kMostKept) places_.clear();
    const Vec3 low = surface_.vertices().colwise().minCoeff();
    const Vec3 high = surface_.vertices().colwise().maxCoeff();
    const double edge = (high - low).maxCoeff() / kFirstAlongASide;
    const Eigen::Array3i counts = ((high - low) / edge).array().ceil().max(1.0).cast<int>();
    std::vector<Cube> cubes;
    for (int i = 0; i < counts.x(); ++i) {
      for (int j = 0; j < counts.y(); ++j) {
        for (int k = 0; k < counts.z(); ++k) {
          cubes.push_back({low + edge * (Vec3(i, j, k) + Vec3::Constant(0.5)), edge,
                           static_cast<int>(cubes.size())});
        }
      }
    }
    if (places_.empty()) places_.resize(cubes.size());
    return cubes;
  }

  /// The parts of the cubes that hold most of the slack, about `mostParts` of them at most.
  std::vector<Cube> mostPromising(std::vector<Cube>& waiting, std::size_t mostParts) {
    constexpr double kMost = 0.9;
    std::sort(waiting.begin(), waiting.end(),
              [](const Cube& a, const Cube& b) { return a.slack < b.slack; });
    double slack = 0.0;
    for (const Cube& cube : waiting) slack += cube.slack;
    std::vector<Cube> parts;
    double taken = 0.0;
    while (!waiting.empty() && taken < kMost * slack && parts.size() < mostParts) {
      divide(waiting.back(), parts);
      taken += waiting.back().slack;
      waiting.pop_back();
    }
    return parts;
  }

  /// Appends the eight parts of a cube whose place is known.
  void divide(const Cube& cube, std::vector<Cube>& parts) {
    if (places_[at(cube.place)].firstPart < 0) {
      Place part;
      part.nearFace = places_[at(cube.place)].nearFace;
      part.isInside = places_[at(cube.place)].isInside;
      part.clearance = places_[at(cube.place)].clearance - halfDiagonal(0.5 * cube.edge);
      places_[at(cube.place)].firstPart = static_cast<int>(places_.size());
      places_.insert(places_.end(), 8, part);
    }
    const int first = places_[at(cube.place)].firstPart;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 step((corner & 1) != 0 ? 0.25 : -0.25, (corner & 2) != 0 ? 0.25 : -0.25,
                      (corner & 4) != 0 ? 0.25 : -0.25);
      parts.push_back({cube.centre + cube.edge * step, 0.5 * cube.edge, first + corner});
    }
  }

  void evaluate(const LayeredQuadric& q, std::vector<Cube>& cubes) {
    constexpr Eigen::Index kChunk = 256;
    forChunks(static_cast<Eigen::Index>(cubes.size()), kChunk, [&](const Chunk& chunk) {
      for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
        evaluate(q, cubes[static_cast<std::size_t>(i)]);
      }
    });
  }

  void evaluate(const LayeredQuadric& quadric, Cube& cube) {
    const Bounds q = boundsOver(quadric, cube);
    if (q.greatest <= 0.0) return;
    Place& place = places_[at(cube.place)];
    if (place.hollow == Place::Hollow::Unknown) lookAt(cube, place);
    if (place.hollow == Place::Hollow::Nothing) return;
    const double volume = cube.edge * cube.edge * cube.edge;
    cube.upper = q.meanOfPositive * volume;
    cube.slack = q.slack * volume;
    if (cube.upper == 0.0 || place.hollow == Place::Hollow::Anything) return;
    if (place.hollow == Place::Hollow::Something) {
      cube.slack = cube.upper;
      return;
    }
    const double wished = cube.upper * place.wished;
    cube.upper = std::min(cube.upper, q.greatest * volume * (place.share + kOutwards));
    cube.slack = place.share > 0.0 ? std::max(cube.upper - wished, kLeastSlack * cube.upper) : 0.0;
  }

  void lookAt(const Cube& cube, Place& place) const {
    const double half = halfDiagonal(cube.edge);
    const double wall = wall_ * (1.0 - kOutwards);
    const double far = wall_ + half;
    place.hollow = Place::Hollow::Anything;
    if (place.isInside && place.clearance > far) return;
    const TriangleTree::Hit hit = surface_.nearest(
        cube.centre, place.isInside ? far * far : std::numeric_limits<double>::infinity(),
        place.nearFace);
    const double distance = std::sqrt(hit.squaredDistance);
    place.clearance = distance * (1.0 - kOutwards);
    if (hit.face < 0) return;
    place.nearFace = hit.face;
    if (!place.isInside && place.clearance > half) {
      place.isInside = inside_.contains(cube.centre, hit);
      if (!place.isInside) place.hollow = Place::Hollow::Nothing;
    }
    if (distance * (1.0 + kOutwards) + half <= wall) place.hollow = Place::Hollow::Nothing;
    if (place.hollow == Place::Hollow::Nothing || place.clearance >= wall + half || distance == 0.0)
      return;
    const Vec3 away = (cube.centre - hit.point) / distance;
    const double gap = witnessGap(cube, hit, away);
    const double depth = gap < wall ? std::sqrt(wall * wall - gap * gap) : -half;
    if (distance + depth <= half) { // beyond the surface the cube may be hollow again
      place.hollow = Place::Hollow::Something;
      return;
    }
    // Nothing within a wall of the witnesses is hollow.
    place.hollow = Place::Hollow::Beyond;
    place.share = shareBeyond(away, depth - distance, cube.edge);
    place.wished = shareBeyond(away, wall - distance, cube.edge);
  }

  /// How far, across the way from the nearest point to the centre, points of the cube can be from
  /// those of the surface that are known to be there: the nearest point's own triangle, if that is
  /// where the way ends, or else that point alone.
  double witnessGap(const Cube& cube, const TriangleTree::Hit& hit, const Vec3& away) const {
    // The corner that is least off the plane across the way is farthest from its foot.
    const Vec3 n = away.cwiseAbs();
    const double least = 0.5 * cube.edge * std::max(0.0, 2.0 * n.maxCoeff() - n.sum());
    const double half = halfDiagonal(cube.edge);
    const double widest = std::sqrt(half * half - least * least);
    const auto corner = [&](int k) {
      return Vec3(surface_.vertices().row(surface_.faces()(hit.face, k % 3)).transpose());
    };
    const Vec3 normal = areaNormal(corner(0), corner(1), corner(2));
    const double size = (corner(1) - corner(0)).norm() * (corner(2) - corner(0)).norm();
    constexpr double kThin = 1e-5;
    constexpr double kParallel = 1e-10; // less than distances are known to
    if (normal.norm() < kThin * size || normal.cross(away).norm() > kParallel * normal.norm()) {
      return widest;
    }
    // From the foot the triangle reaches this share of the way to the cube's farthest points.
    double reach = 1.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 across = normal.cross(corner(k + 1) - corner(k)).normalized();
      const double room = across.dot(hit.point - corner(k));
      reach = std::min(reach, room / (0.5 * cube.edge * across.cwiseAbs().sum()));
    }
    return widest * (1.0 - std::max(0.0, reach));
  }

  const TriangleTree& surface_;
  PointInMesh inside_;
  double wall_;
  std::vector<Place> places_;
};

PositivePartBounds::PositivePartBounds(const TriangleTree& surface, double wall)
    : places_(std::make_unique<Places>(surface, wall)) {}

PositivePartBounds::~PositivePartBounds() = default;

double PositivePartBounds::of(const LayeredQuadric& q, double enough, std::size_t mostCubes) {
  return places_->bound(q, enough, mostCubes);
}

} // namespace massprops
