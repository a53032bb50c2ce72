// What runs on one mesh have in common: made for the first of them, kept for the others.
#pragma once

#include "core/base/options.h"
#include "core/kept.h"
#include "core/model/foot.h"
#include "core/model/mending_step.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/optimum/admissible_cells.h"
#include "core/optimum/feasible_region.h"
#include "core/physics/moments.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/moving_surface.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace massprops {

/// Where a cavity may be behind one wall.
struct Room {
  FeasibleSet set;
  FeasibleRegion region;
  AdmissibleCells cells;   ///< all that lies behind the walls; no rows: there is no room
  AdmissibleCells reached; ///< of these what the ball reaches
};

/// Least wall, step between positions that can be delivered, both lengths, and how large cubes are,
/// of those that a cavity is found with.
using RoomKey = std::tuple<double, double, double>;
/// The fields of `CoarseningOptions`.
using CopyKey = std::tuple<int, bool, bool, bool>;

/// Which foot, if the solid needs one, and the radii of the contact area.
struct Stance {
  FootCut foot = FootCut::Never;
  double footDepth = 0.0;
  std::optional<double> betterDepth; ///< found to be better than the least
  std::optional<Vec2> radii;

  bool operator==(const Stance& other) const {
    return std::tie(foot, footDepth, betterDepth, radii) ==
           std::tie(other.foot, other.footDepth, other.betterDepth, other.radii);
  }
};

/// The solid as it stands, in the working frame, and what has been found out about it. Neither
/// copied nor moved, for its parts refer to each other.
struct PreparedBody {
  PreparedBody(std::shared_ptr<const Solid> solid, const std::optional<Foot>& foot,
               std::optional<LowestPart> lowest, UpAxis up, const Stance& stance);
  PreparedBody(const PreparedBody&) = delete;
  PreparedBody& operator=(const PreparedBody&) = delete;

  const Stance stance;
  const std::shared_ptr<const Solid> solid; ///< with a foot, if it needs one
  const std::optional<LowestPart> lowest;   ///< see `Footing`
  PosedModel posed;                         ///< wall and pivot are those of the present run
  const TriangleTree surface;               ///< the outer one, working frame
  const Moments solidMoments;               ///< of the outer surface, working frame
  bool isFreeOfCrossings = false;           ///< as far as is known
  Kept<RoomKey, Room> room;
  Kept<CopyKey, Coarsening> copies;
};

/// A mesh, and of it what does not depend on the options that have changed since.
class PreparedModel {
public:
  explicit PreparedModel(TriangleMesh mesh) : mesh_(std::move(mesh)) {}

  /// Why the mesh is no solid as it is, where it is to be mended for that; null: not known to be
  /// none.
  const std::string* defect(const Options& options) const;
  /// From then on it is mended, where the options allow it.
  void noteDefect(const Options& options, const std::string& defect);

  /// Standing as these options want it; `betterDepth`: of the foot, where it has been found.
  /// \throw DefectiveSurface when it is no solid; InvalidInput when an option is absurd, or where
  /// the mesh has an opening that is no defect
  PreparedBody& body(const Options& options, const std::optional<double>& betterDepth,
                     const std::function<void()>& beforeMending);

private:
  void prepareSolid(const Options& options, const std::function<void()>& beforeMending);

  const TriangleMesh mesh_;
  std::array<std::optional<std::string>, 2> defects_; ///< of a closed and of an open surface
  std::shared_ptr<const Solid> solid_;
  std::tuple<bool, UpAxis, bool> solidKey_; ///< open, up, mended
  FeltWall mendedFor_;
  std::vector<std::unique_ptr<PreparedBody>> bodies_; ///< of this solid, the last one in front
};

} // namespace massprops
