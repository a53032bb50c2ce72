#include "core/query/grid_sampling.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace massprops {
namespace {

/// Values at the nodes of a block, by halves where they vanish.
class BlockSampler {
public:
  BlockSampler(SignedLength length, const Grid& grid, std::vector<float>& values)
      : length_(std::move(length)), grid_(grid), values_(values) {}

  void visit(const Eigen::Array3i& low, int size) {
    const Eigen::Array3i high = (low + size).min(grid_.counts);
    if ((high <= low).any()) return;
    const int half = size / 2;
    const Eigen::Array3i middle = (low + half).min(grid_.counts - 1);
    const double radius = std::sqrt(3.0) * half;
    const double value = length_(grid_.positionOf(middle.x(), middle.y(), middle.z()),
                                 (radius + kSampledBand) * grid_.edge) /
                         grid_.edge;
    if (size == 1 || std::abs(value) >= radius + kSampledBand) {
      const float kept = std::clamp(static_cast<float>(value), -kSampledBand, kSampledBand);
      for (int k = low.z(); k < high.z(); ++k) {
        for (int j = low.y(); j < high.y(); ++j) {
          std::fill_n(values_.begin() + grid_.nodeAt(low.x(), j, k), high.x() - low.x(), kept);
        }
      }
      return;
    }
    for (int i = 0; i < 8; ++i) visit(low + half * Eigen::Array3i(i & 1, i >> 1 & 1, i >> 2), half);
  }

private:
  SignedLength length_;
  const Grid& grid_;
  std::vector<float>& values_;
};

} // namespace

Grid gridAround(const Points& points, const Mat3& rotation, double edge, double mostNodes) {
  const Points turned = points * rotation.transpose();
  const Vec3 low = turned.colwise().minCoeff().transpose();
  const Vec3 high = turned.colwise().maxCoeff().transpose();
  const auto gridOf = [&](double wanted) {
    Grid grid;
    grid.rotation = rotation;
    grid.edge = wanted;
    grid.origin = low - Vec3::Constant(kSampledBand * wanted);
    grid.counts =
        ((high - low) / wanted).array().ceil().cast<int>() + 2 * static_cast<int>(kSampledBand) + 1;
    return grid;
  };
  const Grid grid = gridOf(edge);
  const auto nodes = static_cast<double>(grid.nodes());
  return nodes > mostNodes ? gridOf(edge * std::cbrt(nodes / mostNodes)) : grid;
}

std::vector<float> sampled(const Grid& grid, const std::function<SignedLength()>& makeLength) {
  constexpr int kBlock = 16;
  std::vector<float> values(static_cast<std::size_t>(grid.nodes()));
  const Eigen::Array3i blocks = (grid.counts + kBlock - 1) / kBlock;
  forChunks(blocks.prod(), 1, [&](const Chunk& chunk) {
    const auto n = static_cast<int>(chunk.number);
    const Eigen::Array3i block(n % blocks.x(), n / blocks.x() % blocks.y(),
                               n / (blocks.x() * blocks.y()));
    BlockSampler(makeLength(), grid, values).visit(kBlock * block, kBlock);
  });
  return values;
}

} // namespace massprops
