#include "judge/guarantee.h"

#include "judge/checks.h"
#include "shapes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> trianglesOf(const TriangleMesh& mesh) {
  std::vector<Triangle> result;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Triangle t;
    for (int k = 0; k < 3; ++k)
      t[static_cast<std::size_t>(k)] = mesh.vertices.row(mesh.faces(f, k)).transpose();
    result.push_back(t);
  }
  return result;
}

/// How many have an angle of less than so many degrees, by the law of cosines.
int facesSharperThan(const TriangleMesh& mesh, double degrees) {
  const double limit = std::cos(degrees * kPi / 180.0);
  int count = 0;
  for (const Triangle& t : trianglesOf(mesh)) {
    double sharpest = -1.0; // cosine
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = (t[(k + 1) % 3] - t[(k + 2) % 3]).norm();
      const double b = (t[k] - t[(k + 1) % 3]).norm();
      const double c = (t[k] - t[(k + 2) % 3]).norm();
      sharpest = std::max(sharpest, (b * b + c * c - a * a) / (2.0 * b * c));
    }
    if (sharpest > limit) ++count;
  }
  return count;
}

// ---------------------------------------------------------------- distances

double pointToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double square = edge.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).norm();
}

double pointToTriangle(const Vec3& p, const Triangle& t) {
  double least = kInfinity;
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, pointToSegment(p, t[k], t[(k + 1) % 3]));
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (normal.norm() == 0.0) return least;
  for (std::size_t k = 0; k < 3; ++k) {
    if (normal.cross(t[(k + 1) % 3] - t[k]).dot(p - t[k]) < 0.0) return least;
  }
  return std::min(least, std::abs(normal.normalized().dot(p - t[0])));
}

double segmentToSegment(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double least = std::min({pointToSegment(a, c, d), pointToSegment(b, c, d),
                           pointToSegment(c, a, b), pointToSegment(d, a, b)});
  // The common perpendicular, where its feet lie on both segments.
  const Vec3 u = b - a;
  const Vec3 v = d - c;
  const Vec3 n = u.cross(v);
  const double square = n.squaredNorm();
  if (square <= 0.0) return least;
  const double s = (c - a).cross(v).dot(n) / square;
  const double t = (c - a).cross(u).dot(n) / square;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)
    least = std::min(least, std::abs(n.dot(c - a)) / std::sqrt(square));
  return least;
}

/// Of triangles that do not cross: the nearest points are a corner and a point, or on two edges.
double triangleToTriangle(const Triangle& a, const Triangle& b) {
  double least = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, pointToTriangle(a[i], b), pointToTriangle(b[i], a)});
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, segmentToSegment(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return least;
}

struct Box {
  Vec3 low = Vec3::Constant(kInfinity);
  Vec3 high = Vec3::Constant(-kInfinity);

  void add(const Triangle& t) {
    for (const Vec3& corner : t) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  double distance(const Box& other) const {
    return (low - other.high).cwiseMax(other.low - high).cwiseMax(0.0).norm();
  }
};

/// Halves its triangles at the median of the longest side of their box, down to four.
class BoxTree {
public:
  explicit BoxTree(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    order_.resize(triangles.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, order_.size());
  }

  /// Least distance to `t`, as far as it is below `bound`; else at least `bound`.
  double distance(const Triangle& t, double bound) const {
    Box box;
    box.add(t);
    descend(0, t, box, bound);
    return bound;
  }

private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::size_t left = 0, right = 0; ///< 0: a leaf
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({{}, begin, end});
    for (std::size_t i = begin; i < end; ++i) nodes_[index].box.add(triangles_[order_[i]]);
    if (end - begin <= 4) return index;
    Eigen::Index axis = 0;
    (nodes_[index].box.high - nodes_[index].box.low).maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
      return triangles_[a][0][axis] + triangles_[a][1][axis] + triangles_[a][2][axis] <
             triangles_[b][0][axis] + triangles_[b][1][axis] + triangles_[b][2][axis];
    });
    const std::size_t left = build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  void descend(std::size_t index, const Triangle& t, const Box& box, double& least) const {
    const Node& node = nodes_[index];
    if (node.box.distance(box) >= least) return;
    if (node.left == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i)
        least = std::min(least, triangleToTriangle(t, triangles_[order_[i]]));
      return;
    }
    const bool leftFirst =
        nodes_[node.left].box.distance(box) <= nodes_[node.right].box.distance(box);
    descend(leftFirst ? node.left : node.right, t, box, least);
    descend(leftFirst ? node.right : node.left, t, box, least);
  }

  const std::vector<Triangle>& triangles_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

// ---------------------------------------------------------------- components

/// Labels 0, 1, … of connected faces.
std::vector<int> faceComponents(const TriangleMesh& mesh) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int v) {
    while (parent[static_cast<std::size_t>(v)] != v) v = parent[static_cast<std::size_t>(v)];
    return v;
  };
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 1; k < 3; ++k) {
      const int a = find(mesh.faces(f, 0));
      const int b = find(mesh.faces(f, k));
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  std::vector<int> label(parent.size(), -1);
  std::vector<int> result;
  int count = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    int& l = label[static_cast<std::size_t>(find(mesh.faces(f, 0)))];
    if (l < 0) l = count++;
    result.push_back(l);
  }
  return result;
}

std::vector<TriangleMesh> componentsOf(const TriangleMesh& mesh) {
  const std::vector<int> labels = faceComponents(mesh);
  const int count = labels.empty() ? 0 : 1 + *std::max_element(labels.begin(), labels.end());
  std::vector<TriangleMesh> result(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) {
    TriangleMesh& part = result[static_cast<std::size_t>(c)];
    part.vertices = mesh.vertices;
    part.faces.resize(std::count(labels.begin(), labels.end(), c), 3);
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
      if (labels[static_cast<std::size_t>(f)] == c) part.faces.row(row++) = mesh.faces.row(f);
  }
  return result;
}

/// Whether around every vertex the faces form one closed fan: as many faces as neighbours, each
/// next to the next. \pre isClosedAndOriented
bool hasOneFanAtEveryVertex(const TriangleMesh& mesh) {
  std::vector<std::vector<std::pair<int, int>>> links(
      static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      links[static_cast<std::size_t>(mesh.faces(f, k))].emplace_back(mesh.faces(f, (k + 1) % 3),
                                                                     mesh.faces(f, (k + 2) % 3));
  for (const auto& link : links) {
    if (link.empty()) continue;
    std::size_t steps = 0;
    int at = link.front().first;
    do {
      const auto next = std::find_if(link.begin(), link.end(),
                                     [&](const auto& edge) { return edge.first == at; });
      if (next == link.end()) return false;
      at = next->second;
      ++steps;
    } while (at != link.front().first && steps <= link.size());
    if (steps != link.size()) return false;
  }
  return true;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : trianglesOf(mesh)) area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  return area;
}

// ---------------------------------------------------------------- the report

using Moments10 = Eigen::Matrix<double, 10, 1>;

/// What touches the ground, in diagonals, of a body that has not been cut flat.
constexpr double kTouching = 1e-4;

/// The working frame: the up axis as z, the other axes in cyclic order (for a negative up axis in
/// the reverse one); the origin in the middle of the ground contact; the diagonal 1.
struct Upright {
  Mat3 turn;
  Vec3 origin;
  double length;
  std::vector<Vec2> contact; ///< ground points, working

  /// `touching`: how high above the lowest vertex others touch the ground, in diagonals.
  Upright(const TriangleMesh& body, UpAxis up, double touching = kTouching) {
    switch (up) {
    case UpAxis::PlusZ:
      turn = Mat3::Identity();
      break;
    case UpAxis::PlusY:
      turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
      break;
    case UpAxis::PlusX:
      turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
      break;
    case UpAxis::MinusZ:
      turn << 0, 1, 0, 1, 0, 0, 0, 0, -1;
      break;
    case UpAxis::MinusY:
      turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      break;
    case UpAxis::MinusX:
      turn << 0, 0, 1, 0, 1, 0, -1, 0, 0;
      break;
    }
    length = (body.vertices.colwise().maxCoeff() - body.vertices.colwise().minCoeff()).norm();
    const Points x = body.vertices * turn.transpose();
    const double ground = x.col(2).minCoeff();
    std::vector<Vec2> points;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      if (x(v, 2) <= ground + touching * length) points.emplace_back(x(v, 0), x(v, 1));
    hull(points);
    Vec2 middle = Vec2::Zero();
    double twiceArea = 0.0;
    for (std::size_t i = 1; i + 1 < contact.size(); ++i) {
      const Vec2 a = contact[i] - contact[0];
      const Vec2 b = contact[i + 1] - contact[0];
      const double cross = a.x() * b.y() - a.y() * b.x();
      twiceArea += cross;
      middle += cross * (a + b) / 3;
    }
    isFlat = contact.size() >= 3 && 0.5 * twiceArea > std::pow(1e-4 * length, 2);
    if (isFlat) {
      middle = contact[0] + middle / twiceArea;
    } else {
      middle.setZero();
      for (const Vec2& p : points) middle += p / static_cast<double>(points.size());
    }
    for (Vec2& p : contact) p = (p - middle) / length;
    origin = turn.transpose() * Vec3(middle.x(), middle.y(), ground);
  }

  bool isFlat = false;

private:
  /// Monotone chain, counter-clockwise.
  void hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
      return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) {
      contact = points;
      return;
    }
    const auto half = [&](auto begin, auto end) {
      std::vector<Vec2> chain;
      for (auto p = begin; p != end; ++p) {
        while (chain.size() >= 2) {
          const Vec2 a = chain.back() - chain[chain.size() - 2];
          const Vec2 b = *p - chain.back();
          if (a.x() * b.y() - a.y() * b.x() > 0) break;
          chain.pop_back();
        }
        chain.push_back(*p);
      }
      chain.pop_back();
      return chain;
    };
    contact = half(points.begin(), points.end());
    const std::vector<Vec2> upper = half(points.rbegin(), points.rend());
    contact.insert(contact.end(), upper.begin(), upper.end());
  }
};

struct Sums {
  Body body;
  double objective, volume, area;
};

/// Collects what is wrong.
class Findings {
public:
  template <class... Parts>
  void require(bool holds, const Parts&... parts) {
    if (holds) return;
    std::ostringstream sentence;
    sentence.precision(9);
    (sentence << ... << parts);
    sentences.push_back(sentence.str());
  }
  void near(const std::string& what, double got, double expected, double tolerance) {
    require(std::abs(got - expected) <= tolerance, what, " is ", got, ", measured ", expected,
            ", allowed ", tolerance);
  }
  std::vector<std::string> sentences;
};

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

bool has(const Result& result, const std::string& key) {
  return std::any_of(result.report.entries.begin(), result.report.entries.end(),
                     [&](const auto& entry) { return entry.first == key; });
}

/// Where the goal's reference point is, in the frame: the origin of Stand, a given or default
/// pivot.
Vec3 referenceOf(const PropertyCase& c, const Upright& frame) {
  const auto working = [&](const Vec3& p) {
    return Vec3(frame.turn * (p - frame.origin) / frame.length);
  };
  const double height = (c.body.vertices * frame.turn.row(2).transpose()).maxCoeff() -
                        (frame.turn * frame.origin).z();
  switch (c.options.goal) {
  case GoalKind::Spin: {
    // Any point of the axis: the height counts from the ground.
    const Vec3 axis = c.options.pivot ? working(*c.options.pivot) : Vec3::Zero();
    return {axis.x(), axis.y(), 0.0};
  }
  case GoalKind::YoYo:
    return c.options.pivot ? working(*c.options.pivot) : Vec3(0, 0, 0.5 * height / frame.length);
  case GoalKind::Hang: {
    if (c.options.pivot) return working(*c.options.pivot);
    // The ground of the model turned upside down.
    const int up = static_cast<int>(c.options.upAxis);
    return working(Upright(c.body, static_cast<UpAxis>((up + 3) % 6)).origin);
  }
  default:
    return Vec3::Zero();
  }
}

/// Least distance of `centre` to a supporting line of the contact area, negative outside; scanned
/// over the directions and refined.
double marginWithin(const PropertyCase& c, const Upright& frame, const Vec2& centre) {
  std::optional<Vec2> radii;
  if (c.options.radiusX) radii = Vec2(*c.options.radiusX, *c.options.radiusY) / frame.length;
  const auto margin = [&](double angle) {
    const Vec2 u(std::cos(angle), std::sin(angle));
    double farthest = -kInfinity;
    if (radii) {
      farthest = u.cwiseProduct(*radii).norm();
    } else {
      for (const Vec2& p : frame.contact) farthest = std::max(farthest, u.dot(p));
    }
    return farthest - u.dot(centre);
  };
  // One valley may look lower between two samples and be higher at its bottom: all are searched.
  constexpr int kSamples = 7200;
  double best = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    double step = 2 * kPi / kSamples;
    double lowest = i * step;
    if (margin(lowest - step) < margin(lowest) || margin(lowest + step) < margin(lowest)) continue;
    for (int round = 0; round < 40; ++round, step /= 2)
      for (const double next : {lowest - step, lowest + step})
        if (margin(next) < margin(lowest)) lowest = next;
    if (margin(lowest) < margin(best)) best = lowest;
  }
  return margin(best);
}

/// The verdict in its own words: tipping angle in degrees.
double tippingAngleOf(const PropertyCase& c, const Upright& frame, const Body& body) {
  const Vec3 centre = frame.turn * (body.centre - frame.origin) / frame.length;
  return std::atan2(marginWithin(c, frame, centre.head<2>()), centre.z()) * 180 / kPi;
}

double standViolation(const PropertyCase& c, const Upright& frame, const Body& body) {
  const Vec3 centre = frame.turn * (body.centre - frame.origin) / frame.length;
  double worst = std::max(0.0, -centre.z());
  std::optional<Vec2> radii;
  if (c.options.radiusX) radii = Vec2(*c.options.radiusX, *c.options.radiusY) / frame.length;
  if (radii) {
    const double share = centre.head<2>().cwiseQuotient(*radii).squaredNorm();
    return std::max(worst, 0.5 * radii->minCoeff() * (share - 0.81));
  }
  for (std::size_t e = 0; e < frame.contact.size(); ++e) {
    const Vec2 p = frame.contact[e];
    const Vec2 edge = frame.contact[(e + 1) % frame.contact.size()] - p;
    const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
    worst = std::max(worst, normal.dot(centre.head<2>()) - 0.9 * normal.dot(p));
  }
  return worst;
}

/// Of a body on the axis, the smaller one first, about a point `below` its centre.
Vec2 momentsAcross(const Mat3& upright, double below, double mass) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(upright.topLeftCorner<2, 2>());
  return plane.eigenvalues().array() + mass * below * below;
}

/// The growth of a disturbance of a top on its tip, upright with this speed (rpm), per radian that
/// it turns: by the eigenvalues of Euler's equations, lengths in millimetres.
double growthOfTop(const Mat3& upright, double height, double mass, double rpm) {
  const double w = rpm * kPi / 30;
  const Vec2 across = momentsAcross(upright, height, mass);
  const double axial = upright(2, 2);
  const double weight = mass * 9806.65 * height / (w * w);
  Eigen::Matrix4d motion;
  motion << 0, (across[1] - axial) / across[0], 0, weight / across[0], //
      (axial - across[0]) / across[1], 0, -weight / across[1], 0,      //
      0, -1, 0, 1,                                                     //
      1, 0, -1, 0;
  return Eigen::EigenSolver<Eigen::Matrix4d>(motion).eigenvalues().real().maxCoeff();
}

/// Violation of the goal's constraints, 0 when all hold, in the units of the working frame.
/// Float's are checked by its verdict.
double violationOf(const PropertyCase& c, const Upright& frame, const Body& body,
                   const Body& solid) {
  const Vec3 centre =
      frame.turn * (body.centre - frame.origin) / frame.length - referenceOf(c, frame);
  const double aside = centre.head<2>().cwiseAbs().maxCoeff();
  switch (c.options.goal) {
  case GoalKind::Stand:
    if (c.options.tippingAngle == 0.0) return 0.0;
    return std::max(0.0, std::tan(c.options.tippingAngle * kPi / 180) -
                             marginWithin(c, frame, centre.head<2>()) / centre.z());
  case GoalKind::PublishedStand:
    return standViolation(c, frame, body);
  case GoalKind::StandEmptyAndFilled:
    return 0.0;
  case GoalKind::Spin:
  case GoalKind::YoYo: {
    const Mat3 inertia = frame.turn * body.inertia * frame.turn.transpose();
    const double axial = (frame.turn * solid.inertia * frame.turn.transpose())(2, 2);
    const bool isYoYo = c.options.goal == GoalKind::YoYo;
    const Vec2 across = momentsAcross(inertia, isYoYo ? 0.0 : centre.z() * frame.length, body.mass);
    constexpr double kOffTheMiddle = 1e-4;
    const double between =
        kOffTheMiddle + (inertia(2, 2) - across[0]) * (across[1] - inertia(2, 2)) / (axial * axial);
    return std::max({isYoYo ? std::abs(centre.z()) : -centre.z(), aside,
                     std::abs(inertia(0, 2)) / axial, std::abs(inertia(1, 2)) / axial, between});
  }
  case GoalKind::Hang:
    return std::max(centre.z() + 0.01, aside);
  case GoalKind::Mass:
    return c.options.targetMass > 0.0 ? std::abs(body.mass - c.options.targetMass) / solid.mass
                                      : 0.0;
  case GoalKind::RollUpright:
  case GoalKind::Float:
    break;
  }
  return 0.0;
}

/// How high the centre of mass of a body of these points lies above the lowest metacentre, softly:
/// in units of the frame's length.
double aboveMetacentres(const Upright& frame, const Points& points, const Vec3& centre) {
  const auto height = [&](const Vec3& down) {
    return ((points.rowwise() - centre.transpose()) * (frame.turn.transpose() * down)).maxCoeff() /
           frame.length;
  };
  std::vector<double> above;
  for (int m = 0; m < 72; ++m) {
    const double azimuth = 5.0 * m * kPi / 180;
    const auto pose = [&](double tilt) {
      const double t = tilt * kPi / 180;
      return Vec3(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), -std::cos(t));
    };
    for (int tilt = 0; tilt < 148; tilt += 4) {
      const double rise = height(pose(tilt + 4)) - height(pose(tilt));
      above.push_back(-rise / (pose(tilt + 4) - pose(tilt)).z());
    }
  }
  const double most = *std::max_element(above.begin(), above.end());
  double sum = 0.0;
  for (const double a : above) sum += std::exp(70.0 * (a - most));
  return most + std::log(sum) / 70.0;
}

/// `points`: of the outer surface.
double objectiveOf(const PropertyCase& c, const Upright& frame, const Points& points,
                   const Body& body, const Body& filled, const Body& solid, double volumeShare) {
  const auto place = [&](const Body& b) {
    return Vec3(frame.turn * (b.centre - frame.origin) / frame.length - referenceOf(c, frame));
  };
  const auto stand = [&](const Vec3& p) { return p.head<2>().squaredNorm() + p.z(); };
  const auto tipping = [&](const Vec3& p) { return -marginWithin(c, frame, p.head<2>()) / p.z(); };
  const Vec3 centre = place(body);
  const double value = c.options.weights.volume * volumeShare;
  const Mat3 inertia = frame.turn * body.inertia * frame.turn.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(inertia.topLeftCorner<2, 2>());
  const double ratios = plane.eigenvalues().squaredNorm() / std::pow(inertia(2, 2), 2);
  switch (c.options.goal) {
  case GoalKind::Stand:
    return value + (c.options.tippingAngle > 0.0 ? body.mass / solid.mass : tipping(centre));
  case GoalKind::StandEmptyAndFilled:
    return value + std::max(tipping(centre), tipping(place(filled)));
  case GoalKind::PublishedStand:
    return value + frame.length * (frame.length * centre.head<2>().squaredNorm() + centre.z());
  case GoalKind::Hang:
    return value + stand(centre);
  case GoalKind::RollUpright:
    return value + aboveMetacentres(frame, points, body.centre);
  case GoalKind::Spin:
    return value + body.mass / solid.mass * centre.z() + ratios;
  case GoalKind::YoYo:
    return value + ratios;
  case GoalKind::Float:
    return value + centre.z();
  case GoalKind::Mass:
    return value + std::pow((body.mass - c.options.targetMass) / solid.mass, 2);
  }
  return value;
}

/// Volume below the height `level`, by cuts between the vertices' heights with three points of
/// Gauss each: the area of a cut is a quadratic function there.
double volumeBelow(const TriangleMesh& mesh, const Vec3& up, double level) {
  const Vector heights = mesh.vertices * up;
  std::vector<double> knots{level};
  for (const double h : heights)
    if (h < level) knots.push_back(h);
  std::sort(knots.begin(), knots.end());
  const Vec3 u = up.unitOrthogonal();
  const Vec3 v = up.cross(u);
  const Vec3 base = mesh.vertices.row(0).transpose();
  const auto area = [&](double z) {
    double twice = 0.0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      Vec2 in = Vec2::Zero();
      Vec2 out = Vec2::Zero();
      bool crosses = false;
      for (int k = 0; k < 3; ++k) {
        const int i = mesh.faces(f, k);
        const int j = mesh.faces(f, (k + 1) % 3);
        if ((heights[i] > z) == (heights[j] > z)) continue;
        const double t = (z - heights[i]) / (heights[j] - heights[i]);
        const Vec3 p =
            (mesh.vertices.row(i) + t * (mesh.vertices.row(j) - mesh.vertices.row(i))).transpose() -
            base;
        (heights[i] > z ? in : out) = Vec2(u.dot(p), v.dot(p));
        crosses = true;
      }
      if (crosses) twice += in.x() * out.y() - in.y() * out.x();
    }
    return twice / 2;
  };
  double volume = 0.0;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const double middle = 0.5 * (knots[k] + knots[k - 1]);
    const double half = 0.5 * (knots[k] - knots[k - 1]);
    if (half < 1e-14 * (knots.back() - knots.front())) continue;
    const double x = std::sqrt(0.6) * half;
    volume += half / 9 * (5 * area(middle - x) + 8 * area(middle) + 5 * area(middle + x));
  }
  return volume;
}

/// Density of what is in the cavity, filled in or printed, g/cm³.
double contentsOf(const PropertyCase& c) {
  return c.options.fillDensity + c.options.cavityInfill * c.options.density;
}

/// Least tipping angle, degrees, over levels of what the cavity of the body holds. `inner`: as
/// delivered, oriented into the cavity.
double leastAngleWhileFilled(const PropertyCase& c, const Upright& frame, const TriangleMesh& inner,
                             const Body& empty) {
  const Vec3 up = frame.turn.row(2).transpose();
  const Vec3 place = inner.vertices.row(0).transpose();
  const TriangleMesh near{inner.vertices.rowwise() - place.transpose(), inner.faces};
  const Vector heights = near.vertices * up;
  double least = 90.0;
  constexpr int kLevels = 40;
  for (int i = 0; i <= kLevels; ++i) {
    const double level =
        heights.minCoeff() + (heights.maxCoeff() - heights.minCoeff()) * i / kLevels;
    const Eigen::Vector4d contents = -contentsOf(c) / 1000 * momentsOfColumns(near, up, level);
    Body body = empty;
    body.mass += contents[0];
    body.centre = place + (empty.mass * (empty.centre - place) + contents.tail<3>()) / body.mass;
    least = std::min(least, tippingAngleOf(c, frame, body));
  }
  return least;
}

/// A body that is told to float as wished displaces its own weight there.
void checkFloating(const PropertyCase& c, const TriangleMesh& outer, const Result& result,
                   const Upright& frame, const Body& body, Findings& found) {
  const Vec3 up = frame.turn.row(2).transpose();
  const double ground = up.dot(frame.origin);
  const double height = (outer.vertices * up).maxCoeff() - ground;
  const double displaced = volumeBelow(outer, up, ground + c.options.waterLevel * height);
  found.near("the mass of a body that floats as wished", body.mass,
             displaced * c.options.waterDensity / 1000, 1e-5 * body.mass);
  found.near("draught_after", number(result, "draught_after"), c.options.waterLevel * height,
             0.01 * height);
  found.require(number(result, "heel_angle_after") < 1.0 &&
                    number(result, "metacentric_height_after") > 0.0,
                "solved, but the body heels");
}

void checkSurface(const PropertyCase& c, const Result& result, const TriangleMesh& outer,
                  Findings& found) {
  const TriangleMesh& inner = result.inner;
  found.require(inner.vertices.allFinite(), "the cavity has coordinates that are no numbers");
  found.require(isClosedAndOriented(inner), "the cavity is not closed and oriented");
  if (!found.sentences.empty()) return;
  found.require(hasOneFanAtEveryVertex(inner), "the cavity has a non-manifold vertex");
  if (c.floats) {
    found.require(c.options.representable(inner.vertices) == inner.vertices,
                  "the cavity has coordinates that are no floats");
  }
  const std::size_t flat = facesWithoutArea(inner);
  found.require(flat == 0, flat, " faces of the cavity have no area");
  const std::size_t own = intersectingPairs(inner);
  found.require(own == 0, own, " pairs of faces of the cavity meet");
  const std::size_t across = intersectingPairs(inner, outer);
  found.require(across == 0, across, " faces of the cavity meet the outer surface");

  // Without crossings one point tells for a whole component.
  const std::vector<TriangleMesh> parts = componentsOf(inner);
  found.require(std::get<int>(result.report.at("cavity_components")) ==
                    static_cast<int>(parts.size()),
                "the report counts other components than ", parts.size());
  const int triangles = std::get<int>(result.report.at("cavity_triangles"));
  found.require(triangles == static_cast<int>(inner.faces.rows()),
                "the report counts other triangles than ", inner.faces.rows());
  const auto& shape = std::get<std::string>(result.report.at("cavity_shape"));
  if (shape.find("best possible") == 0) {
    // Of 5°, but for the last digits.
    const int reported = std::get<int>(result.report.at("cavity_slivers"));
    found.require(facesSharperThan(inner, 4.999) <= reported &&
                      reported <= facesSharperThan(inner, 5.001),
                  "the report counts other slivers: ", reported);
  }
  for (const TriangleMesh& part : parts) {
    const Vec3 point = part.vertices.row(part.faces(0, 0)).transpose();
    found.require(std::abs(windingNumber(outer, point) - 1.0) < 1e-6,
                  "a component of the cavity is not inside of the outer surface");
    const TriangleMesh centred = transformed(part, Mat3::Identity(), -point);
    found.require(quadratureMoments(centred)[0] < 0.0,
                  "the normals of a component do not point into the cavity");
    for (const TriangleMesh& other : parts) {
      if (&other == &part) continue;
      found.require(std::abs(windingNumber(other, point)) < 1e-6,
                    "a component of the cavity lies in another one");
    }
  }

  const Separation apart = separation(inner, outer);
  found.require(apart.least >= c.wall, "the wall is ", apart.least, ", asked for ", c.wall, " (",
                apart.least / c.wall, " of it)");
  const double tolerance = 1e-9 * Upright(c.body, c.options.upAxis).length;
  found.near("min_wall", number(result, "min_wall"), apart.least, tolerance);
  found.require(result.innerWall.size() == inner.vertices.rows(), "a vertex has no wall");
  if (result.innerWall.size() != inner.vertices.rows()) return;
  for (Eigen::Index v = 0; v < inner.vertices.rows(); ++v) {
    const double got = result.innerWall[v];
    const bool fits = std::abs(got - apart.atVertex[v]) <= tolerance;
    found.require(fits, "the wall at vertex ", v, " is reported as ", got, ", measured ",
                  apart.atVertex[v]);
    if (!fits) break;
  }
}

/// Nothing of the body below the plane is left, nothing above it is lost.
void checkFoot(const PropertyCase& c, const Result& result, Findings& found) {
  const TriangleMesh& outer = *result.outer;
  found.require(isClosedAndOriented(outer), "the surface with a foot is not closed and oriented");
  const std::size_t own = intersectingPairs(outer);
  found.require(own == 0, own, " pairs of faces of the surface with a foot meet");
  const Upright frame(c.body, c.options.upAxis);
  const Points whole = c.body.vertices * frame.turn.transpose();
  const Vector heights = (outer.vertices * frame.turn.transpose()).col(2);
  const double depth = number(result, "foot_depth");
  // A mended body, which is what is cut, may be a little higher than the given one.
  const double height = c.isBroken ? heights.maxCoeff() - heights.minCoeff() + depth
                                   : whole.col(2).maxCoeff() - whole.col(2).minCoeff();
  found.require(depth <= 0.01 * height, "the foot is ", depth, " deep of ", height);
  const double roundOff =
      (c.floats ? 1e-6 : 1e-9) * (frame.length + c.body.vertices.cwiseAbs().maxCoeff());
  const double level = heights.minCoeff();
  if (!c.isBroken) {
    found.require(std::abs(level - whole.col(2).minCoeff() - depth) <= roundOff,
                  "the foot is not where it is said to be");
    const double volume = quadratureMoments(outer)[0];
    // Where there is no new cavity the old ones stay.
    const bool isOld = result.inner.faces.rows() == 0 && c.cavities.faces.rows() > 0;
    const double cut = quadratureMoments(c.body)[0] -
                       momentsOfColumns(c.body, frame.turn.transpose() * Vec3::UnitZ(), level)[0] +
                       (isOld ? quadratureMoments(c.cavities)[0] : 0.0);
    // Corners are merged within 1e-4 of the diagonal.
    found.require(std::abs(volume - cut) <= 1e-5 * std::pow(frame.length, 3),
                  "the body with a foot has the volume ", volume, " instead of ", cut);
  }
  found.require((heights.array() == level).count() >= 3, "the foot is not flat");
}

void checkOuter(const PropertyCase& c, const Result& result, Findings& found) {
  const bool moves = c.options.outerUpperBound > 0.0;
  const bool hollow = result.inner.faces.rows() > 0;
  const bool hadCavities = c.cavities.faces.rows() > 0;
  const std::string message = std::get<std::string>(result.report.at("message"));
  const bool alone = message.find("outer surface alone") != std::string::npos;
  found.require(!alone || (moves && !hollow && !hadCavities),
                "the outer surface is said to move alone without a reason");
  const bool flipped = std::get<int>(result.report.at("flipped_components")) > 0;
  found.require(c.isBroken || result.outer.has_value() ==
                                  (alone || (hollow && (moves || hadCavities || flipped))),
                result.outer ? "there is an outer surface without a reason"
                             : "the new outer surface is missing");
  if (!result.outer) return;
  const TriangleMesh& outer = *result.outer;
  found.require(isClosedAndOriented(outer), "the new outer surface is not closed and oriented");
  const std::size_t own = intersectingPairs(outer);
  found.require(own == 0, own, " pairs of faces of the new outer surface meet");
  const Upright frame(c.body, c.options.upAxis);
  const double roundOff =
      (c.floats ? 1e-6 : 1e-9) * (frame.length + c.body.vertices.cwiseAbs().maxCoeff());
  // Vertices of the body may come in another order: compare by nearest ones.
  double farthest = 0.0;
  for (Eigen::Index v = 0; v < outer.vertices.rows(); ++v) {
    const double moved =
        (c.body.vertices.rowwise() - outer.vertices.row(v)).rowwise().norm().minCoeff();
    farthest = std::max(farthest, moved);
  }
  found.require(farthest <= c.options.outerUpperBound + roundOff, "the outer surface moved by ",
                farthest, ", allowed ", c.options.outerUpperBound);
  found.require((outer.vertices * frame.turn.transpose()).col(2).minCoeff() >=
                    (frame.turn * frame.origin).z() - roundOff,
                "the new outer surface reaches below the ground");
}

} // namespace

Separation separation(const TriangleMesh& a, const TriangleMesh& b) {
  const std::vector<Triangle> ofB = trianglesOf(b);
  const BoxTree tree(ofB);
  Separation result{kInfinity, Vector(a.vertices.rows())};
  for (const Triangle& t : trianglesOf(a)) result.least = tree.distance(t, result.least);
  for (Eigen::Index v = 0; v < a.vertices.rows(); ++v) {
    const Vec3 p = a.vertices.row(v).transpose();
    result.atVertex[v] = tree.distance({p, p, p}, kInfinity);
  }
  return result;
}

bool hasFlatComponent(const TriangleMesh& mesh) {
  const double size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  const std::vector<TriangleMesh> parts = componentsOf(mesh);
  return std::any_of(parts.begin(), parts.end(), [&](const TriangleMesh& part) {
    const Vec3 near = part.vertices.row(part.faces(0, 0)).transpose();
    const double volume = quadratureMoments(transformed(part, Mat3::Identity(), -near))[0];
    return std::abs(volume) <= 1e-11 * std::pow(size, 3);
  });
}

namespace {

std::vector<std::string> brokenPromises(const PropertyCase& c, const Result& result,
                                        double touching) {
  Findings found;
  const Upright frame(c.body, c.options.upAxis, touching);
  const bool hollow = result.inner.faces.rows() > 0;
  const std::string message = std::get<std::string>(result.report.at("message"));
  found.require(!message.empty() && message.back() == '.', "the message is no sentence");
  found.require(hollow || result.inner.vertices.rows() == 0, "an empty cavity has vertices");
  found.require(message.find("The goal is reached") == std::string::npos ||
                    message.find("reach it") == std::string::npos,
                "the goal is reached and is not: ", message);
  found.require(hollow || message.find("nothing can be hollowed") != std::string::npos ||
                    message.find("no cavity") != std::string::npos,
                "the message does not say that there is no cavity: ", message);
  found.require(hollow == !(std::get<int>(result.report.at("cavity_components")) == 0),
                "cavity_components does not fit the cavity");
  found.require(hollow || std::get<int>(result.report.at("replaced_cavities")) == 0,
                "a cavity is said to be replaced by a new one that is not there");
  found.require(has(result, "largest_wall") ==
                    (message.find("nothing can be hollowed") != std::string::npos),
                "largest_wall is reported without a reason, or missing");
  checkOuter(c, result, found);
  const TriangleMesh& outer = result.outer ? *result.outer : c.body;
  if (hollow) checkSurface(c, result, outer, found);
  if (!found.sentences.empty()) return found.sentences;

  // Mass properties, from the triangles, about the middle of the contact.
  const double density = c.options.density / 1000;
  const auto about = [&](const TriangleMesh& mesh) {
    if (mesh.faces.rows() == 0) return Moments10(Moments10::Zero());
    return quadratureMoments(transformed(mesh, Mat3::Identity(), -frame.origin));
  };
  const auto bodyWith = [&](const Moments10& massMoments) {
    Body body = bodyOf(massMoments);
    body.centre += frame.origin;
    return body;
  };
  const Moments10 solidMoments = about(c.body);
  const Moments10 inputMoments = solidMoments + about(c.cavities);
  const Moments10 innerMoments = hollow ? about(result.inner) : Moments10(Moments10::Zero());
  const Moments10 afterMoments =
      hollow || result.outer ? Moments10(about(outer) + innerMoments) : inputMoments;
  const Body solid = bodyWith(density * solidMoments);
  const Body before = bodyWith(density * inputMoments);
  // Stand empty and filled reports on the empty body.
  const bool bothStates = c.options.goal == GoalKind::StandEmptyAndFilled;
  const double filling = contentsOf(c) / 1000;
  const Body after = bodyWith(density * afterMoments - (bothStates ? 0.0 : filling) * innerMoments);
  // Coordinates are used rounded to 2⁻³² of the diagonal: errors of the volume up to the area times
  // that, and relative ones that are large where little material is left.
  const auto relative = [&](const Body& body) {
    const double volume = body.mass / density;
    return 1e-9 * (areaOf(c.body) + areaOf(result.inner)) * frame.length / volume;
  };
  const Vec3 place = c.body.vertices.row(0).transpose();
  const double placeError = 1e-15 * place.norm();
  for (const bool isBefore : {true, false}) {
    const std::string suffix = isBefore ? "_before" : "_after";
    const Body& body = isBefore ? before : after;
    const double error = relative(body) + 10 * placeError / frame.length;
    const double volume = isBefore ? inputMoments[0] : afterMoments[0];
    found.near("volume" + suffix, number(result, "volume" + suffix), volume,
               error * std::max(volume, body.mass / density));
    found.near("mass" + suffix, number(result, "mass" + suffix), body.mass, error * body.mass);
    const Vec3 centre = std::get<Vec3>(result.report.at("center_of_mass" + suffix));
    found.near("the distance of center_of_mass" + suffix, (centre - body.centre).norm(), 0.0,
               error * frame.length + placeError);
    const Mat3 inertia = std::get<Mat3>(result.report.at("inertia_tensor" + suffix));
    found.near("the error of inertia_tensor" + suffix, (inertia - body.inertia).norm(), 0.0,
               4 * error * body.mass * frame.length * frame.length);
    const GoalKind goal = c.options.goal;
    if (goal == GoalKind::Stand || goal == GoalKind::PublishedStand) {
      const Vec3 c0 = frame.turn * (body.centre - frame.origin) / frame.length;
      const double angle = tippingAngleOf(c, frame, body);
      found.near("tip_angle" + suffix, number(result, "tip_angle" + suffix), angle,
                 (1e-6 + 10 * error / std::max(c0.norm(), 1e-3)) * 180 / kPi);
      found.require(std::get<bool>(result.report.at("stands" + suffix)) ==
                        (number(result, "tip_angle" + suffix) > 0.0),
                    "stands", suffix, " does not fit tip_angle", suffix);
    } else if (goal == GoalKind::Mass && c.options.targetMass > 0.0) {
      found.near("mass_error" + suffix, number(result, "mass_error" + suffix),
                 body.mass - c.options.targetMass, error * body.mass + 1e-8 * solid.mass);
    } else if (goal == GoalKind::Hang) {
      const Vec3 arm =
          frame.turn * (body.centre - frame.origin) / frame.length - referenceOf(c, frame);
      found.near("hanging_angle" + suffix, number(result, "hanging_angle" + suffix),
                 std::atan2(arm.head<2>().norm(), -arm.z()) * 180 / kPi,
                 (1e-6 + 10 * error / std::max(arm.norm(), 1e-3)) * 180 / kPi);
    } else if (goal == GoalKind::Spin || goal == GoalKind::YoYo) {
      const Vec3 c0 =
          frame.turn * (body.centre - frame.origin) / frame.length - referenceOf(c, frame);
      found.near("axis_offset" + suffix, number(result, "axis_offset" + suffix),
                 c0.head<2>().norm() * frame.length, error * frame.length + placeError);
      const Mat3 upright = frame.turn * body.inertia * frame.turn.transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(upright.topLeftCorner<2, 2>());
      const double inertiaError =
          10 * error * body.mass * std::pow(frame.length, 2) / plane.eigenvalues()[0];
      const double ratioA = upright(2, 2) / plane.eigenvalues()[1];
      const double ratioB = upright(2, 2) / plane.eigenvalues()[0];
      found.near("moment_ratio_a" + suffix, number(result, "moment_ratio_a" + suffix), ratioA,
                 inertiaError * ratioA);
      found.near("moment_ratio_b" + suffix, number(result, "moment_ratio_b" + suffix), ratioB,
                 inertiaError * ratioB);
    }
  }

  // Objective, constraints and verdict.
  const double error = relative(after) + relative(before) + 10 * placeError / frame.length;
  const double inertiaError = 100 * error; // by an I_zz that may be small
  const GoalKind goal = c.options.goal;
  const bool isSpin = goal == GoalKind::Spin || goal == GoalKind::YoYo;
  // A solid body has no cavity to fill, but those that it came with count as cavity.
  const Body filledBefore = bodyWith((density - filling) * inputMoments + filling * solidMoments);
  const Body filled = hollow || result.outer
                          ? bodyWith(density * afterMoments - filling * innerMoments)
                          : filledBefore;
  const double leastAngle =
      bothStates && hollow ? leastAngleWhileFilled(c, frame, result.inner, after) : 0.0;
  const double violationBefore = violationOf(c, frame, before, solid);
  const double violationAfter = violationOf(c, frame, after, solid);
  const double told = number(result, "max_constraint_violation");
  const bool exact = goal != GoalKind::Float;
  // A soft minimum over up to 2 × 136 directions, 5° apart, stands for the tipping angle.
  const bool isSoft = (goal == GoalKind::Stand && c.options.tippingAngle == 0.0) ||
                      goal == GoalKind::StandEmptyAndFilled;
  const double slack = 1e-8 + (isSpin ? inertiaError : 10 * error);
  found.require(told >= violationAfter - slack && (!exact || told <= violationAfter + slack),
                "max_constraint_violation is ", told, ", measured ", violationAfter);
  const bool solved = std::get<bool>(result.report.at("solved"));
  if (solved) {
    found.require(violationAfter <= 1e-6 + slack, "solved, with a violation of ", violationAfter);
    if (isSpin) {
      found.require(number(result, "axis_tilt_after") < 0.5 &&
                        number(result, "axis_offset_after") < 1e-3 * frame.length,
                    "solved, but the top wobbles");
      const Mat3 upright = frame.turn * after.inertia * frame.turn.transpose();
      const double height = (frame.turn * (after.centre - frame.origin)).z();
      for (const double factor : {1.01, 2.0, 10.0}) {
        const double growth =
            growthOfTop(upright, height, after.mass, factor * c.options.spinSpeed);
        found.require(goal != GoalKind::Spin || growth < 1e-6, "solved, but at ", factor,
                      " times the hand's speed disturbances grow by ", growth);
      }
    } else if (goal == GoalKind::Stand || goal == GoalKind::PublishedStand) {
      found.require(number(result, "tip_angle_after") > 0.0 &&
                        number(result, "tip_angle_after") >= c.options.tippingAngle - 1e-4,
                    "solved, but the body falls over");
    } else if (goal == GoalKind::StandEmptyAndFilled) {
      found.require(number(result, "tip_angle_empty_after") > 0.0 &&
                        number(result, "tip_angle_filled_after") > 0.0 &&
                        (!hollow || leastAngle > 0.0),
                    "solved, but the body falls over");
    } else if (goal == GoalKind::RollUpright) {
      found.require(std::get<int>(result.report.at("resting_faces_after")) == 1,
                    "solved, but it rests on several faces");
    } else if (goal == GoalKind::Float) {
      checkFloating(c, outer, result, frame, after, found);
    }
  }
  if (exact) {
    const double unit = goal == GoalKind::PublishedStand ? frame.length : 1.0;
    // Empty, full, and as many levels of contents as the search for the best possible one looks at.
    const double states = bothStates ? std::log(102.0) / 70.0 : 0.0;
    // Metacentres are heights over steps of cos 4°: rounded coordinates count 400 times.
    // The weighted share of the volume has no unit.
    const double objectiveSlack = (isSoft ? std::log(136.0) / 70.0 + states : 1e-8 * unit) +
                                  1e-8 * c.options.weights.volume +
                                  inertiaError * std::max(unit, unit * unit) +
                                  (goal == GoalKind::RollUpright ? 1e3 * error : 0.0);
    const bool nothingViolated = violationBefore == 0.0 && violationAfter <= 1e-7;
    if (nothingViolated) {
      found.near("objective_before", number(result, "objective_before"),
                 objectiveOf(c, frame, c.body.vertices, before, filledBefore, solid,
                             inputMoments[0] / solidMoments[0]),
                 objectiveSlack);
      const double share = afterMoments[0] / solidMoments[0];
      double expected = objectiveOf(c, frame, outer.vertices, after, filled, solid, share);
      if (bothStates && hollow) {
        expected =
            std::max(expected, c.options.weights.volume * share - std::tan(leastAngle * kPi / 180));
      }
      found.near("objective_after", number(result, "objective_after"), expected, objectiveSlack);
    }
  }
  // Never worse: less violation, or constraints that hold and a lower objective.
  if (hollow) {
    // Where the verdict is one number and nothing else counts, that decides.
    const bool isMeasured = c.options.weights.volume == 0.0 && c.options.outerUpperBound == 0.0;
    const auto angle = [&](const std::string& suffix) {
      return goal == GoalKind::Stand ? number(result, "tip_angle_" + suffix)
                                     : std::min(number(result, "tip_angle_empty_" + suffix),
                                                number(result, "tip_angle_filled_" + suffix));
    };
    const bool better = isSoft && isMeasured ? angle("after") > angle("before")
                                             : number(result, "objective_after") <
                                                   number(result, "objective_before");
    const bool feasible = told <= 1e-6 && (!exact || violationBefore <= 1e-6 + slack);
    if (exact) {
      found.require(violationAfter <= std::max(violationBefore, 1e-6) + slack,
                    "the constraints are violated more than by the solid: ", violationAfter,
                    " against ", violationBefore);
    }
    if (feasible && violationBefore <= 1e-6 - slack) {
      found.require(better, "the objective rose from ", number(result, "objective_before"), " to ",
                    number(result, "objective_after"));
    }
    // No cavity is better than the best one; the cells know it to about a per cent of the gain.
    if (isSoft && isMeasured && has(result, "objective_limit")) {
      const double limit = bothStates ? number(result, "tip_angle_filling_limit") : angle("limit");
      const double beyond = (bothStates ? leastAngle : angle("after")) - limit;
      found.require(beyond <= 0.02 * std::abs(limit - angle("before")) + 1e-4,
                    "better than the limit ", limit, " by ", beyond);
    } else if (has(result, "objective_limit") && told <= 1e-6 && feasible) {
      const double limit = number(result, "objective_limit");
      const double beyond = limit - number(result, "objective_after");
      found.require(beyond <= 0.02 * std::abs(number(result, "objective_before") - limit) + 1e-7,
                    "better than the limit ", limit, " by ", beyond);
    }
  } else {
    if (!result.outer) {
      found.near("volume_after without a cavity", number(result, "volume_after"),
                 number(result, "volume_before"), 0.0);
    }
  }
  return found.sentences;
}

} // namespace

std::vector<std::string> brokenPromises(const PropertyCase& c, const Result& result) {
  if (!has(result, "foot_depth") || number(result, "foot_depth") == 0.0)
    return brokenPromises(c, result, kTouching);
  Findings found;
  if (!result.outer) return {"the surface with a foot is missing"};
  checkFoot(c, result, found);
  // Of existing cavities some may count as filled, and others stay where there is no new one.
  if (!found.sentences.empty() || c.cavities.faces.rows() > 0) return found.sentences;
  // From here on it is the body.
  PropertyCase footed = c;
  footed.body = *result.outer;
  footed.isBroken = true; // so that an outer surface is no wonder
  return brokenPromises(footed, result, 0.0);
}

} // namespace massprops::testing
