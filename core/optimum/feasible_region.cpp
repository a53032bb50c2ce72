#include "core/optimum/feasible_region.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/signed_volume.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

namespace massprops {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A room as wide as the ball has place for one that is a little smaller: facets make it narrower.
constexpr double kJustFits = 0.95;
constexpr int kTopLevel = 4; // of the octree's cubes, whose edges are 2^level

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double halfDiagonal(double edge) {
  return 0.5 * std::sqrt(3.0) * edge;
}

/// What is known of a corner before it is asked for: of the depth less the wall.
struct Bounds {
  double atLeast = -kInfinity, atMost = kInfinity;
  bool isReached = false;                 ///< certainly, by the ball
  Sample open{-kInfinity, Vec3::UnitZ()}; ///< reach of the ball at the best place known so far
};

/// The region in one cube of the top level; asks for distances only where those of others do not
/// tell.
class Block {
public:
  Block(const FeasibleSet& set, const Vec3& origin, double edge, Place first)
      : set_(set), origin_(origin), edge_(edge), first_(std::move(first)), probe_(set) {
    visit(first_, kTopLevel, set.ball == 0.0, -kInfinity);
    numbers_.assign(bounds_.size(), -1);
    for (const Place& pair : pairs_) {
      for (int i = 0; i < 8; ++i) addCube(pair + cornerStep(i));
    }
  }

  const std::vector<RegionCorner>& corners() const { return corners_; }
  const std::vector<std::array<int, 8>>& border() const { return border_; }
  const std::vector<WholeCube>& whole() const { return whole_; }

private:
  static constexpr int kAcross = (1 << kTopLevel) + 1; // corners

  std::size_t indexOf(const Place& place) const {
    const Place p = place - first_;
    return at(p.x() + kAcross * (p.y() + kAcross * p.z()));
  }
  Vec3 positionOf(const Place& place) const { return origin_ + edge_ * place.cast<double>(); }

  /// `isReached`: all of the cube, by the ball; `atLeast`: the depth of its middle.
  void visit(const Place& place, int level, bool isReached, double atLeast) {
    const double size = edge_ * (1 << level);
    const double half = halfDiagonal(size);
    const Vec3 middle = positionOf(place) + Vec3::Constant(0.5 * size);
    const double exact = set_.fits() + half;
    const Sample depth = probe_.depthAt(middle, exact, atLeast > 0.0);
    if (depth.value + half <= set_.wall) return;
    if (bounds_.empty()) bounds_.resize(at(kAcross * kAcross * kAcross));
    const double least =
        depth.value <= exact ? depth.value : std::max(exact, depth.value / TriangleTree::kSlack);
    std::optional<Vec3> ball; // its middle
    if (!isReached && half <= set_.reach() && depth.value > 0.0) {
      ball = probe_.placeNear(middle, depth);
      isReached = ball && (*ball - middle).norm() + half <= set_.reach();
    }
    if (least - half >= (isReached ? set_.wall : set_.fits())) {
      whole_.push_back({place, level});
      markReached(place, level);
      return;
    }
    if (level == 1) {
      pairs_.push_back(place);
      takeBounds(place, middle, depth, least, isReached);
      if (ball) takeBall(place, *ball);
      return;
    }
    for (int i = 0; i < 8; ++i)
      visit(place + (1 << (level - 1)) * cornerStep(i), level - 1, isReached, least - 0.5 * half);
  }

  /// All corners of a cube.
  void markReached(const Place& place, int level) {
    const int across = (1 << level) + 1;
    for (int k = 0; k < across; ++k) {
      for (int j = 0; j < across; ++j) {
        for (int i = 0; i < across; ++i) bounds_[indexOf(place + Place(i, j, k))].isReached = true;
      }
    }
  }

  /// What the middle of a cube of two edges tells of its corners.
  void takeBounds(const Place& place, const Vec3& middle, const Sample& depth, double least,
                  bool isReached) {
    const bool isInside = depth.value > 0.0;
    const Vec3 onSurface = middle - depth.value * depth.slope;
    for (int i = 0; i < 27; ++i) {
      const Place p = place + Place(i % 3, i / 3 % 3, i / 9);
      Bounds& bounds = bounds_[indexOf(p)];
      bounds.isReached = bounds.isReached || isReached;
      const Vec3 x = positionOf(p);
      const double away = (x - middle).norm();
      bounds.atLeast = std::max(bounds.atLeast, least - away - set_.wall);
      bounds.atMost = std::min(bounds.atMost, depth.value + away - set_.wall);
      if (isInside) bounds.atMost = std::min(bounds.atMost, (x - onSurface).norm() - set_.wall);
    }
  }

  /// What a place of the ball's middle tells of the corners of a cube of two edges.
  void takeBall(const Place& place, const Vec3& ball) {
    for (int i = 0; i < 27; ++i) {
      const Place p = place + Place(i % 3, i / 3 % 3, i / 9);
      Bounds& bounds = bounds_[indexOf(p)];
      const Vec3 way = ball - positionOf(p);
      const double open = set_.reach() - way.norm();
      if (open > bounds.open.value) bounds.open = {open, way.normalized()};
    }
  }

  bool isBehindWall(const Place& place) {
    const Bounds& bounds = bounds_[indexOf(place)];
    if (bounds.atMost <= 0.0) return false;
    return bounds.atLeast > 0.0 || corner(place).wall > 0.0F;
  }

  /// \pre it is behind the wall
  bool isReached(const Place& place) {
    const Bounds& bounds = bounds_[indexOf(place)];
    return bounds.isReached || bounds.open.value > 0.0 ||
           bounds.atLeast + set_.wall >= set_.fits() || corner(place).isReached;
  }

  /// Asked for once.
  RegionCorner& corner(const Place& place) {
    int& number = numbers_[indexOf(place)];
    if (number >= 0) return corners_[at(number)];
    number = static_cast<int>(corners_.size());
    const Bounds& bounds = bounds_[indexOf(place)];
    const Vec3 x = positionOf(place);
    const Sample depth = probe_.depthAt(x, set_.fits() + edge_, bounds.atLeast + set_.wall > 0.0);
    RegionCorner corner;
    for (int k = 0; k < 3; ++k) corner.place[at(k)] = static_cast<std::int16_t>(place[k]);
    corner.wall = static_cast<float>(depth.value - set_.wall);
    corner.wallSlope = depth.slope.cast<float>();
    corner.open = corner.wall;
    corner.openSlope = corner.wallSlope;
    corner.isOpenKnown = !bounds.isReached && depth.value > set_.wall && depth.value < set_.fits();
    if (corner.isOpenKnown) {
      Sample open = bounds.open;
      const std::optional<Vec3> ball = open.value > 0.0 ? std::nullopt : probe_.placeNear(x, depth);
      if (ball) open = {set_.reach() - (*ball - x).norm(), (*ball - x).normalized()};
      corner.isReached = open.value > 0.0;
      corner.open = static_cast<float>(open.value);
      corner.openSlope = open.slope.cast<float>();
    }
    corners_.push_back(corner);
    return corners_.back();
  }

  void addCube(const Place& place) {
    int behind = 0;
    int inside = 0;
    for (int i = 0; i < 8; ++i) {
      const Place p = place + cornerStep(i);
      if (!isBehindWall(p)) continue;
      ++behind;
      if (isReached(p)) ++inside;
    }
    if (behind == 0) return;
    if (inside == 8) {
      whole_.push_back({place, 0});
      return;
    }
    std::array<int, 8> cube{};
    for (int i = 0; i < 8; ++i) {
      corner(place + cornerStep(i));
      cube[at(i)] = numbers_[indexOf(place + cornerStep(i))];
    }
    border_.push_back(cube);
  }

  const FeasibleSet& set_;
  const Vec3& origin_;
  double edge_;
  Place first_;
  RegionProbe probe_;
  std::vector<Bounds> bounds_; ///< of all corners
  std::vector<int> numbers_;   ///< of those that were asked for; −1: not
  std::vector<Place> pairs_;   ///< cubes of two edges that the border may pass through
  std::vector<RegionCorner> corners_;
  std::vector<std::array<int, 8>> border_;
  std::vector<WholeCube> whole_;
};

/// Puts blocks together, each corner once.
class Assembly {
public:
  explicit Assembly(FeasibleRegion& region) : region_(region) {}

  void add(const Block& block) {
    numbers_.assign(block.corners().size(), -1);
    for (std::array<int, 8> cube : block.border()) {
      for (int& c : cube) c = numberOf(block.corners()[at(c)], numbers_[at(c)]);
      region_.border.push_back(cube);
    }
    region_.whole.insert(region_.whole.end(), block.whole().begin(), block.whole().end());
  }

private:
  int numberOf(const RegionCorner& corner, int& number) {
    if (number >= 0) return number;
    const Place place(corner.place[0], corner.place[1], corner.place[2]);
    const auto placeOf = [&](int i) { return region_.placeOf(i); };
    number = region_.cornerNumbers.find(place, placeOf);
    if (number < 0) {
      region_.cornerNumbers.add(place, placeOf);
      number = static_cast<int>(region_.corners.size());
      region_.corners.push_back(corner);
    } else if (!corner.isOpenKnown) {
      region_.corners[at(number)] = corner; // certainly reached
    }
    return number;
  }

  FeasibleRegion& region_;
  std::vector<int> numbers_; ///< of the block's corners
};

/// About the area of the border: a surface of area A passes through 1.5 A/h² cubes of edge h.
constexpr double kCubesPerArea = 1.5;

} // namespace

double FeasibleSet::fits() const {
  return wall + kJustFits * 0.5 * ball;
}

RegionProbe::RegionProbe(const FeasibleSet& set) : set_(set), inside_(set.surface) {}

Sample RegionProbe::depthAt(const Vec3& x, double exact, bool isInside) {
  nearest_ = set_.surface.nearest(x, kInfinity, nearest_.face, exact * exact);
  // Only the very nearest face tells the side.
  if (!isInside)
    isInside = inside_.contains(x, nearest_.squaredDistance > exact * exact
                                       ? set_.surface.nearest(x, kInfinity, nearest_.face)
                                       : nearest_);
  const TriangleTree::Hit clear = set_.surface.clearance(x, nearest_);
  const double sign = isInside ? 1.0 : -1.0;
  const double distance = std::sqrt(clear.squaredDistance);
  return {sign * distance, sign * (x - clear.point) / std::max(distance, 1e-300)};
}

double RegionProbe::insetAt(const Vec3& x, double horizon) {
  const Sample depth = depthAt(x, set_.fits() + horizon);
  const double inset = std::max(depth.value - set_.wall, -horizon);
  if (inset <= 0.0 || depth.value >= set_.fits()) return inset;
  const std::optional<Vec3> place = placeNear(x, depth);
  return place ? std::min(inset, set_.reach() - (*place - x).norm()) : -horizon;
}

std::optional<Vec3> RegionProbe::placeNear(const Vec3& x, const Sample& depth) {
  return placeNear(x, depth, set_.fits(), set_.reach());
}

std::optional<Vec3> RegionProbe::placeNear(const Vec3& x, Sample depth, double fits, double reach) {
  constexpr int kSteps = 4; // a right-angled corner takes three
  constexpr double kNearly = 1.0 - 1e-6;
  Vec3 place = x;
  for (int step = 0; step < kSteps && depth.value < kNearly * fits; ++step) {
    const double missing = fits - depth.value;
    place += missing * depth.slope;
    if ((place - x).squaredNorm() > reach * reach) return {};
    depth = depthAt(place, fits, missing < depth.value);
  }
  return depth.value >= kNearly * fits ? std::optional(place) : std::nullopt;
}

FeasibleRegion feasibleRegion(const FeasibleSet& set, double edge) {
  FeasibleRegion region;
  region.origin = set.surface.lower();
  region.edge = edge;
  region.extent = set.surface.upper() - region.origin;
  const Vec3& extent = region.extent;
  constexpr double kMostAcross = 32000.0; // what a corner's place can hold
  if (!(extent.maxCoeff() < kMostAcross * edge))
    throw std::invalid_argument("cubes of this edge are too many: take larger ones");
  constexpr int kAcross = 1 << kTopLevel;
  const Eigen::Array<Eigen::Index, 3, 1> counts =
      (extent / (kAcross * edge)).array().ceil().max(1.0).cast<Eigen::Index>();
  Assembly assembly(region);
  constexpr Eigen::Index kAtOnce = 64; // blocks, so that not all of them are kept
  for (Eigen::Index begin = 0; begin < counts.prod(); begin += kAtOnce) {
    std::vector<std::optional<Block>> blocks(
        static_cast<std::size_t>(std::min(kAtOnce, counts.prod() - begin)));
    forChunks(static_cast<Eigen::Index>(blocks.size()), 1, [&](const Chunk& chunk) {
      const Eigen::Index n = begin + chunk.number;
      const Place place =
          Eigen::Matrix<Eigen::Index, 3, 1>(n % counts.x(), n / counts.x() % counts.y(),
                                            n / (counts.x() * counts.y()))
              .cast<int>();
      blocks[static_cast<std::size_t>(chunk.number)].emplace(set, region.origin, edge,
                                                             kAcross * place);
    });
    for (const std::optional<Block>& block : blocks) assembly.add(*block);
  }
  return region;
}

double edgeFor(const FeasibleSet& set) {
  constexpr double kCubes = 12000.0; // on the surface: these leave about a per cent
  constexpr double kMost = 60000.0;  // half a second's worth
  constexpr double kAcross = 3.0;    // of a room: a node at least lies well inside of it
  constexpr double kFinest = 8.0;    // of the ball: finer ones lose nothing that counts
  const Points& vertices = set.surface.vertices();
  const Faces& faces = set.surface.faces();
  const double area = surfaceArea(vertices, faces);
  // A body of area A and volume V is about 2V/A thick.
  const double room =
      std::max(2.0 * signedVolume(vertices, faces) / area - 2.0 * set.wall, set.ball);
  const auto edgeOf = [&](double cubes) { return std::sqrt(kCubesPerArea * area / cubes); };
  return std::max({std::min(edgeOf(kCubes), room / kAcross), edgeOf(kMost), set.ball / kFinest});
}

double wallWithRoomFor(double radius) {
  return radius / (1.0 + 0.5 * kJustFits);
}

FeasibleRegion within(const GridFunction& function, const FeasibleRegion& region) {
  FeasibleRegion result = region;
  result.whole.clear();
  // Corners of cubes that were whole lie well behind the walls.
  const auto addCorner = [&](const Place& place) {
    const int known = result.cornerAt(place);
    if (known >= 0) return known;
    result.cornerNumbers.add(place, [&](int i) { return result.placeOf(i); });
    RegionCorner corner;
    for (int k = 0; k < 3; ++k) corner.place[at(k)] = static_cast<std::int16_t>(place[k]);
    corner.wall = std::numeric_limits<float>::max();
    corner.wallSlope = Eigen::Vector3f::UnitZ();
    result.corners.push_back(corner);
    return static_cast<int>(result.corners.size()) - 1;
  };
  const std::function<void(const WholeCube&)> visit = [&](const WholeCube& cube) {
    const double size = region.edge * (1 << cube.level);
    const Vec3 middle = region.positionOf(cube.place) + Vec3::Constant(0.5 * size);
    const double value = function.at(middle).value;
    if (value >= halfDiagonal(size) || cube.level == 0) {
      if (value >= halfDiagonal(size)) {
        result.whole.push_back(cube);
        return;
      }
      std::array<int, 8> corners{};
      for (int i = 0; i < 8; ++i) corners[at(i)] = addCorner(cube.place + cornerStep(i));
      result.border.push_back(corners);
      return;
    }
    for (int i = 0; i < 8; ++i)
      visit({cube.place + (1 << (cube.level - 1)) * cornerStep(i), cube.level - 1});
  };
  for (const WholeCube& cube : region.whole) visit(cube);
  for (std::size_t c = 0; c < result.corners.size(); ++c) {
    RegionCorner& corner = result.corners[c];
    const Sample left = function.at(result.positionOf(result.placeOf(static_cast<int>(c))));
    if (!corner.isReached || (corner.isOpenKnown && corner.open <= left.value)) continue;
    corner.isOpenKnown = true;
    corner.open = static_cast<float>(left.value);
    corner.openSlope = left.slope.cast<float>();
  }
  return result;
}

} // namespace massprops
