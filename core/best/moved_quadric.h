// The quadric whose cut is where vertices of another one's cut went, and one that follows them.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/optimum/layered_quadric.h"

#include <optional>

namespace massprops {

/// The sum of squares of the distances, of first order, between `vertices` on the cut and the
/// result's cut is least; elsewhere it changes little. `contour`: of `quadric`, working frame, with
/// its vertices where they were. `vertices`: where they are, n×3. A layer without any keeps its
/// quadric. Empty: no quadric's cut is near to where they went.
std::optional<LayeredQuadric> quadricThrough(const LayeredQuadric& quadric, const Contour& contour,
                                             const Points& vertices);

/// A quadric that goes with its cut where this goes so far that it would leave steps along its
/// creases. The contour is made anew then.
class MovingQuadric {
public:
  /// It must outlive this.
  explicit MovingQuadric(LayeredQuadric& quadric) : quadric_(quadric) {}

  bool isAtRest() const { return moves_ >= kMoves; } ///< for good

  /// A contour of it.
  void begin() { hasMoved_ = false; }
  bool hasMoved() const { return hasMoved_; } ///< since then

  /// Whether the contour is about the one that the quadric was moved for, which it need not be
  /// where that had no vertices: else it is as it was again.
  bool isAsMeant(const Contour& contour);

  /// Through where the vertices of its contour's cut went, if that is far and near to one. `edge`:
  /// of the cubes. Whether it moved.
  bool follow(const Contour& contour, const Points& vertices, double edge);

  /// The last move, if its contour has not been seen yet, for good.
  void takeBack();

private:
  static constexpr int kMoves = 8; // where constraints are out of reach; else one to three do
  struct Move {
    LayeredQuadric before;
    double volume; // of the cavity that it is meant to give
  };

  LayeredQuadric& quadric_;
  std::optional<Move> last_; ///< of which no contour has been seen yet
  int moves_ = 0;
  bool hasMoved_ = false;
};

} // namespace massprops
