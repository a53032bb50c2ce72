#include "core/optimum/admissible_cells.h"

#include "core/base/cube_cut.h"
#include "core/base/parallel.h"
#include "core/physics/moments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace massprops {
namespace {

/// Integrals over a cube of volume `volume` that is centred at p and as wide as `edge`.
Moments cubeMoments(const Vec3& p, double edge, double volume) {
  const double spread = edge * edge / 12.0;
  Moments m;
  m << 1.0, p, p.cwiseAbs2() + Vec3::Constant(spread), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return volume * m;
}

/// Where a function with these values and slopes at the corners of a cube is positive. In each of
/// its eighths it is taken as a plane: in the eighth's middle the mean of what the corner's tangent
/// and the trilinear interpolation tell, whose errors of second order are opposite and equal.
Moments positivePart(const std::array<Sample, 8>& samples, const Vec3& low, double edge) {
  const double half = 0.5 * edge;
  Moments sum = Moments::Zero();
  for (int i = 0; i < 8; ++i) {
    const Sample& own = samples[static_cast<std::size_t>(i)];
    double trilinear = 0.0;
    for (int j = 0; j < 8; ++j) {
      double weight = 1.0;
      for (int k = 0; k < 3; ++k) weight *= (i >> k & 1) == (j >> k & 1) ? 0.75 : 0.25;
      trilinear += weight * samples[static_cast<std::size_t>(j)].value;
    }
    const Vec3 middle = 0.25 * Vec3::Ones() + 0.5 * cornerStep(i).cast<double>();
    const double tangent = own.value + edge * own.slope.dot(middle - cornerStep(i).cast<double>());
    const CubeCut cut = cubeCut(own.slope, -0.5 * (tangent + trilinear) / half);
    if (cut.volume <= 0.0) continue;
    sum += cubeMoments(low + edge * middle + half * cut.centroid, half,
                       cut.volume * std::pow(half, 3));
  }
  return sum;
}

/// How many halvings of a cell make one of the region's cubes.
int levelOfCells(const FeasibleRegion& region, double most) {
  const double cubes = region.extent.prod() / std::pow(region.edge, 3);
  return std::max(0, static_cast<int>(std::lround(std::log2(cubes / most) / 3.0)));
}

} // namespace

AdmissibleCells admissibleCells(const FeasibleRegion& region, Admissible which, double most) {
  const int level = levelOfCells(region, most);
  std::vector<Place> places;
  std::vector<Moments> cells;
  PlaceNumbers known;
  const auto cellAt = [&](const Place& cube) -> Moments& {
    const Place place = cube.array().unaryExpr([&](int i) { return i >> level; });
    const auto placeOf = [&](int i) { return places[static_cast<std::size_t>(i)]; };
    int number = known.find(place, placeOf);
    if (number < 0) {
      known.add(place, placeOf);
      number = static_cast<int>(places.size());
      places.push_back(place);
      cells.emplace_back(Moments::Zero());
    }
    return cells[static_cast<std::size_t>(number)];
  };
  for (const WholeCube& cube : region.whole) {
    const int part = std::min(cube.level, level);
    const double edge = region.edge * (1 << part);
    const int across = 1 << (cube.level - part);
    for (int i = 0; i < across * across * across; ++i) {
      const Place step(i % across, i / across % across, i / (across * across));
      const Place place = cube.place + (1 << part) * step;
      cellAt(place) += cubeMoments(region.positionOf(place) + Vec3::Constant(0.5 * edge), edge,
                                   edge * edge * edge);
    }
  }
  std::vector<Moments> parts(region.border.size());
  constexpr Eigen::Index kRun = 1024;
  forChunks(static_cast<Eigen::Index>(parts.size()), kRun, [&](const Chunk& chunk) {
    for (auto c = static_cast<std::size_t>(chunk.begin); c < static_cast<std::size_t>(chunk.end);
         ++c) {
      std::array<Sample, 8> samples;
      for (std::size_t i = 0; i < 8; ++i) {
        const RegionCorner& corner = region.corners[static_cast<std::size_t>(region.border[c][i])];
        samples[i] = which == Admissible::BehindWalls
                         ? Sample{corner.wall, corner.wallSlope.cast<double>()}
                         : corner.least(region.edge);
      }
      // Without a node inside nothing tells that the ball reaches what lies between the walls.
      const bool isSeen = std::any_of(samples.begin(), samples.end(),
                                      [](const Sample& sample) { return sample.value > 0.0; });
      if (which == Admissible::Reached && !isSeen) {
        parts[c].setZero();
        continue;
      }
      parts[c] = positivePart(samples, region.positionOf(region.placeOf(region.border[c][0])),
                              region.edge);
    }
  });
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (parts[c][0] > 0.0) cellAt(region.placeOf(region.border[c][0])) += parts[c];
  }
  AdmissibleCells rows(static_cast<Eigen::Index>(cells.size()), 10);
  for (std::size_t i = 0; i < cells.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = cells[i].transpose();
  return rows;
}

std::vector<double> layerHeights(const FeasibleRegion& region, double most) {
  constexpr double kMostLayers = 100.0;
  const double edge = region.edge * (1 << levelOfCells(region, most));
  const double step = edge * std::ceil(region.extent.z() / (kMostLayers * edge));
  std::vector<double> heights;
  for (int i = 1; i * step < region.extent.z(); ++i)
    heights.push_back(region.origin.z() + i * step);
  return heights;
}

} // namespace massprops
