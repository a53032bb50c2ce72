#include "core/contour/border_lattice.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace massprops {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastValue = 1e-6; // edges; what is less is not inside

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// Whether the marked corners of a cube are connected along its edges, and the others, too.
bool isCutOnce(unsigned marked) {
  for (const unsigned side : {marked, ~marked & 255U}) {
    unsigned reached = side & (~side + 1U);
    for (unsigned before = 0; reached != before;) {
      before = reached;
      for (unsigned i = 0; i < 8; ++i) {
        if ((before >> i & 1U) == 0) continue;
        for (const unsigned step : {1U, 2U, 4U}) reached |= 1U << (i ^ step) & side;
      }
    }
    if (reached != side) return false;
  }
  return true;
}

/// By the corners inside.
const std::array<bool, 256>& cutOnce() {
  static const std::array<bool, 256> table = [] {
    std::array<bool, 256> result{};
    for (unsigned marked = 0; marked < 256; ++marked) result[marked] = isCutOnce(marked);
    return result;
  }();
  return table;
}

bool isMixed(unsigned inside) {
  return inside != 0 && inside != 255;
}

} // namespace

double CornerSamples::value() const {
  if (!isReached) return -kInfinity;
  return std::min({wall ? wall->value : kInfinity, open ? open->value : kInfinity,
                   cut ? cut->value : kInfinity});
}

BorderLattice::BorderLattice(const FeasibleSet& set, const FeasibleRegion& region,
                             const std::optional<QuadricCut>& cut)
    : region_(region), cut_(cut), probe_(set) {
  std::vector<char> isInside(region.corners.size());
  for (std::size_t c = 0; c < isInside.size(); ++c) {
    const RegionCorner& corner = region.corners[c];
    isInside[c] = corner.least(region.edge).value > kLeastValue * region.edge &&
                  isCutInside(region.positionOf(region.placeOf(static_cast<int>(c))));
  }
  for (const std::array<int, 8>& cube : region.border) {
    const auto inside =
        std::count_if(cube.begin(), cube.end(), [&](int c) { return isInside[at(c)] != 0; });
    if (inside != 0 && inside != 8) addCube(region.placeOf(cube[0]), Unknown::Asked);
  }
  if (cut) {
    for (const WholeCube& cube : region.whole) addCutCubes(cube);
  }
  addMissing();
  std::vector<int> all(cubes_.size());
  std::iota(all.begin(), all.end(), 0);
  tame(std::move(all));
}

bool BorderLattice::isCutInside(const Vec3& x) const {
  return !cut_ || cutAt(*cut_, x).value > kLeastValue * region_.edge;
}

CornerSamples BorderLattice::samplesAt(int c) const {
  const LatticeCorner& corner_ = corner(c);
  CornerSamples samples;
  if (cut_) samples.cut = cutAt(*cut_, positionOf(c));
  if (corner_.sample < 0) return samples;
  const RegionCorner& known = region_.corners[at(corner_.sample)];
  samples.wall = Sample{known.wall, known.wallSlope.cast<double>()};
  samples.isReached = known.isReached;
  if (known.isOpenKnown && known.isReached)
    samples.open = Sample{known.open, known.openSlope.cast<double>()};
  return samples;
}

int BorderLattice::cubeAt(const Place& place) const {
  return cubeNumbers_.find(place, [&](int i) { return placeOf(cubes_[at(i)][0]); });
}

int BorderLattice::addCorner(const Place& place, Unknown unknown) {
  const auto placeOfCorner = [&](int i) { return placeOf(i); };
  const int known = cornerNumbers_.find(place, placeOfCorner);
  if (known >= 0) return known;
  cornerNumbers_.add(place, placeOfCorner);
  const Vec3 x = region_.positionOf(place);
  LatticeCorner fresh{{}, isCutInside(x), false, region_.cornerAt(place)};
  for (int k = 0; k < 3; ++k) fresh.place[at(k)] = static_cast<std::int16_t>(place[k]);
  if (fresh.sample >= 0) {
    const double value = region_.corners[at(fresh.sample)].least(region_.edge).value;
    fresh.isInside = fresh.isInside && value > kLeastValue * region_.edge;
  } else if (unknown == Unknown::Asked) {
    fresh.isInside = fresh.isInside && probe_.isBehindWall(x);
  }
  corners_.push_back(fresh);
  return static_cast<int>(corners_.size()) - 1;
}

int BorderLattice::addCube(const Place& place, Unknown unknown) {
  const int known = cubeAt(place);
  if (known >= 0) return known;
  std::array<int, 8> cube{};
  for (int i = 0; i < 8; ++i) cube[at(i)] = addCorner(place + cornerStep(i), unknown);
  cubeNumbers_.add(place, [&](int i) { return placeOf(cubes_[at(i)][0]); });
  cubes_.push_back(cube);
  return static_cast<int>(cubes_.size()) - 1;
}

unsigned BorderLattice::cornersInside(int cube) const {
  unsigned marked = 0;
  for (unsigned i = 0; i < 8; ++i) {
    if (corner(cubes_[at(cube)][i]).isInside) marked |= 1U << i;
  }
  return marked;
}

void BorderLattice::addCutCubes(const WholeCube& cube) {
  const double size = region_.edge * (1 << cube.level);
  const Vec3 middle = region_.positionOf(cube.place) + Vec3::Constant(0.5 * size);
  if (sideOfCut(*cut_, middle, 0.5 * std::sqrt(3.0) * size) != Side::Both) return;
  if (cube.level > 0) {
    for (int i = 0; i < 8; ++i)
      addCutCubes({cube.place + (1 << (cube.level - 1)) * cornerStep(i), cube.level - 1});
    return;
  }
  int inside = 0;
  for (int i = 0; i < 8; ++i) {
    if (isCutInside(region_.positionOf(cube.place + cornerStep(i)))) ++inside;
  }
  if (inside != 0 && inside != 8) addCube(cube.place, Unknown::Inside);
}

/// Beyond sides with corners on both sides of the border: what a ball reaches is found from each
/// corner by itself, so that cubes next to each other may not agree.
void BorderLattice::addMissing() {
  constexpr std::array<unsigned, 3> kLowSide{0x55, 0x33, 0x0f};
  for (int cube = 0; cube < static_cast<int>(cubes_.size()); ++cube) {
    const unsigned inside = cornersInside(cube);
    if (!isMixed(inside)) continue;
    const Place place = placeOf(cubes_[at(cube)][0]);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        const unsigned side = step < 0 ? kLowSide[at(axis)] : ~kLowSide[at(axis)] & 255U;
        if ((inside & side) == 0 || (inside & side) == side) continue;
        addCube(place + step * Place::Unit(axis), Unknown::Asked);
      }
    }
  }
}

/// Of a cube that is cut more than once the least of the corners inside goes out, which may spoil
/// the cubes around. `wild`: cubes to look at.
void BorderLattice::tame(std::vector<int> wild) {
  while (!wild.empty()) {
    const int cube = wild.back();
    wild.pop_back();
    if (cutOnce()[cornersInside(cube)]) continue;
    const auto valueInside = [&](int c) {
      constexpr double kMost = std::numeric_limits<double>::max(); // well behind the walls
      return corner(c).isInside ? std::min(samplesAt(c).value(), kMost) : kInfinity;
    };
    const std::array<int, 8>& corners = cubes_[at(cube)];
    const int least = *std::min_element(corners.begin(), corners.end(), [&](int a, int b) {
      return valueInside(a) < valueInside(b);
    });
    corners_[at(least)].isInside = false;
    const Place place = placeOf(least);
    for (int i = 0; i < 8; ++i) wild.push_back(addCube(place - cornerStep(i), Unknown::Asked));
  }
}

void BorderLattice::takeOut(const std::vector<Vec3>& points) {
  std::vector<int> around;
  for (const Vec3& x : points) {
    const Place place = ((x - region_.origin) / region_.edge).array().floor().cast<int>().matrix();
    for (int i = 0; i < 8; ++i) {
      const int c = addCorner(place + cornerStep(i), Unknown::Asked);
      if (!corner(c).isInside) continue;
      corners_[at(c)].isInside = false;
      corners_[at(c)].isTakenOut = true;
      for (int j = 0; j < 8; ++j)
        around.push_back(addCube(placeOf(c) - cornerStep(j), Unknown::Asked));
    }
  }
  tame(std::move(around));
}

} // namespace massprops
