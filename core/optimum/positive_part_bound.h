// How much hollowing out could be worth at most, whatever the cavity.
#pragma once

#include "core/optimum/layered_quadric.h"
#include "core/query/triangle_tree.h"

#include <cstddef>
#include <memory>

namespace massprops {

/// Distances, sums and cuts are calculated to more digits than this; all are rounded outwards by
/// it.
constexpr double kOutwards = 1e-9;

/// Of the cubes that such a bound may look at, each about a microsecond.
constexpr std::size_t kMostCubes = 1500000;

/// Bounds on integrals over the points that keep a wall from a surface. How much of a cube keeps it
/// does not depend on what is integrated: it is asked once and kept for the next bound.
class PositivePartBounds {
public:
  /// Refers to the surface. `wall`: a length in its unit. \pre the surface is closed and outward
  PositivePartBounds(const TriangleTree& surface, double wall);
  ~PositivePartBounds();
  PositivePartBounds(const PositivePartBounds&) = delete;
  PositivePartBounds& operator=(const PositivePartBounds&) = delete;

  /// At least the integral of the positive part of q over the points that keep the wall, and below
  /// `enough` if the effort reaches. To the last digit the same whatever was asked before.
  double of(const LayeredQuadric& q, double enough, std::size_t mostCubes = kMostCubes);

private:
  class Places;
  std::unique_ptr<Places> places_;
};

} // namespace massprops
