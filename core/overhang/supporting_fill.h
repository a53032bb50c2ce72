// What carries a cavity's ceiling while it is printed.
#pragma once

#include "core/base/types.h"
#include "core/contour/quadric_cut.h"
#include "core/optimum/feasible_region.h"
#include "core/query/grid_function.h"

#include <memory>
#include <vector>

namespace massprops {

/// How ceilings are to be carried; working frame.
struct OverhangWishes {
  Mat3 toPrint = Mat3::Identity(); ///< its third axis points up in the printer
  double leastAngle = 0.0;         ///< wanted slope of a ceiling against the horizontal, radians
  double angle = 0.0;              ///< it is built with, for what the surface's triangles lose
  double bridge = 0.0;             ///< longest span that may be flatter, a length
  double tipDepth = 0.0;           ///< how far a ceiling may hang down anywhere, a length
  /// Of what is filled, half; edges of the set's cubes or, where that is coarser, of the grid.
  double halfThickness = 0.8;
  /// Of the grid, in longest spans: four or five edges come out flat where a ceiling begins.
  double edge = 0.2;
};

/// Material that grows downwards from the ceilings of a cavity that are too flat, at the wanted
/// angle, until it stands on a wall or a pillar. docs/math.md "Ceilings that carry themselves"
class SupportingFill {
public:
  /// `edge`: of the cubes that the cavity's surface is made with. \pre points of the set exist
  SupportingFill(const FeasibleSet& set, double edge, const OverhangWishes& wishes);

  /// Pillars on a grid of triangles with edges of this length may carry, not walls alone. Before
  /// anything is added.
  void allowPillars(double spacing);

  /// Adds what carries the ceilings of the set's part where the quadric is positive and nothing is
  /// filled yet. The share of it that had to be filled.
  double add(const LayeredQuadric& quadric);

  /// Adds columns below these places, down to where something is filled or a wall is; as thick as
  /// what is filled is at least.
  void addColumns(const std::vector<Vec3>& places);

  /// Positive where nothing is filled.
  GridFunction function() const { return {grid_, fill_}; }

private:
  /// Above and below it through what is no cavity, so that nothing opens between fill and wall.
  void join(const std::vector<char>& isHollow, std::vector<float>& fresh) const;

  double edge_; ///< of the cavity's cubes
  Grid grid_;
  float run_; ///< edges that material may reach out a layer
  float halfThickness_ = 0.0F;
  std::vector<Eigen::Vector2f> pillars_; ///< nodes' units
  float pillarRadius_ = 0.0F;
  std::vector<float> inset_, fill_; ///< edges
};

} // namespace massprops
