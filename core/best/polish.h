// The quadric's coefficients, adjusted on the triangles that stand for it.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/reduced/cavity_search.h"

#include <vector>

namespace massprops {

/// Which vertices move: those of the cut along its normal, those of creases along what the walls
/// leave, as far as triangles stay sound, so that the constraints hold nearly only.
enum class Moving { CutAndCreases, CutAlone };

struct Polished {
  int evaluations = 0;     ///< of the body
  double violation = 0.0;  ///< largest of the goal's constraints; 0 where no vertex could move
  bool isFarthest = false; ///< going on from there may help
};

/// Moves the vertices on the quadric as another quadric near it would have them, so that the body
/// keeps the goal's constraints and serves its objective best. `edge`: of the cubes that the
/// contour was made with. `held`: n flags, of vertices that stay; may be empty. `vertices`: of the
/// contour, as they become, not where its mesh has them.
Polished polish(const CavityTask& task, const LayeredQuadric& quadric, Moving moving, double edge,
                const std::vector<char>& held, const Contour& contour, Points& vertices);

/// Where there is no cut, or too little of it, to keep the constraints with: moves vertices behind
/// the walls inwards, which keeps the walls, by no more than it takes. `held` as above. False, with
/// `vertices` as they were, if half an edge, root mean square, is too little. \pre the constraints
/// nearly hold
bool withdrawFromWalls(const CavityTask& task, double edge, const std::vector<char>& held,
                       const Contour& contour, Points& vertices);

} // namespace massprops
