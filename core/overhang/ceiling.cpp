#include "core/overhang/ceiling.h"

#include "core/mesh/components.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/overhang/layer_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// Pixels are inside where a triangle covers their middle.
void paint(const Points& corners, int columns, std::vector<float>& image) {
  const Eigen::RowVector3d low = corners.colwise().minCoeff();
  const Eigen::RowVector3d high = corners.colwise().maxCoeff();
  const auto side = [&](int from, int to, double x, double y) {
    return (corners(to, 0) - corners(from, 0)) * (y - corners(from, 1)) -
           (corners(to, 1) - corners(from, 1)) * (x - corners(from, 0));
  };
  for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y) {
    for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x) {
      const double least = std::min({side(0, 1, x, y), side(1, 2, x, y), side(2, 0, x, y)});
      if (least >= 0.0) image[at(x + columns * y)] = 1.0F;
    }
  }
}

/// Of the circle that fits into what these faces cover, seen from above; only whether it is wider
/// than `known` matters.
double spanOf(const Points& vertices, const Faces& faces, double known) {
  constexpr double kPixels = 200.0; // along the longer side
  constexpr int kMargin = 2;
  Points corners(faces.size(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) corners.row(3 * f + k) = vertices.row(faces(f, k));
  }
  const Eigen::RowVector3d low = corners.colwise().minCoeff();
  const Eigen::RowVector2d extent = (corners.colwise().maxCoeff() - low).head<2>();
  if (extent.minCoeff() <= known) return 0.0;
  const double pixel = extent.maxCoeff() / kPixels;
  corners = (corners.rowwise() - low) / pixel;
  corners.array() += kMargin;
  const int columns = static_cast<int>(std::ceil(extent.x() / pixel)) + 2 * kMargin + 1;
  const int rows = static_cast<int>(std::ceil(extent.y() / pixel)) + 2 * kMargin + 1;
  std::vector<float> image(at(columns) * at(rows), -1.0F);
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    paint(corners.middleRows(3 * f, 3), columns, image);
  LayerDistance distance(columns, rows);
  distance.measure(image);
  if (!distance.hasBorder()) return 0.0;
  const float radius = *std::max_element(distance.distances().begin(), distance.distances().end());
  return 2.0 * pixel * static_cast<double>(radius);
}

/// Minima of the height under what is above: each is born with its lowest vertex, and ends where
/// it meets one that is lower.
std::vector<int> tipsOf(const Points& vertices, const Faces& faces,
                        const std::vector<char>& isCeiling, double depth) {
  const VertexAdjacency neighbours = vertexAdjacency(vertices.rows(), faces);
  std::vector<int> order(at(vertices.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto isLower = [&](int a, int b) {
    return vertices(a, 2) < vertices(b, 2) || (vertices(a, 2) == vertices(b, 2) && a < b);
  };
  std::sort(order.begin(), order.end(), isLower);
  std::vector<int> parent(order.size(), -1); // −1: not reached yet; the root is the lowest
  const auto rootOf = [&](int v) {
    while (parent[at(v)] != v) v = parent[at(v)] = parent[at(parent[at(v)])];
    return v;
  };
  std::vector<int> tips;
  for (const int v : order) {
    parent[at(v)] = v;
    for (const int w : neighbours[at(v)]) {
      if (parent[at(w)] < 0) continue;
      int higher = rootOf(v);
      int lower = rootOf(w);
      if (higher == lower) continue;
      if (isLower(higher, lower)) std::swap(higher, lower);
      if (isCeiling[at(higher)] != 0 && vertices(v, 2) - vertices(higher, 2) > depth)
        tips.push_back(higher);
      parent[at(higher)] = lower;
    }
  }
  return tips;
}

} // namespace

Ceiling ceilingOf(const TriangleMesh& cavity, const Mat3& toPrint, double angle, double depth) {
  const Points vertices = cavity.vertices * toPrint.transpose();
  const Faces& faces = cavity.faces;
  std::vector<char> isCeiling(at(vertices.rows()), 0);
  Vector up = Vector::Zero(vertices.rows());
  Faces flat(faces.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 a = vertices.row(faces(f, 0)).transpose();
    const Vec3 b = vertices.row(faces(f, 1)).transpose();
    const Vec3 c = vertices.row(faces(f, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a);
    for (const int v : faces.row(f)) up[v] += normal.z();
    if (normal.z() > std::cos(angle) * normal.norm()) flat.row(count++) = faces.row(f);
  }
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) isCeiling[at(v)] = up[v] > 0.0 ? 1 : 0;
  Ceiling result;
  for (const Faces& place : connectedComponents(vertices.rows(), Faces(flat.topRows(count))))
    result.widestSpan = std::max(result.widestSpan, spanOf(vertices, place, result.widestSpan));
  for (const int v : tipsOf(vertices, faces, isCeiling, depth))
    result.tips.emplace_back(cavity.vertices.row(v).transpose());
  return result;
}

} // namespace massprops
