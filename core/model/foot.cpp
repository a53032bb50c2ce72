#include "core/model/foot.h"

#include "core/base/tolerances.h"
#include "core/mesh/components.h"
#include "core/mesh/plane_cut.h"
#include "core/mesh/signed_volume.h"
#include "core/model/frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Of the height: nobody misses it.
constexpr double kDeepest = 0.01;
/// A cut may be so much deeper than wanted, to keep off vertices.
constexpr double kSlack = 0.05;

/// The model with up as +z, which is exact.
struct Upright {
  Mat3 rotation;
  Points vertices;
  double ground, height;

  Upright(const Solid& solid, const Options& options)
      : rotation(rotationToUp(options.upAxis)), vertices(solid.vertices() * rotation.transpose()),
        ground(vertices.col(2).minCoeff()), height(vertices.col(2).maxCoeff() - ground) {}
};

/// Below the openings of an open surface, above the ground.
double roomBelow(const Solid& solid, const Upright& upright) {
  double room = upright.height;
  for (const int v : solid.rim()) room = std::min(room, upright.vertices(v, 2) - upright.ground);
  return room - kContactHeight * solid.diagonal();
}

/// The least depth for which the contact holds the circle, or else the one for which it holds the
/// largest; within `most`.
double bestDepth(const LowestPart& lowest, double least, double most, double radius) {
  constexpr int kSteps = 64;
  constexpr int kHalvings = 8;
  const auto suffices = [&](double depth) {
    return holdsCircle(lowest.contactAt(depth).area, radius);
  };
  double largest = -1.0;
  double best = most;
  double before = least;
  for (int i = 0; i <= kSteps; ++i) {
    const double depth = least + (most - least) * i / kSteps;
    if (suffices(depth)) {
      double high = depth;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (before + high);
        (suffices(middle) ? high : before) = middle;
      }
      return high;
    }
    const double circle = inradius(lowest.contactAt(depth).area);
    if (circle > largest) {
      largest = circle;
      best = depth;
    }
    before = depth;
  }
  return best;
}

struct Pieces {
  std::size_t bodies = 0, crumbs = 0;
};

Pieces piecesOf(const Solid& solid) {
  constexpr double kCrumb = 1e-3; // of the volume
  const double whole = signedVolume(solid.vertices(), solid.faces());
  Pieces pieces;
  for (const Faces& part : connectedComponents(solid.vertices().rows(), solid.faces())) {
    const bool isCrumb = signedVolume(solid.vertices(), part) < kCrumb * whole;
    ++(isCrumb ? pieces.crumbs : pieces.bodies);
  }
  return pieces;
}

/// Crumbs of a mended model may; a body may not even lose one.
bool fallsApart(const Pieces& before, const Pieces& after) {
  return after.bodies > before.bodies || after.crumbs > 2 * before.crumbs;
}

/// Existing cavities that the cut does not open, and how many it does.
struct Uncut {
  TriangleMesh cavities;
  int opened = 0;
};

Uncut uncutCavities(const Solid& solid, const Upright& upright, double level) {
  const TriangleMesh& all = solid.cavities();
  Uncut result;
  std::vector<TriangleMesh> kept;
  for (Submesh& cavity : componentMeshes(all.vertices, all.faces)) {
    const Points turned = cavity.mesh.vertices * upright.rotation.transpose();
    if (turned.col(2).minCoeff() > level) {
      kept.push_back(std::move(cavity.mesh));
    } else {
      ++result.opened;
    }
  }
  result.cavities = assembled(kept);
  return result;
}

/// Empty where the cut surface bounds no solid, falls into more pieces, or has another foot than
/// the plane cuts out.
std::optional<Footing> cutBy(double depth, double merged, const Solid& solid,
                             const Upright& upright, const GroundContact& expected,
                             const Options& options) {
  const auto rounded = [&](const Points& points) {
    if (!options.representable) return points;
    return Points(options.representable(points * upright.rotation) * upright.rotation.transpose());
  };
  std::optional<PlaneCut> cut =
      cutAbove(upright.vertices, solid.skin(), upright.ground + depth, merged, rounded);
  if (!cut) return std::nullopt;
  // A large model's copies are not to pile up.
  TriangleMesh rest = std::move(cut->mesh);
  rest.vertices = rest.vertices * upright.rotation;
  const Uncut uncut = uncutCavities(solid, upright, upright.ground + depth);
  if (uncut.cavities.faces.rows() > 0) rest = assembled({rest, uncut.cavities});
  Repairs before = solid.repairs();
  before.replacedCavities = uncut.opened; // to which the others are added
  try {
    Footing result{withoutCrossings(makeSolid(std::move(rest), !solid.isLid().empty(),
                                              upright.rotation, before)),
                   Foot{depth, cut->spread},
                   {}};
    if (fallsApart(piecesOf(solid), piecesOf(result.solid))) return std::nullopt;
    const GroundContact contact = groundContact(
        result.solid.vertices() * upright.rotation.transpose(), {}, result.foot->spread);
    constexpr double kSame = 0.9;
    if (sizeOf(contact.area) < kSame * sizeOf(expected.area)) return std::nullopt;
    return result;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

/// The cut nearest to the wanted depth that leaves a solid.
std::optional<Footing> cutNear(double wanted, double most, const LowestPart& lowest,
                               const Solid& solid, const Upright& upright, const Options& options) {
  const double merged = kContactHeight * solid.diagonal();
  std::vector<double> factors{1.0, 1.03, 0.97, 1.06, 0.94, 1.09, 0.91};
  // Of what falls apart a little is better than nothing.
  if (options.foot != FootCut::Given) factors.insert(factors.end(), {0.75, 0.5, 0.25});
  for (const double factor : factors) {
    const double depth = lowest.clearDepth(factor * wanted);
    if (depth > most) continue;
    const GroundContact expected = lowest.contactAt(depth);
    for (const double distance : {merged, 0.0}) {
      std::optional<Footing> cut = cutBy(depth, distance, solid, upright, expected, options);
      if (cut) return cut;
    }
  }
  return std::nullopt;
}

Footing onGivenFoot(const Solid& solid, const Upright& upright, const Options& options) {
  constexpr double kMost = 0.5;
  const double room = std::min(roomBelow(solid, upright), kMost * upright.height);
  if (options.footDepth >= room) {
    throw InvalidInput("foot_depth is " + std::to_string(options.footDepth) +
                       ", but the model can be cut by less than " +
                       std::to_string(std::max(room, 0.0)) +
                       " only: at most to half of its height, and not into openings. "
                       "Give less, or set foot to Automatic.");
  }
  const LowestPart lowest(upright.vertices, solid.skin(), (1.0 + kSlack) * options.footDepth);
  std::optional<Footing> cut = cutNear(options.footDepth, room, lowest, solid, upright, options);
  if (cut) return std::move(*cut);
  throw InvalidInput("The model cannot be cut at foot_depth without falling apart or crossing "
                     "itself: give another depth, or set foot to Automatic.");
}

} // namespace

LowestPart::LowestPart(const Points& upright, const Faces& faces, double height)
    : ground_(upright.col(2).minCoeff()), height_(height),
      diagonal_((upright.colwise().maxCoeff() - upright.colwise().minCoeff()).norm()) {
  const double top = ground_ + height;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = upright.row(faces(f, k)).transpose();
      const Vec3 b = upright.row(faces(f, (k + 1) % 3)).transpose();
      // Of the two half-edges that a closed surface has along it the one that goes up.
      if (a.z() < b.z() && a.z() <= top) edges_.emplace_back(a, b);
    }
  }
  std::sort(edges_.begin(), edges_.end(),
            [](const auto& e, const auto& other) { return e.first.z() < other.first.z(); });
  constexpr double kBeyond = 1.5; // what may be asked for, and more
  for (Eigen::Index v = 0; v < upright.rows(); ++v) {
    const double depth = upright(v, 2) - ground_;
    if (depth <= kBeyond * height) heights_.push_back(depth);
  }
  std::sort(heights_.begin(), heights_.end());
}

GroundContact LowestPart::contactAt(double depth) const {
  const double level = ground_ + depth;
  std::vector<Vec2> section;
  for (const auto& [low, high] : edges_) {
    if (low.z() > level) break;
    if (high.z() <= level) continue;
    const double share = (level - low.z()) / (high.z() - low.z());
    section.emplace_back((low + share * (high - low)).head<2>());
  }
  return contactOf(section, level, diagonal_);
}

double LowestPart::clearDepth(double wanted) const {
  // As near to it as a fiftieth of the depth is from the next vertex, or else in the widest gap.
  constexpr double kClearance = 0.02;
  const double clearance = kClearance * wanted;
  const double last = (1.0 + kSlack) * wanted;
  double widest = 0.0;
  double best = wanted;
  auto next = std::upper_bound(heights_.begin(), heights_.end(), wanted - clearance);
  double below = wanted - clearance;
  while (below < last) {
    const double above =
        next == heights_.end() ? last + clearance : std::min(*next, last + clearance);
    if (above - below >= 2.0 * clearance) return std::max(wanted, below + clearance);
    if (above - below > widest) {
      widest = above - below;
      best = 0.5 * (below + above);
    }
    if (next == heights_.end()) break;
    below = *next++;
  }
  return best;
}

double LowestPart::deepestWanted() const {
  return height_ / (1.0 + kSlack);
}

bool mayHaveFoot(const Options& options) {
  return standsOnContacts(options.goal) && options.foot != FootCut::Never && !options.radiusX &&
         !options.radiusY;
}

bool needsFoot(const Solid& solid, const Options& options) {
  if (!mayHaveFoot(options)) return false;
  return options.foot == FootCut::Given ||
         !holdsCircle(groundContact(Upright(solid, options).vertices, {}).area,
                      kFootInradius * solid.diagonal());
}

Footing onFoot(Solid solid, const Options& options, const std::optional<double>& wanted) {
  if (!needsFoot(solid, options)) return {std::move(solid), {}, {}};
  const Upright upright(solid, options);
  if (options.foot == FootCut::Given) {
    solid = withoutCrossings(std::move(solid));
    return onGivenFoot(solid, upright, options);
  }
  const double radius = kFootInradius * solid.diagonal();
  const ContactArea contacts = groundContact(upright.vertices, {}).area;
  solid = withoutCrossings(std::move(solid));
  const double most = std::min(kDeepest * upright.height, roomBelow(solid, upright));
  if (!(most > 0.0)) return {std::move(solid), {}, {}};
  LowestPart lowest(upright.vertices, solid.skin(), most);
  const double deepest = lowest.deepestWanted();
  const double least = std::min(kContactHeight * solid.diagonal(), deepest);
  const double depth = wanted ? *wanted : bestDepth(lowest, least, deepest, radius);
  if (inradius(lowest.contactAt(depth).area) <= inradius(contacts)) {
    return {std::move(solid), {}, {}};
  }
  std::optional<Footing> cut = cutNear(depth, most, lowest, solid, upright, options);
  if (!cut) return {std::move(solid), {}, {}};
  if (!wanted) cut->lowest = std::move(lowest);
  return std::move(*cut);
}

} // namespace massprops
