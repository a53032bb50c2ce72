#include "core/query/winding_number.h"

#include "core/base/angles.h"
#include "core/base/triangle.h"
#include "core/query/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Of the triangle seen from the origin, signed: positive from behind. [VOS83, Eq. 8]
double solidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

} // namespace

WindingNumber::WindingNumber(const Points& vertices, const Faces& faces)
    : corners_(3 * faces.rows(), 3) {
  if (faces.rows() == 0) return;
  Eigen::Index row = 0;
  for (const int f : spatialOrder(vertices, faces)) {
    for (int k = 0; k < 3; ++k) corners_.row(row++) = vertices.row(faces(f, k));
  }
  build(0, faces.rows());
}

int WindingNumber::build(Eigen::Index begin, Eigen::Index end) {
  constexpr Eigen::Index kLeaf = 8;
  const int number = static_cast<int>(nodes_.size());
  nodes_.push_back({Vec3::Zero(), Vec3::Zero(), 0.0, begin, end, -1});
  Node node = nodes_.back();
  double area = 0.0;
  for (Eigen::Index t = begin; t < end; ++t) {
    const Vec3 a = corners_.row(3 * t).transpose();
    const Vec3 b = corners_.row(3 * t + 1).transpose();
    const Vec3 c = corners_.row(3 * t + 2).transpose();
    const Vec3 normal = 0.5 * areaNormal(a, b, c);
    node.areaNormal += normal;
    node.centre += normal.norm() / 3.0 * (a + b + c);
    area += normal.norm();
  }
  if (area > 0.0) {
    node.centre /= area;
  } else {
    node.centre = corners_.row(3 * begin).transpose();
  }
  node.radius = std::sqrt(
      (corners_.middleRows(3 * begin, 3 * (end - begin)).rowwise() - node.centre.transpose())
          .rowwise()
          .squaredNorm()
          .maxCoeff());
  if (end - begin > kLeaf) {
    const Eigen::Index middle = begin + (end - begin) / 2;
    build(begin, middle);
    node.right = build(middle, end);
  }
  nodes_[static_cast<std::size_t>(number)] = node;
  return number;
}

double WindingNumber::at(const Vec3& p) const {
  constexpr double kFar = 2.5; // radii
  double angle = 0.0;
  int stack[128];
  int size = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const int number = stack[--size];
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    const Vec3 way = node.centre - p;
    const double distance = way.norm();
    if (distance > kFar * node.radius) {
      angle += node.areaNormal.dot(way) / (distance * distance * distance);
    } else if (node.right < 0) {
      for (Eigen::Index t = node.begin; t < node.end; ++t) {
        angle +=
            solidAngle(corners_.row(3 * t).transpose() - p, corners_.row(3 * t + 1).transpose() - p,
                       corners_.row(3 * t + 2).transpose() - p);
      }
    } else {
      stack[size++] = number + 1;
      stack[size++] = node.right;
    }
  }
  return angle / (4.0 * kPi);
}

} // namespace massprops
