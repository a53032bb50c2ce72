// The model in the working frame, standing on its contact area.
#pragma once

#include "core/base/options.h"
#include "core/model/contact.h"
#include "core/model/foot.h"
#include "core/model/frame.h"
#include "core/model/open_surface.h"
#include "core/model/solid.h"

#include <vector>

namespace massprops {

struct PosedModel {
  Frame frame;
  /// n×3, working frame, in the order in which the faces use them: what is near in space is near in
  /// memory.
  Points vertices;
  Faces faces; ///< outward, in spatial order (triangle_tree.h)
  /// Of an open surface, whose openings have lids among the faces.
  std::optional<OpenSurface> open;
  std::vector<char> isLid; ///< for every face; empty for a closed surface
  /// For every vertex its number in the solid.
  std::vector<int> vertexOf;
  /// Existing cavities, working frame, oriented into them. The new cavity takes their place.
  TriangleMesh cavities;
  ContactArea contact;      ///< working lengths
  std::optional<Foot> foot; ///< that it was cut to stand on
  /// Working length: who keeps it in the working frame keeps the wanted one in model coordinates.
  double wall = 0.0;
  /// That the user gave, working frame.
  std::optional<Vec3> pivot;
};

/// All but the wall and the pivot, which goals and walls have in common: by the up axis and the
/// radii alone. `foot`: the solid's, if it has been cut: it touches the ground with that alone.
/// \throw InvalidInput when nothing is left of a sheet in the working frame
PosedModel posedModel(const Solid& solid, UpAxis up, const std::optional<Vec2>& radii,
                      const std::optional<Foot>& foot);
/// The half axes of the contact area where they are given; lengths.
std::optional<Vec2> givenRadii(const Options& options);

/// Wall and pivot. \throw InvalidInput when a goal that needs a contact area has none, the pivot
/// lies far away, or an opening lies below the wished waterline
void takeWishes(const Options& options, PosedModel& posed);

/// Both.
PosedModel makePosedModel(const Solid& solid, const Options& options,
                          const std::optional<Foot>& foot = {});

/// For each of these vertices of the piece its place when they come in the solid's order.
std::vector<int> placesInSolid(const PosedModel& posed, const std::vector<int>& vertices);

/// Rows, or the rows that faces refer to, at their places; of 2n rows both halves alike.
Points placed(const Points& values, const std::vector<int>& places);
Vector placed(const Vector& values, const std::vector<int>& places);
Faces placed(const Faces& faces, const std::vector<int>& places);

} // namespace massprops
