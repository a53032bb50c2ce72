#include "core/contour/border_lattice.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace massprops {
namespace {

Place cornerStep(int i) {
  return {i & 1, i >> 1 & 1, i >> 2};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How far a value may be off.
double uncertainty(const Region& region, double value) {
  return region.surface.slightSlack() * std::abs(value + region.wall);
}

/// A cube of twice the edge that the border may pass through.
struct Block {
  Place place;
  /// In its middle, of what the walls leave. Empty: it is so far behind them that only the quadric
  /// matters.
  std::optional<Sample> middle;
  bool isOfSurface = false; ///< see `InsetProbe`
};

/// Halves cubes that the border may pass through.
class BorderSearch {
public:
  static constexpr int kTopLevel = 4;

  BorderSearch(const Region& region, Vec3 origin, double edge, InsetProbe& probe)
      : region_(region), probe_(probe), origin_(std::move(origin)), edge_(edge) {}

  const std::vector<Block>& found() const { return found_; }

  /// `atLeast`: of its middle, as far as that is known.
  void visit(const Place& place, int level, bool isDeep, double atLeast) {
    const double size = edge_ * (1 << level);
    const double radius = 0.5 * std::sqrt(3.0) * size;
    const Vec3 centre = origin_ + edge_ * place.cast<double>() + Vec3::Constant(0.5 * size);
    Block block{place, {}};
    if (!isDeep) {
      constexpr int kLarge = 3; // from most of their middles no place of the ball is found
      const bool isInside = atLeast > -region_.wall;
      block.middle = level >= kLarge ? probe_.roughlyAt(centre, radius, isInside)
                                     : probe_.at(centre, radius, isInside);
      block.isOfSurface = probe_.isOfSurface();
      const double value = block.middle->value;
      const double sure = radius + uncertainty(region_, value);
      const bool isInDoubt = probe_.isInDoubt() && level > 1; // next to small ones nodes tell
      if (value <= -sure && !isInDoubt) return;
      isDeep = value >= sure;
      atLeast = value - sure + 0.5 * radius; // in the middles of its parts
    }
    const Side side = region_.quadric ? sideOfCut(region_, centre, radius) : Side::Positive;
    if (side == Side::Negative || (isDeep && side == Side::Positive)) return;
    if (level == 1) {
      if (isDeep) block.middle.reset();
      found_.push_back(std::move(block));
      return;
    }
    for (int i = 0; i < 8; ++i)
      visit(place + (1 << (level - 1)) * cornerStep(i), level - 1, isDeep, atLeast);
  }

private:
  const Region& region_;
  InsetProbe& probe_;
  Vec3 origin_;
  double edge_;
  std::vector<Block> found_;
};

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

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

constexpr double kLeastValue = 1e-6; // edges; what is less is not inside

/// Two surfaces at an acute angle are kept apart: their triangles would cross each other where the
/// region between them ends. The more acute, the wider apart.
std::optional<Sample> chamfer(const Sample& inset, const Sample& cut, double edge) {
  constexpr double kBegins = -0.5; // cosine between the slopes
  constexpr double kWhole = -0.9;
  constexpr double kApart = 0.4; // edges
  const double cosine = inset.slope.dot(cut.slope);
  const Vec3 slope = inset.slope + cut.slope;
  const double steepness = slope.norm();
  if (cosine > kBegins || steepness < 1e-9) return {};
  const double apart = kApart * edge * std::min((cosine - kBegins) / (kWhole - kBegins), 1.0);
  return Sample{(inset.value + cut.value - apart) / steepness, slope / steepness};
}

CornerSamples samplesOf(const Corner& corner, const std::optional<Sample>& cut, double edge) {
  CornerSamples samples{corner.inset(), cut, {}};
  if (corner.mayBeChamfered && samples.inset && cut)
    samples.chamfer = chamfer(*samples.inset, *cut, edge);
  return samples;
}

void sampleCorner(InsetProbe& probe, int c, BorderLattice& lattice) {
  Corner& corner = lattice.corners[at(c)];
  const Vec3 x = lattice.positionOf(c);
  corner.setInset(probe.at(x, 2.0 * lattice.edge));
  corner.mayBeChamfered = true;
  corner.isInside = lattice.samplesAt(c).value() > kLeastValue * lattice.edge;
}

/// What is known of what the walls leave at a corner without asking there: it changes by no more
/// than one moves, and it is no more than the distance from any point of the surface.
struct Bounds {
  double atLeast = -kInfinity;
  double atMost = kInfinity;
  bool isNearWall = false; ///< else only the quadric matters
};

/// The cubes of a part of the lattice that the border passes through; asks for distances only
/// where those of others do not tell.
class PartOfLattice {
public:
  PartOfLattice(const Region& region, const Vec3& origin, double edge, const Place& first)
      : region_(region), origin_(origin), edge_(edge), first_(first),
        probe_(region, region.surface.slightSlack()),
        numbers_(at(kAcross * kAcross * kAcross), -1) {
    BorderSearch search(region, origin, edge, probe_);
    search.visit(first, BorderSearch::kTopLevel, false, -kInfinity);
    for (const Block& block : search.found()) add(block);
    for (std::size_t c = 0; c < corners_.size(); ++c) findSide(c);
    for (const Block& block : search.found()) addCubes(block.place);
    sampleCrossed();
    forgetOthers();
  }

  void addTo(BorderLattice& lattice) const {
    for (const Place& place : cubes_) {
      const auto known = static_cast<int>(lattice.corners.size());
      const int cube = lattice.addCube(place);
      for (int i = 0; i < 8; ++i) {
        const int c = lattice.cubes[at(cube)][at(i)];
        const Corner& corner = corners_[numberOf(place + cornerStep(i))];
        if (c >= known) lattice.corners[at(c)] = corner;
        // Where parts meet each has asked for what it needs itself.
        const std::optional<Sample> inset = corner.inset();
        if (inset && !lattice.corners[at(c)].hasInset()) lattice.corners[at(c)].setInset(*inset);
      }
    }
  }

private:
  static constexpr int kAcross = (1 << BorderSearch::kTopLevel) + 1; // corners

  std::size_t placeOf(const Place& place) const {
    const Place p = place - first_;
    return at(p.x() + kAcross * (p.y() + kAcross * p.z()));
  }
  std::size_t numberOf(const Place& place) const { return at(numbers_[placeOf(place)]); }
  Vec3 positionOf(const Place& place) const { return origin_ + edge_ * place.cast<double>(); }

  /// Its corners, and what its middle tells of them.
  void add(const Block& block) {
    constexpr int kSide = 3;
    const Vec3 centre = positionOf(block.place + Place::Ones());
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const Place step(i % kSide, i / kSide % kSide, i / (kSide * kSide));
      const Place place = block.place + step;
      int& number = numbers_[placeOf(place)];
      if (number < 0) {
        number = static_cast<int>(corners_.size());
        corners_.emplace_back(place);
        bounds_.emplace_back();
      }
      if (!block.middle) continue;
      Bounds& bounds = bounds_[at(number)];
      bounds.isNearWall = true;
      const Sample& middle = *block.middle;
      if (step == Place::Ones()) corners_[at(number)].setInset(middle);
      const Vec3 x = positionOf(place);
      const double away = (x - centre).norm() + uncertainty(region_, middle.value);
      bounds.atLeast = std::max(bounds.atLeast, middle.value - away);
      bounds.atMost = std::min(bounds.atMost, middle.value + away);
      if (!block.isOfSurface) continue;
      const Vec3 onSurface = centre - (middle.value + region_.wall) * middle.slope;
      bounds.atMost = std::min(bounds.atMost, (x - onSurface).norm() - region_.wall);
    }
  }

  bool isFarBehind(std::size_t c) const {
    return !bounds_[c].isNearWall || bounds_[c].atLeast >= edge_;
  }

  void findSide(std::size_t c) {
    Corner& corner = corners_[c];
    const double least = kLeastValue * edge_;
    constexpr double kFar = 2.0; // edges: no other surface comes near enough for a chamfer
    const Vec3 x = positionOf(corner.place());
    std::optional<Sample> cut;
    if (region_.quadric) cut = cutAt(region_, x);
    const bool isNearCut = cut && std::abs(cut->value) < kFar * edge_;
    const Bounds& bounds = bounds_[c];
    corner.isInside = (!cut || cut->value > least) && bounds.atMost > 0.0;
    if (!corner.isInside || isFarBehind(c)) return;
    if (!corner.hasInset() && (isNearCut || bounds.atLeast <= least))
      corner.setInset(probe_.at(x, kFar * edge_, bounds.atLeast > -region_.wall));
    corner.mayBeChamfered = corner.hasInset();
    corner.isInside = samplesOf(corner, cut, edge_).value() > least;
  }

  /// Those of a block.
  void addCubes(const Place& block) {
    for (int i = 0; i < 8; ++i) {
      const Place place = block + cornerStep(i);
      unsigned inside = 0;
      for (int k = 0; k < 8; ++k) {
        if (corners_[numberOf(place + cornerStep(k))].isInside) inside |= 1U << k;
      }
      if (inside != 0 && inside != 255) cubes_.push_back(place);
    }
  }

  /// At both ends of the edges that the border crosses.
  void sampleCrossed() {
    std::vector<char> isCrossed(corners_.size(), 0);
    for (const Place& place : cubes_) {
      for (int i = 0; i < 8; ++i) {
        const std::size_t a = numberOf(place + cornerStep(i));
        for (const int step : {1, 2, 4}) {
          const std::size_t b = numberOf(place + cornerStep(i ^ step));
          if (corners_[a].isInside != corners_[b].isInside) isCrossed[a] = isCrossed[b] = 1;
        }
      }
    }
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (isCrossed[c] == 0 || corners_[c].hasInset() || isFarBehind(c)) continue;
      corners_[c].setInset(probe_.at(positionOf(corners_[c].place()), 2.0 * edge_,
                                     bounds_[c].atLeast > -region_.wall));
    }
  }

  /// Most corners are of no cube that the border passes through.
  void forgetOthers() {
    std::vector<int> numbers(numbers_.size(), -1);
    std::vector<Corner> corners;
    for (const Place& place : cubes_) {
      for (int i = 0; i < 8; ++i) {
        int& number = numbers[placeOf(place + cornerStep(i))];
        if (number >= 0) continue;
        number = static_cast<int>(corners.size());
        corners.push_back(corners_[numberOf(place + cornerStep(i))]);
      }
    }
    corners.shrink_to_fit();
    corners_.swap(corners);
    numbers_.swap(numbers);
    std::vector<Bounds>().swap(bounds_);
  }

  const Region& region_;
  Vec3 origin_;
  double edge_;
  Place first_;
  InsetProbe probe_;
  std::vector<int> numbers_; ///< of the corners at all places; −1: not asked for
  std::vector<Corner> corners_;
  std::vector<Bounds> bounds_; ///< of the corners
  std::vector<Place> cubes_;
};

/// All cubes that the border passes through.
void addCrossed(const Region& region, const Vec3& extent, BorderLattice& lattice) {
  constexpr int kAcross = 1 << BorderSearch::kTopLevel;
  constexpr Eigen::Index kAtOnce = 64; // so that not all of them are kept
  const Place counts = (extent / (kAcross * lattice.edge)).array().ceil().max(1.0).cast<int>();
  const Eigen::Index all = counts.prod();
  for (Eigen::Index begin = 0; begin < all; begin += kAtOnce) {
    std::vector<std::optional<PartOfLattice>> parts(
        static_cast<std::size_t>(std::min(kAtOnce, all - begin)));
    forChunks(static_cast<Eigen::Index>(parts.size()), 1, [&](const Chunk& chunk) {
      const auto n = static_cast<int>(begin + chunk.number);
      const Place place(n % counts.x(), n / counts.x() % counts.y(), n / (counts.x() * counts.y()));
      parts[static_cast<std::size_t>(chunk.number)].emplace(region, lattice.origin, lattice.edge,
                                                            kAcross * place);
    });
    for (const auto& part : parts) part->addTo(lattice);
  }
}

/// Adds the cubes beyond sides with corners on both sides of the border that are not there: the
/// search for cubes takes surfaces for smoother than rounded distances are.
void addMissing(const Region& region, BorderLattice& lattice) {
  InsetProbe probe(region, region.surface.slightSlack());
  for (int cube = 0; cube < static_cast<int>(lattice.cubes.size()); ++cube) {
    const unsigned inside = lattice.cornersInside(cube);
    if (inside == 0 || inside == 255) continue;
    const Place place = lattice.corners[at(lattice.cubes[at(cube)][0])].place();
    for (int axis = 0; axis < 3; ++axis) {
      constexpr std::array<unsigned, 3> kLowSide{0x55, 0x33, 0x0f};
      for (const int step : {-1, 1}) {
        const unsigned side = step < 0 ? kLowSide[at(axis)] : ~kLowSide[at(axis)] & 255U;
        if ((inside & side) == 0 || (inside & side) == side) continue;
        const Place other = place + step * Place::Unit(axis);
        if (lattice.cubeAt(other) >= 0) continue;
        const auto known = static_cast<int>(lattice.corners.size());
        lattice.addCube(other);
        for (int c = known; c < static_cast<int>(lattice.corners.size()); ++c) {
          sampleCorner(probe, c, lattice);
        }
      }
    }
  }
}

/// Of a cube that is cut more than once the least of the corners inside goes out, which may spoil
/// the cubes around. `wild`: cubes to look at.
void tame(std::vector<int> wild, BorderLattice& lattice) {
  constexpr double kWell = 0.25; // edges
  while (!wild.empty()) {
    const int cube = wild.back();
    wild.pop_back();
    if (cutOnce()[lattice.cornersInside(cube)]) continue;
    const auto valueInside = [&](int i) {
      const Corner& corner = lattice.corners[at(i)];
      return corner.isInside ? lattice.samplesAt(i).value() : kInfinity;
    };
    const auto& corners = lattice.cubes[at(cube)];
    const int c = *std::min_element(corners.begin(), corners.end(),
                                    [&](int a, int b) { return valueInside(a) < valueInside(b); });
    if (valueInside(c) > kWell * lattice.edge) ++lattice.unresolved;
    Corner& least = lattice.corners[at(c)];
    least.isInside = false;
    const Place place = least.place();
    for (int i = 0; i < 8; ++i) {
      wild.push_back(lattice.addCube(place - cornerStep(i)));
    }
  }
}

} // namespace

std::size_t PlaceNumbers::hash(const Place& place) {
  const auto part = [](int i) { return static_cast<std::size_t>(static_cast<unsigned>(i)); };
  // MurmurHash3's finalizer, whose last digits depend on all.
  std::size_t hash = part(place.x()) << 42 ^ part(place.y()) << 21 ^ part(place.z());
  hash ^= hash >> 33;
  hash *= 0xff51afd7ed558ccdULL;
  hash ^= hash >> 33;
  hash *= 0xc4ceb9fe1a85ec53ULL;
  return hash ^ hash >> 33;
}

double CornerSamples::value() const {
  constexpr double kFar = std::numeric_limits<double>::max();
  return std::min(
      {inset ? inset->value : kFar, cut ? cut->value : kFar, chamfer ? chamfer->value : kFar});
}

CornerSamples BorderLattice::samplesAt(int corner) const {
  std::optional<Sample> cut;
  if (quadric) cut = cutAt(*quadric, transition, positionOf(corner));
  return samplesOf(corners[static_cast<std::size_t>(corner)], cut, edge);
}

int BorderLattice::cubeAt(const Place& place) const {
  return cubeNumbers_.find(place, [&](int i) { return placeOfCube(i); });
}

int BorderLattice::cornerAt(const Place& place) const {
  return cornerNumbers_.find(place, [&](int i) { return placeOfCorner(i); });
}

int BorderLattice::addCorner(const Place& place) {
  const int known = cornerAt(place);
  if (known >= 0) return known;
  cornerNumbers_.add(place, [&](int i) { return placeOfCorner(i); });
  corners.emplace_back(place);
  return static_cast<int>(corners.size()) - 1;
}

int BorderLattice::addCube(const Place& place) {
  const int known = cubeAt(place);
  if (known >= 0) return known;
  std::array<int, 8> cube{};
  for (int i = 0; i < 8; ++i) cube[at(i)] = addCorner(place + cornerStep(i));
  cubeNumbers_.add(place, [&](int i) { return placeOfCube(i); });
  cubes.push_back(cube);
  return static_cast<int>(cubes.size()) - 1;
}

unsigned BorderLattice::cornersInside(int cube) const {
  unsigned marked = 0;
  const auto& corners_ = cubes[static_cast<std::size_t>(cube)];
  for (unsigned i = 0; i < 8; ++i) {
    if (corners[static_cast<std::size_t>(corners_[i])].isInside) marked |= 1U << i;
  }
  return marked;
}

BorderLattice borderLattice(const Region& region, double edge) {
  BorderLattice lattice;
  lattice.origin = region.surface.vertices().colwise().minCoeff().transpose();
  lattice.edge = edge;
  lattice.quadric = region.quadric;
  lattice.transition = region.transition;
  const Vec3 high = region.surface.vertices().colwise().maxCoeff().transpose();
  constexpr double kMostAcross = 32000.0; // what a corner's place can hold
  if (!((high - lattice.origin).maxCoeff() < kMostAcross * edge))
    throw std::invalid_argument("cubes of this edge are too many: take larger ones");
  addCrossed(region, high - lattice.origin, lattice);
  addMissing(region, lattice);
  std::vector<int> all(lattice.cubes.size());
  std::iota(all.begin(), all.end(), 0);
  tame(std::move(all), lattice);
  return lattice;
}

void takeOut(const std::vector<Vec3>& points, BorderLattice& lattice) {
  std::vector<int> around;
  for (const Vec3& x : points) {
    const Place place = ((x - lattice.origin) / lattice.edge).array().floor().cast<int>().matrix();
    for (int i = 0; i < 8; ++i) {
      const int c = lattice.cornerAt(place + cornerStep(i));
      if (c < 0 || !lattice.corners[at(c)].isInside) continue;
      lattice.corners[at(c)].isInside = false;
      lattice.corners[at(c)].isTakenOut = true;
      for (int j = 0; j < 8; ++j) {
        around.push_back(lattice.addCube(lattice.corners[at(c)].place() - cornerStep(j)));
      }
    }
  }
  tame(std::move(around), lattice);
}

} // namespace massprops
