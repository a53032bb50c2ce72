// Vertices of a cavity moved by a few smooth functions, so that the body does what it is to do.
#pragma once

#include "core/reduced/cavity_search.h"

namespace massprops {

struct DisplacementTask {
  const Goal& goal;
  const Weights& weights;
  const Fillings& fillings;
  const Moments& outer; ///< of all but the cavity, working frame
  double solidVolume;
  const Faces& faces; ///< of the cavity, outward
  /// Where each vertex goes; 0 for those that stay. n×3
  const Points& directions;
  double farthest; ///< root mean square of the displacements, in the directions' unit
  /// Whether the goal's level is raised itself, kinks and all, where one condition is all that it
  /// asks for: its smooth objective is nearly that only.
  bool raisesLevel = false;
  /// Whether vertices move by no more than the constraints ask for, whatever the objective becomes.
  bool movesLeast = false;
  /// Whether constraints that are out of reach are met as nearly as can be, whatever the objective
  /// becomes.
  bool comesNearest = false;
};

struct Displaced {
  int evaluations = 0;     ///< of the body
  double violation = 0.0;  ///< largest of the goal's constraints; 0 where no vertex could move
  bool isFarthest = false; ///< some function is as large as it may be: going on from there may help
};

/// Displaces `vertices` along the directions, by polynomials of degree 2, or 1 where moments of
/// inertia do not count, so that the goal's constraints hold and its objective is least, or its
/// level highest.
/// `vertices`: as they become; unchanged where none can move.
Displaced displace(const DisplacementTask& task, Points& vertices);

} // namespace massprops
