#include "core/mesh/annotations.h"

#include "core/base/angles.h"

#include <cmath>

namespace massprops {
namespace {

/// Of the diagonal.
constexpr double kBallRadius = 0.015;
constexpr double kBroadPen = 0.003;
constexpr double kFinePen = 0.0007;

} // namespace

Annotations::Annotations(const Points& outer) {
  for (Eigen::Index v = 0; v < outer.rows(); ++v) box_.extend(Vec3(outer.row(v).transpose()));
}

int Annotations::addVertex(const Vec3& point, Colour colour) {
  points_.push_back(point);
  colours_.push_back(colour);
  return static_cast<int>(points_.size()) - 1;
}

void Annotations::addBall(const Vec3& centre, Colour colour) {
  constexpr int kMeridians = 24;
  const int rings = kMeridians / 2 - 1; // without the poles, as far apart
  const double radius = kBallRadius * box_.diagonal().norm();
  const int south = addVertex(centre - radius * Vec3::UnitZ(), colour);
  for (int ring = 0; ring < rings; ++ring) {
    const double latitude = kPi * ((ring + 1.0) / (rings + 1.0) - 0.5);
    for (int i = 0; i < kMeridians; ++i) {
      const double longitude = 2.0 * kPi * i / kMeridians;
      addVertex(centre + radius * Vec3(std::cos(latitude) * std::cos(longitude),
                                       std::cos(latitude) * std::sin(longitude),
                                       std::sin(latitude)),
                colour);
    }
  }
  const int north = addVertex(centre + radius * Vec3::UnitZ(), colour);
  for (int i = 0; i < kMeridians; ++i) {
    const auto at = [&](int ring, int place) { return south + 1 + kMeridians * ring + place; };
    const int next = (i + 1) % kMeridians;
    faces_.emplace_back(south, at(0, next), at(0, i));
    for (int ring = 0; ring + 1 < rings; ++ring) {
      faces_.emplace_back(at(ring, i), at(ring, next), at(ring + 1, next));
      faces_.emplace_back(at(ring, i), at(ring + 1, next), at(ring + 1, i));
    }
    faces_.emplace_back(at(rings - 1, i), at(rings - 1, next), north);
  }
}

void Annotations::addLine(const Vec3& from, const Vec3& to, Colour colour, Pen pen) {
  if (from == to) return;
  constexpr int kSides = 6;
  const double radius = (pen == Pen::Broad ? kBroadPen : kFinePen) * box_.diagonal().norm();
  const Vec3 along = (to - from).normalized();
  const Vec3 u = along.unitOrthogonal();
  const Vec3 w = along.cross(u);
  const int first = static_cast<int>(points_.size());
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * kPi * i / kSides;
    const Vec3 out = radius * (std::cos(angle) * u + std::sin(angle) * w);
    addVertex(from + out, colour);
    addVertex(to + out, colour);
  }
  const auto at = [&](int side, int end) { return first + 2 * (side % kSides) + end; };
  for (int i = 0; i < kSides; ++i) {
    faces_.emplace_back(at(i, 0), at(i + 1, 0), at(i + 1, 1));
    faces_.emplace_back(at(i, 0), at(i + 1, 1), at(i, 1));
  }
  for (int i = 1; i + 1 < kSides; ++i) {
    faces_.emplace_back(at(0, 0), at(i + 1, 0), at(i, 0));
    faces_.emplace_back(at(0, 1), at(i, 1), at(i + 1, 1));
  }
}

void Annotations::addLoop(const std::vector<Vec3>& corners, Colour colour) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    addLine(corners[i], corners[(i + 1) % corners.size()], colour);
  }
}

ColouredMesh Annotations::mesh() const {
  ColouredMesh result;
  result.mesh.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
  for (std::size_t v = 0; v < points_.size(); ++v) {
    result.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points_[v].transpose();
  }
  result.mesh.faces.resize(static_cast<Eigen::Index>(faces_.size()), 3);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    result.mesh.faces.row(static_cast<Eigen::Index>(f)) = faces_[f];
  }
  result.colours = colours_;
  return result;
}

} // namespace massprops
