#include "core/query/spatial_order.h"

#include "core/base/interruption.h"
#include "core/base/parallel.h"

#include <algorithm>

namespace massprops {
namespace {

struct Centre {
  float position[3];
  int face;
};

/// Orders the centres for the leaves first … first + count − 1 of all `leaves`, which hold `all`
/// triangles together.
void cut(std::vector<Centre>& centres, Eigen::Index first, Eigen::Index count,
         Eigen::Index leaves) {
  if (count == 1) return;
  constexpr Eigen::Index kWorthAThread = 4096;
  if (count >= kWorthAThread) checkpoint();
  const auto all = static_cast<Eigen::Index>(centres.size());
  const auto place = [&](Eigen::Index leaf) { return centres.begin() + leaf * all / leaves; };
  float lower[3] = {1e30F, 1e30F, 1e30F};
  float upper[3] = {-1e30F, -1e30F, -1e30F};
  for (auto c = place(first); c != place(first + count); ++c) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], c->position[k]);
      upper[k] = std::max(upper[k], c->position[k]);
    }
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (upper[k] - lower[k] > upper[axis] - lower[axis]) axis = k;
  }
  const Eigen::Index ofRoot = leavesOfRoot(leaves);
  const Eigen::Index half = count > ofRoot ? count / ofRoot / 2 * ofRoot : count / 2;
  std::nth_element(place(first), place(first + half), place(first + count),
                   [axis](const Centre& a, const Centre& b) {
                     return a.position[axis] < b.position[axis] ||
                            (a.position[axis] == b.position[axis] && a.face < b.face);
                   });
  const auto left = [&] { cut(centres, first, half, leaves); };
  const auto right = [&] { cut(centres, first + half, count - half, leaves); };
  if (count == leaves && leaves >= kWorthAThread) {
    inParallel(left, right);
  } else {
    left();
    right();
  }
}

} // namespace

bool isLarge(Eigen::Index triangles) {
  constexpr Eigen::Index kLarge = 500000;
  return triangles > kLarge;
}

Eigen::Index leafCount(Eigen::Index triangles) {
  constexpr Eigen::Index kMostRoots = 16;
  Eigen::Index leaves = 1;
  if (!isLarge(triangles)) {
    while (4 * leaves < triangles) leaves *= 2;
    return leaves;
  }
  Eigen::Index below = 1; // a root
  while (4 * kMostRoots * below < triangles) below *= 4;
  return (triangles + 4 * below - 1) / (4 * below) * below;
}

Eigen::Index leavesOfRoot(Eigen::Index leaves) {
  Eigen::Index below = 1;
  while (leaves % (4 * below) == 0) below *= 4;
  return below;
}

std::vector<int> spatialOrder(const Points& vertices, const Faces& faces) {
  std::vector<Centre> centres(static_cast<std::size_t>(faces.rows()));
  // Relative to the box, for a float has few digits. Vertices that no face uses are not looked at:
  // there may be many more of them than faces.
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    box.extend(Vec3(vertices.row(faces.data()[i]).transpose()));
  }
  const Eigen::RowVector3d origin = box.min().transpose();
  const double size = faces.rows() > 0 ? (box.max() - box.min()).maxCoeff() : 0.0;
  const double scale = size > 0.0 ? 1.0 / size : 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::RowVector3d sum =
        vertices.row(faces(f, 0)) + vertices.row(faces(f, 1)) + vertices.row(faces(f, 2));
    const Eigen::RowVector3f centre = ((sum - 3.0 * origin) * scale).cast<float>();
    centres[static_cast<std::size_t>(f)] = {{centre[0], centre[1], centre[2]}, static_cast<int>(f)};
  }
  const Eigen::Index leaves = leafCount(faces.rows());
  cut(centres, 0, leaves, leaves);
  std::vector<int> order(centres.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = centres[i].face;
  return order;
}

} // namespace massprops
