#include "property/cases.h"

#include "core/goals/registry.h"
#include "judge/checks.h"
#include "property/mesher.h"
#include "shapes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Never asked twice in one call or sum: the order of evaluation there is the compiler's choice.
class Chance {
public:
  Chance(std::uint32_t seed, int number)
      : random_(seed * 7919U + static_cast<std::uint32_t>(number) * 104729U + 1U) {
    for (int i = 0; i < 8; ++i) random_();
  }
  double between(double low, double high) { return low + 0.5 * (1.0 + random_()) * (high - low); }
  double logBetween(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  /// low ≤ n ≤ high
  int integer(int low, int high) {
    return std::min(high, low + static_cast<int>(between(0.0, high - low + 1.0)));
  }
  bool oneIn(int n) { return integer(1, n) == 1; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = random_.vector();
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  Mat3 turn() {
    const double angle = between(0.0, kPi);
    return rotation(direction(), angle);
  }

private:
  Random random_;
};

TriangleMesh displaced(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    mesh.vertices.row(v) = map(mesh.vertices.row(v).transpose()).transpose();
  return mesh;
}

Vec3 extent(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).transpose();
}

double diagonalOf(const TriangleMesh& mesh) {
  return extent(mesh).norm();
}

double volumeOf(const TriangleMesh& mesh) {
  const Vec3 base = mesh.vertices.row(0).transpose();
  double volume = 0.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Mat3 corners;
    for (int k = 0; k < 3; ++k)
      corners.col(k) = mesh.vertices.row(mesh.faces(f, k)).transpose() - base;
    volume += corners.determinant() / 6;
  }
  return volume;
}

double shortestEdge(const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      least = std::min(least, (mesh.vertices.row(mesh.faces(f, k)) -
                               mesh.vertices.row(mesh.faces(f, (k + 1) % 3)))
                                  .norm());
  return least;
}

// ---------------------------------------------------------------- families
// All about one unit large.

TriangleMesh smoothBlob(Chance& chance) {
  // Waves of a few lengths over the sphere, long ones highest.
  struct Wave {
    Vec3 direction;
    double frequency, phase, height;
  };
  std::vector<Wave> waves;
  for (int i = chance.integer(2, 8); i > 0; --i) {
    const double frequency = chance.between(1.0, 5.0);
    waves.push_back({chance.direction(), frequency, chance.between(0.0, 2 * kPi),
                     chance.between(0.0, 0.35) / frequency});
  }
  const double height = chance.between(0.4, 1.0);
  const Vec3 stretch(1.0, chance.between(0.4, 1.0), height);
  return transformed(starShaped(
                         [&](const Vec3& u) {
                           double r = 1.0;
                           for (const Wave& w : waves)
                             r += w.height * std::sin(w.frequency * w.direction.dot(u) + w.phase);
                           return std::max(r, 0.15);
                         },
                         chance.integer(3, 16)),
                     stretch.asDiagonal());
}

TriangleMesh spiky(Chance& chance) {
  struct Spike {
    Vec3 direction;
    double width, height;
  };
  std::vector<Spike> spikes;
  for (int i = chance.integer(1, 9); i > 0; --i)
    spikes.push_back({chance.direction(), chance.logBetween(0.08, 0.5), chance.between(-0.5, 2.5)});
  return starShaped(
      [&](const Vec3& u) {
        double r = 1.0;
        for (const Spike& s : spikes) {
          const double angle = std::acos(std::clamp(s.direction.dot(u), -1.0, 1.0));
          r += s.height * std::exp(-std::pow(angle / s.width, 2));
        }
        return std::max(r, 0.2);
      },
      chance.integer(5, 16));
}

/// Bends the x axis into an arc of the given angle and waves z.
TriangleMesh bent(const TriangleMesh& mesh, double angle, double wave) {
  const double length = extent(mesh).x();
  const double curvature = angle / length;
  return displaced(mesh, [&](const Vec3& p) {
    const double z = p.z() + wave * std::sin(5.0 * p.y());
    if (std::abs(curvature) < 1e-6) return Vec3(p.x(), p.y(), z);
    const double radius = 1.0 / curvature;
    const double turn = p.x() * curvature;
    return Vec3((radius - z) * std::sin(turn), p.y(), radius - (radius - z) * std::cos(turn));
  });
}

TriangleMesh plate(Chance& chance) {
  const double thickness = chance.logBetween(0.008, 0.2);
  const Vec3 size(1.0, chance.between(0.4, 1.0), thickness);
  TriangleMesh flat;
  if (chance.oneIn(2)) {
    flat = box(size, chance.integer(3, 14));
  } else {
    const int arcSegments = chance.integer(1, 2);
    const int flatSegments = chance.integer(4, 10);
    flat = roundedBox(size, chance.between(0.2, 0.49) * thickness, flatSegments, arcSegments);
  }
  if (chance.oneIn(3)) return flat;
  const double wave = chance.between(0.0, 0.08);
  return bent(flat, chance.between(0.0, 2.5), wave);
}

TriangleMesh tube(Chance& chance) {
  const double radius = chance.logBetween(0.02, 0.25);
  const TriangleMesh straight =
      transformed(capsule(radius, 1.0, chance.integer(6, 24)), rotation(Vec3::UnitY(), 0.5 * kPi));
  return chance.oneIn(3) ? straight : bent(straight, chance.between(0.3, 4.0), 0.0);
}

TriangleMesh ring(Chance& chance) {
  const double ratio = chance.between(0.08, 0.85);
  const int around = chance.integer(12, 60);
  const TriangleMesh plain = torus(1.0, ratio, around, chance.integer(6, 24));
  const double lobes = chance.integer(2, 5);
  const double depth = chance.oneIn(2) ? 0.0 : chance.between(0.0, 0.25);
  return displaced(plain, [&](const Vec3& p) {
    const double angle = std::atan2(p.y(), p.x());
    return Vec3(p.x() * (1 + depth * std::sin(lobes * angle)), p.y(),
                p.z() * (1 + depth * std::cos(lobes * angle)));
  });
}

/// A step that gives about `vertices` vertices on a surface of that area.
double stepFor(double area, int vertices) {
  return std::sqrt(2.5 * area / vertices);
}

TriangleMesh manyHoles(Chance& chance) {
  const int relaxations = chance.oneIn(2) ? 0 : chance.integer(2, 8);
  if (chance.oneIn(2)) {
    // Rings in a row that run into one another, every other one upright.
    const int rings = chance.integer(2, 4);
    const double thickness = chance.between(0.07, 0.16);
    const double blend = chance.between(0.02, 0.15);
    const double spacing = chance.between(0.55, 0.8);
    const bool upright = chance.oneIn(2);
    const Implicit chain = [=](const Vec3& p) {
      double d = std::numeric_limits<double>::infinity();
      for (int i = 0; i < rings; ++i) {
        const Vec3 axis = upright && i % 2 == 1 ? Vec3::UnitY() : Vec3::UnitZ();
        d = smoothMinimum(torusDistance(p, {i * spacing, 0.003, 0.001}, axis, 0.3, thickness), d,
                          blend);
      }
      return d;
    };
    const double area = 4 * kPi * kPi * 0.3 * thickness * rings;
    return implicitMesh(chain, Vec3::Constant(-0.6), {rings * spacing + 0.1, 0.6, 0.6},
                        std::min(stepFor(area, chance.integer(500, 2500)), 0.7 * thickness),
                        relaxations);
  }
  const int across = chance.integer(1, 3);
  const int along = chance.integer(1, 3);
  const double height = chance.between(0.1, 0.35);
  const double hole = chance.between(0.08, 0.14);
  const Implicit pierced = [=](const Vec3& p) {
    double d = roundedBoxDistance(p, {0.2 * along, 0.2 * across, 0.5 * height}, 0.04);
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j) {
        const double x = 0.4 * (i - 0.5 * (along - 1));
        const double y = 0.4 * (j - 0.5 * (across - 1));
        d = -smoothMinimum(-d, std::hypot(p.x() - x - 0.001, p.y() - y) - hole, 0.02);
      }
    return d;
  };
  const double area = across * along * (0.32 + 2 * kPi * hole * height) + 0.8 * (across + along);
  return implicitMesh(pierced, {-0.2 * along - 0.15, -0.2 * across - 0.15, -0.5 * height - 0.15},
                      {0.2 * along + 0.15, 0.2 * across + 0.15, 0.5 * height + 0.15},
                      std::min(stepFor(area, chance.integer(600, 2500)), 0.08), relaxations);
}

/// A trunk with limbs; `ground`: what lies below that height is cut away.
TriangleMesh limbs(Chance& chance, bool cut) {
  struct Limb {
    Vec3 from, to;
    double rFrom, rTo;
  };
  std::vector<Limb> parts{
      {{0, 0, 0}, 0.5 * chance.direction(), chance.between(0.15, 0.3), chance.between(0.12, 0.3)}};
  double area = 1.5;
  for (int i = chance.integer(1, 6); i > 0; --i) {
    const Limb& trunk =
        parts[static_cast<std::size_t>(chance.integer(0, static_cast<int>(parts.size()) - 1))];
    const double r = chance.between(0.05, 0.15);
    const Vec3 start = trunk.from + chance.between(0.2, 1.0) * (trunk.to - trunk.from);
    const Vec3 direction = chance.direction();
    const Vec3 end = start + chance.between(0.3, 0.8) * direction;
    parts.push_back({start, end, r, chance.between(0.4, 1.0) * r});
    area += 0.5 * 2 * kPi * r;
  }
  const double blend = chance.between(0.02, 0.2);
  const double ground = cut ? chance.between(-0.25, 0.0) : -10.0;
  const Implicit solid = [=](const Vec3& p) {
    double d = std::numeric_limits<double>::infinity();
    for (const Limb& l : parts)
      d = smoothMinimum(capsuleDistance(p, l.from, l.to, l.rFrom, l.rTo), d, blend);
    return std::max(d, ground - p.z());
  };
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = -lower;
  for (const Limb& l : parts) {
    const double r = std::max(l.rFrom, l.rTo) + 0.1;
    lower = lower.cwiseMin(l.from.cwiseMin(l.to) - Vec3::Constant(r));
    upper = upper.cwiseMax(l.from.cwiseMax(l.to) + Vec3::Constant(r));
  }
  const double step = std::clamp(stepFor(area, chance.integer(600, 2500)), 0.025, 0.07);
  // The lattice meets the ground: its lowest layer of vertices is flat.
  lower.z() = std::max(lower.z(), ground - 2.3 * step);
  return implicitMesh(solid, lower, upper, step, cut || chance.oneIn(2) ? 0 : chance.integer(2, 6));
}

TriangleMesh bevelled(Chance& chance) {
  const double height = chance.between(0.3, 1.5);
  const Vec3 size(1.0, chance.between(0.3, 1.0), height);
  switch (chance.integer(1, 3)) {
  case 1: {
    const int arcSegments = chance.integer(1, 3);
    const int flatSegments = chance.integer(1, 10);
    const double radius = chance.between(0.05, 0.45) * size.minCoeff();
    return roundedBox(size, radius, flatSegments, arcSegments);
  }
  case 2:
    return box(size, chance.integer(1, 14));
  default: {
    std::vector<std::array<int, 3>> cells{{0, 0, 0}};
    for (int i = chance.integer(1, 5); i > 0; --i) { // a stair: no two cubes meet at an edge only
      std::array<int, 3> next = cells.back();
      ++next[static_cast<std::size_t>(chance.integer(0, 2))];
      cells.push_back(next);
    }
    return polycube(cells, chance.integer(1, 5));
  }
  }
}

/// Few vertices, large angles.
TriangleMesh coarse(Chance& chance) {
  const auto point = [&] {
    const double distance = chance.between(0.5, 1.0);
    return Vec3(distance * chance.direction());
  };
  switch (chance.integer(1, 4)) {
  case 1: {
    std::array<Vec3, 4> p;
    do {
      for (Vec3& corner : p) corner = point();
    } while ((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 0.05);
    return tetrahedron(p[0], p[1], p[2], p[3]);
  }
  case 2: {
    const int subdivisions = chance.integer(1, 2);
    return ellipsoid({1.0, chance.between(0.2, 1.0), chance.between(0.2, 1.0)}, subdivisions);
  }
  case 3: {
    std::vector<Vec2> profile{{0.0, 1.0}};
    for (int i = chance.integer(1, 5); i > 0; --i) {
      const double drop = chance.between(0.05, 0.4);
      profile.emplace_back(chance.between(0.1, 0.8), profile.back().y() - drop);
    }
    profile.emplace_back(0.0, profile.back().y() - chance.between(0.0, 0.3));
    return revolved(profile, chance.integer(3, 12));
  }
  default: {
    const Mat3 sheared = shear(chance.between(0.0, 1.0));
    const double height = chance.between(0.3, 1);
    const Mat3 map = Vec3(chance.between(0.3, 1), 1, height).asDiagonal() * sheared;
    return transformed(box({1, 1, 1}, chance.integer(1, 2)), map);
  }
  }
}

/// A cup or a shell: thin all over, its inside is outside.
TriangleMesh bowl(Chance& chance) {
  const double wall = chance.between(0.16, 0.35);
  const double rim = chance.between(-0.4, 0.6);
  const double depth = chance.between(0.5, 1.0);
  const Implicit solid = [=](const Vec3& p) {
    const double shell = std::abs(Vec3(p.x(), p.y(), p.z() / depth).norm() - 1.0) - 0.5 * wall;
    return -smoothMinimum(-shell, rim - p.z(), 0.05);
  };
  const double step = 0.75 * wall;
  const Vec3 far(1.3, 1.3, 1.3);
  return implicitMesh(solid, -far, far, step, chance.oneIn(2) ? 0 : chance.integer(2, 6));
}

TriangleMesh oneBody(Chance& chance, int kind, std::string& family);

TriangleMesh severalBodies(Chance& chance) {
  TriangleMesh all;
  double x = 0.0;
  for (int i = chance.integer(2, 3); i > 0; --i) {
    std::string ignored;
    TriangleMesh part = oneBody(
        chance, std::array<int, 5>{0, 3, 4, 7, 8}[static_cast<std::size_t>(chance.integer(0, 4))],
        ignored);
    const double factor = chance.between(0.4, 1.0);
    part = scaled(transformed(part, chance.turn()), factor);
    x += chance.between(0.01, 0.5);
    part = transformed(part, Mat3::Identity(),
                       {x - part.vertices.col(0).minCoeff(), chance.between(-0.3, 0.3),
                        -part.vertices.col(2).minCoeff()});
    x = part.vertices.col(0).maxCoeff();
    all = all.faces.rows() == 0 ? part : joined(all, part);
  }
  return all;
}

constexpr int kFamilies = 12;

TriangleMesh oneBody(Chance& chance, int kind, std::string& family) {
  switch (kind) {
  case 0:
    family = "blob";
    return smoothBlob(chance);
  case 1:
    family = "spikes";
    return spiky(chance);
  case 2:
    family = "plate";
    return plate(chance);
  case 3:
    family = "tube";
    return tube(chance);
  case 4:
    family = "ring";
    return ring(chance);
  case 5:
    family = "holes";
    return manyHoles(chance);
  case 6:
    family = "limbs";
    return limbs(chance, false);
  case 7:
    family = "box";
    return bevelled(chance);
  case 8:
    family = "coarse";
    return coarse(chance);
  case 9:
    family = "bowl";
    return bowl(chance);
  case 10:
    family = "bodies";
    return severalBodies(chance);
  default:
    family = "cavity";
    return chance.oneIn(2) ? smoothBlob(chance) : bevelled(chance);
  }
}

// ---------------------------------------------------------------- disguises

TriangleMesh rounded(TriangleMesh mesh) {
  mesh.vertices = mesh.vertices.cast<float>().cast<double>();
  return mesh;
}

bool liesWithin(const TriangleMesh& part, const TriangleMesh& body) {
  for (const auto& p : part.vertices.rowwise()) {
    if (windingNumber(body, p.transpose()) < 0.5) return false;
  }
  return true;
}

/// Whether the points on the ground spread in two directions.
bool hasFoot(const TriangleMesh& mesh, const Vec3& up) {
  const double diagonal = diagonalOf(mesh);
  const Vector height = mesh.vertices * up;
  Mat3 spread = Mat3::Zero();
  Vec3 middle = Vec3::Zero();
  double count = 0.0;
  for (int round = 0; round < 2; ++round)
    for (Eigen::Index v = 0; v < height.size(); ++v) {
      if (height[v] > height.minCoeff() + 0.5e-4 * diagonal) continue;
      const Vec3 p = mesh.vertices.row(v).transpose();
      if (round == 0) {
        middle = (count * middle + p) / (count + 1.0);
        count += 1.0;
      } else {
        spread += (p - middle) * (p - middle).transpose();
      }
    }
  // The second largest: the smallest is that along the up axis.
  const Vector sizes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvalues();
  return sizes[1] > std::pow(1e-3 * diagonal, 2);
}

std::string upName(UpAxis up) {
  switch (up) {
  case UpAxis::PlusZ:
    return "+z";
  case UpAxis::PlusY:
    return "+y";
  case UpAxis::PlusX:
    return "+x";
  case UpAxis::MinusZ:
    return "-z";
  case UpAxis::MinusY:
    return "-y";
  case UpAxis::MinusX:
    return "-x";
  }
  return "";
}

/// Defects as published models have them: faces turned over, twice, and with corners of their own
/// that lie apart by little; edges cut on one side only; one vertex
/// without its faces, a hole.
TriangleMesh broken(const TriangleMesh& mesh, Chance& chance, std::string& how) {
  TriangleMesh result = mesh;
  const auto n = static_cast<int>(mesh.faces.rows());
  if (chance.oneIn(2)) {
    how += " hole";
    const int vertex = mesh.faces(chance.integer(0, n - 1), 0);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < result.faces.rows(); ++f) {
      if ((mesh.faces.row(f).array() != vertex).all()) {
        result.faces.row(kept++) = mesh.faces.row(f);
      }
    }
    result.faces.conservativeResize(kept, 3);
  }
  if (chance.oneIn(2)) {
    how += " turned faces";
    for (Eigen::Index f = 0; f < result.faces.rows(); ++f) {
      if (chance.oneIn(9)) std::swap(result.faces(f, 0), result.faces(f, 1));
    }
  }
  if (how.empty() || chance.oneIn(2)) {
    how += " loose";
    result = jittered(unwelded(result), 1e-6 * diagonalOf(mesh), 5);
  }
  if (chance.oneIn(4)) {
    how += " T-junctions";
    for (int i = 0; i < 5; ++i) {
      const int f = chance.integer(0, n / 2);
      const Eigen::RowVector3i face = result.faces.row(f);
      const auto v = static_cast<int>(result.vertices.rows());
      result.vertices.conservativeResize(v + 1, 3);
      result.vertices.row(v) = 0.5 * (result.vertices.row(face[0]) + result.vertices.row(face[1]));
      result.faces.row(f) << face[0], v, face[2];
      result.faces.conservativeResize(result.faces.rows() + 1, 3);
      result.faces.row(result.faces.rows() - 1) << v, face[1], face[2];
    }
  }
  if (chance.oneIn(3)) {
    how += " double faces";
    const Eigen::Index rows = result.faces.rows();
    result.faces.conservativeResize(rows + rows / 10, 3);
    for (Eigen::Index f = 0; f < rows / 10; ++f)
      result.faces.row(rows + f) = result.faces.row(3 * f);
  }
  return result;
}

} // namespace

PropertyCase makeCase(std::uint32_t seed, int number) {
  Chance chance(seed, number);
  PropertyCase c;
  std::ostringstream text;
  const int kind = number % kFamilies;
  const bool cutLimbs = kind == 6 && chance.oneIn(2);
  TriangleMesh body;
  if (cutLimbs) {
    c.family = "limbs";
    body = limbs(chance, true);
  } else {
    body = oneBody(chance, kind, c.family);
  }
  if (chance.oneIn(3)) {
    const double amplitude = chance.between(0.0, 0.3) * shortestEdge(body);
    body = jittered(body, amplitude, seed + static_cast<std::uint32_t>(number));
    text << "jittered ";
  }
  if (chance.oneIn(5)) {
    // Most often fine enough that a coarse copy of it moves inwards; what is rough is not the copy.
    body = subdivided(body);
    body = jittered(body, chance.between(0.0, 0.25) * shortestEdge(body), seed);
    text << "refined ";
  }

  // Pose: as made, or turned and perhaps flattened where it stands.
  c.options.goal =
      static_cast<GoalKind>(chance.integer(0, static_cast<int>(goalRegistry().size()) - 1));
  if (!cutLimbs && !chance.oneIn(3)) {
    body = transformed(body, chance.turn());
    text << "turned ";
    if (chance.oneIn(3)) {
      const double low = body.vertices.col(2).minCoeff();
      const double ground = low + chance.between(0.02, 0.2) * extent(body).z();
      body = displaced(body,
                       [&](const Vec3& p) { return Vec3(p.x(), p.y(), std::max(p.z(), ground)); });
      text << "flattened ";
    }
  }

  TriangleMesh cavities;
  if (c.family == "cavity") {
    // Most bodies of this family are star-shaped about the middle; the others stay without.
    const Vec3 middle =
        0.5 * (body.vertices.colwise().maxCoeff() + body.vertices.colwise().minCoeff()).transpose();
    const double share = chance.between(0.1, 0.6);
    const TriangleMesh small = transformed(body, share * Mat3::Identity(), (1 - share) * middle);
    if (liesWithin(small, body)) cavities = reversed(small);
  }

  // Place: size, distance, precision.
  c.floats = chance.oneIn(2);
  const double size = chance.oneIn(2) ? 1.0 : chance.logBetween(1e-6, 1e6);
  const double distance =
      chance.oneIn(3) ? chance.logBetween(0.1, c.floats ? 10.0 : 1e4) * diagonalOf(body) : 0.0;
  const UpAxis axes[] = {UpAxis::PlusZ,  UpAxis::PlusY,  UpAxis::PlusX,
                         UpAxis::MinusZ, UpAxis::MinusY, UpAxis::MinusX};
  c.options.upAxis = chance.oneIn(2) ? UpAxis::PlusZ : axes[chance.integer(0, 5)];
  // Any rotation that takes z to the up axis.
  const Vec3 up =
      std::array<Vec3, 6>{Vec3::UnitZ(),  Vec3::UnitY(),  Vec3::UnitX(),
                          -Vec3::UnitZ(), -Vec3::UnitY(), -Vec3::UnitX()}[static_cast<std::size_t>(
          c.options.upAxis)];
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), up).toRotationMatrix();
  const bool mirrored = chance.oneIn(5);
  Mat3 place = size * turn;
  if (mirrored) place *= Vec3(-1, 1, 1).asDiagonal();
  const Vec3 shift = size * distance * chance.direction();
  const auto placed = [&](const TriangleMesh& mesh) {
    if (mesh.faces.rows() == 0) return mesh;
    const TriangleMesh there = displaced(mesh, [&](const Vec3& p) { return place * p + shift; });
    return c.floats ? rounded(there) : there;
  };
  c.body = placed(body);
  c.cavities = placed(cavities);
  c.input = c.cavities.faces.rows() > 0 ? joined(c.body, c.cavities) : c.body;
  if (mirrored) { // What was handed in faces the wrong way; what it is checked against does not.
    c.body = reversed(c.body);
    if (c.cavities.faces.rows() > 0) c.cavities = reversed(c.cavities);
  }
  const bool split = chance.oneIn(5);
  if (split) c.input = unwelded(c.input);
  text << "size " << size << (distance > 0.0 ? " far" : "") << (mirrored ? " mirrored" : "")
       << (split ? " unwelded" : "") << (c.floats ? " floats" : "");

  // Options.
  Options& o = c.options;
  const double diagonal = diagonalOf(c.body);
  const auto n = static_cast<int>(c.body.vertices.rows());
  o.basisSize = std::min(static_cast<int>(std::lround(chance.logBetween(4.0, 200.0))), n - 1);
  if (o.basisSize < 5) o.goal = GoalKind::Stand;
  c.wall = diagonal * chance.logBetween(0.003, 0.08);
  o.innerLowerBound = c.wall;
  o.mend = false; // what crosses itself is to be refused
  if (chance.oneIn(3)) o.innerUpperBound = chance.between(0.3, 1.0);
  const bool stands = o.goal == GoalKind::Stand || o.goal == GoalKind::PublishedStand ||
                      o.goal == GoalKind::StandEmptyAndFilled;
  if (o.goal == GoalKind::Stand && chance.oneIn(2)) o.tippingAngle = chance.between(0.5, 40.0);
  if (stands || o.goal == GoalKind::RollUpright) {
    // Without a flat foot the radii are needed; with one they may be given.
    if ((stands && !hasFoot(c.body, up)) || chance.oneIn(4)) {
      o.radiusX = diagonal * chance.between(0.03, 0.4);
      o.radiusY = diagonal * chance.between(0.03, 0.4);
    }
  }
  if (chance.oneIn(6)) {
    o.outerUpperBound = diagonal * chance.logBetween(0.002, 0.1);
    o.outerLowerBound = chance.oneIn(2) ? 0.0 : chance.between(0.0, 1.0) * o.outerUpperBound;
  }
  if (chance.oneIn(4) || o.goal == GoalKind::StandEmptyAndFilled) {
    const double contents = chance.between(0.01, 3.0);
    // What is light is printed rather than filled in.
    if (contents < 0.6 && o.goal != GoalKind::StandEmptyAndFilled) {
      o.cavityInfill = contents;
    } else {
      o.fillDensity = o.density * contents;
    }
  }
  o.waterLevel = chance.oneIn(5) ? 1.0 : chance.between(0.2, 0.9);
  o.waterDensity = o.density * chance.between(0.3, 1.5);
  if (!chance.oneIn(4)) {
    o.targetMass = chance.between(0.1, 1.2) * o.density * volumeOf(c.body) / 1000.0;
  }
  if (chance.oneIn(3)) {
    const Vec3 lower = c.body.vertices.colwise().minCoeff().transpose();
    const Vec3 middle = lower + 0.5 * extent(c.body);
    o.pivot = middle + 0.2 * diagonal * chance.direction();
  }
  if (chance.oneIn(5)) o.weights.volume = chance.between(0.0, 2.0);
  o.spinSpeed = chance.logBetween(100.0, 1e5);
  o.cavityShape = static_cast<CavityShape>(chance.integer(0, 2));
  // Cut flat instead of standing on given radii.
  if (o.radiusX && o.outerUpperBound == 0.0 && chance.oneIn(2)) o.radiusX = o.radiusY = {};
  if (o.outerUpperBound > 0.0) o.foot = FootCut::Never;
  // Refused together (option_pairs_test).
  if (o.outerUpperBound > 0.0 && o.cavityShape == CavityShape::BestPossible)
    o.cavityShape = CavityShape::Automatic;
  if (c.floats)
    o.representable = [](const Points& points) {
      return Points(points.cast<float>().cast<double>());
    };

  text << "; " << goalNames()[static_cast<std::size_t>(o.goal)] << " k " << o.basisSize << " wall "
       << c.wall / diagonal << " upper " << o.innerUpperBound << " up " << upName(o.upAxis);
  if (o.radiusX) text << " radii " << *o.radiusX / diagonal << ' ' << *o.radiusY / diagonal;
  if (o.outerUpperBound > 0.0)
    text << " outer " << o.outerLowerBound / diagonal << ".." << o.outerUpperBound / diagonal;
  if (o.fillDensity > 0.0) text << " fill " << o.fillDensity / o.density;
  if (o.cavityInfill > 0.0) text << " infill " << o.cavityInfill;
  if (o.goal == GoalKind::Float) {
    text << " water " << o.waterLevel << " of density " << o.waterDensity / o.density;
  }
  if (o.cavityShape == CavityShape::Offset) text << " offset surface";
  if (o.cavityShape == CavityShape::BestPossible) text << " best possible";
  if (o.tippingAngle > 0.0) text << " tipping angle " << o.tippingAngle;
  if (o.goal == GoalKind::Spin) text << " rpm " << o.spinSpeed;
  if (o.goal == GoalKind::Mass) text << " target " << o.targetMass;
  if (o.pivot) text << " pivot";
  if (o.weights.volume > 0.0) text << " volume weight " << o.weights.volume;
  // Of fine bodies, for on a coarse one a vertex's faces are no small hole; far away floats lie
  // farther apart than what is merged. One that was flattened until it crosses itself is no clean
  // one.
  constexpr int kSomeOfThem = 4;
  constexpr Eigen::Index kFine = 400;
  if (number % kSomeOfThem == 1 && c.body.faces.rows() >= kFine && distance == 0.0 && !mirrored &&
      c.cavities.faces.rows() == 0 && o.outerUpperBound == 0.0 && intersectingPairs(c.body) == 0) {
    Chance defects(seed + 1U, number);
    std::string how;
    c.input = broken(c.body, defects, how);
    if (c.floats) c.input = rounded(c.input);
    c.isBroken = o.mend = true;
    text << "; broken:" << how;
  }
  c.description = text.str();
  return c;
}

} // namespace massprops::testing
