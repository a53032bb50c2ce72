#include "judge/layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

/// Columns of cubes, each hollow between the even and the odd crossings of the cavity's surface.
class Cubes {
public:
  Cubes(const TriangleMesh& cavity, double side) : side_(side) {
    const Vec3 low = cavity.vertices.colwise().minCoeff().transpose();
    const Vec3 high = cavity.vertices.colwise().maxCoeff().transpose();
    counts_ = ((high - low) / side).array().ceil().cast<int>() + 2;
    // Off the places that models like.
    origin_ = low - side * Vec3(0.987, 0.971, 0.993);
    hollow_.assign(static_cast<std::size_t>(counts_.prod()), 0);
    std::vector<std::vector<double>> crossings(static_cast<std::size_t>(counts_.x() * counts_.y()));
    for (Eigen::Index f = 0; f < cavity.faces.rows(); ++f) {
      addCrossings(cavity.vertices.row(cavity.faces(f, 0)).transpose(),
                   cavity.vertices.row(cavity.faces(f, 1)).transpose(),
                   cavity.vertices.row(cavity.faces(f, 2)).transpose(), crossings);
    }
    for (int j = 0; j < counts_.y(); ++j) {
      for (int i = 0; i < counts_.x(); ++i) {
        std::vector<double>& heights = crossings[static_cast<std::size_t>(i + counts_.x() * j)];
        std::sort(heights.begin(), heights.end());
        for (std::size_t c = 0; c + 1 < heights.size(); c += 2) {
          for (int k = 0; k < counts_.z(); ++k) {
            const double z = origin_.z() + side * k;
            if (z > heights[c] && z < heights[c + 1]) hollow_[at(i, j, k)] = 1;
          }
        }
      }
    }
  }

  Eigen::Array3i counts() const { return counts_; }
  bool isHollow(int i, int j, int k) const { return hollow_[at(i, j, k)] != 0; }
  bool isMaterial(int i, int j, int k) const {
    const bool isOutside = i < 0 || j < 0 || k < 0 || i >= counts_.x() || j >= counts_.y();
    return isOutside || !isHollow(i, j, k);
  }

private:
  std::size_t at(int i, int j, int k) const {
    return static_cast<std::size_t>(i + counts_.x() * (j + counts_.y() * k));
  }

  void addCrossings(const Vec3& a, const Vec3& b, const Vec3& c,
                    std::vector<std::vector<double>>& crossings) const {
    const Vec3 low = (a.cwiseMin(b).cwiseMin(c) - origin_) / side_;
    const Vec3 high = (a.cwiseMax(b).cwiseMax(c) - origin_) / side_;
    const auto cross = [](const Vec3& u, const Vec3& v) { return u.x() * v.y() - u.y() * v.x(); };
    const double area = cross(b - a, c - a);
    if (area == 0.0) return;
    for (int j = static_cast<int>(std::ceil(low.y())); j <= high.y(); ++j) {
      for (int i = static_cast<int>(std::ceil(low.x())); i <= high.x(); ++i) {
        const Vec3 p = origin_ + side_ * Vec3(i, j, 0);
        const double u = cross(c - b, p - b) / area;
        const double v = cross(a - c, p - c) / area;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        crossings[static_cast<std::size_t>(i + counts_.x() * j)].push_back(u * a.z() + v * b.z() +
                                                                           (1.0 - u - v) * c.z());
      }
    }
  }

  double side_;
  Vec3 origin_;
  Eigen::Array3i counts_;
  std::vector<char> hollow_;
};

/// In cubes, at most ten.
double reachOf(const Cubes& cubes, int i, int j, int below) {
  constexpr int kMost = 10;
  double least = kMost;
  for (int y = -kMost; y <= kMost; ++y) {
    for (int x = -kMost; x <= kMost; ++x) {
      if (cubes.isMaterial(i + x, j + y, below))
        least = std::min(least, std::hypot(static_cast<double>(x), static_cast<double>(y)));
    }
  }
  return least;
}

/// Whether something below the piece of a layer around this cube, or beside that, is material;
/// marks the piece.
bool stands(const Cubes& cubes, int i, int j, int k, std::vector<char>& isSeen) {
  const int columns = cubes.counts().x();
  const auto place = [&](int x, int y) { return static_cast<std::size_t>(x + columns * y); };
  std::vector<std::pair<int, int>> piece{{i, j}};
  isSeen[place(i, j)] = 1;
  bool result = false;
  for (std::size_t n = 0; n < piece.size(); ++n) {
    const auto [x, y] = piece[n];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        result = result || cubes.isMaterial(x + dx, y + dy, k - 1);
        if (std::abs(dx) + std::abs(dy) != 1) continue;
        const int u = x + dx;
        const int v = y + dy;
        if (u < 0 || v < 0 || u >= columns || v >= cubes.counts().y()) continue;
        if (cubes.isHollow(u, v, k) || isSeen[place(u, v)] != 0) continue;
        isSeen[place(u, v)] = 1;
        piece.emplace_back(u, v);
      }
    }
  }
  return result;
}

} // namespace

Overhang overhangOf(const TriangleMesh& cavity, double side) {
  const Cubes cubes(cavity, side);
  Overhang result;
  for (int k = 1; k < cubes.counts().z(); ++k) {
    std::vector<char> isSeen(static_cast<std::size_t>(cubes.counts().x() * cubes.counts().y()), 0);
    for (int j = 0; j < cubes.counts().y(); ++j) {
      for (int i = 0; i < cubes.counts().x(); ++i) {
        if (cubes.isHollow(i, j, k)) continue;
        if (isSeen[static_cast<std::size_t>(i + cubes.counts().x() * j)] == 0 &&
            !stands(cubes, i, j, k, isSeen)) {
          ++result.islands;
        }
        if (cubes.isHollow(i, j, k - 1))
          result.reach = std::max(result.reach, side * reachOf(cubes, i, j, k - 1));
      }
    }
  }
  return result;
}

} // namespace massprops::testing
