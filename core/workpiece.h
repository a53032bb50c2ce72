// The model in the working frame, standing on its contact area.
#pragma once

#include "core/contact.h"
#include "core/frame.h"
#include "core/options.h"
#include "core/solid.h"

namespace massprops {

struct Workpiece {
  Frame frame;
  Points vertices; ///< n×3, working frame
  Faces faces;     ///< outward
  /// Existing cavities, working frame, oriented into them. The new cavity takes their place.
  TriangleMesh cavities;
  ContactArea contact; ///< working lengths
  double wall = 0.0;   ///< working length
  /// That the user gave, working frame.
  std::optional<Vec3> pivot;
};

/// \throw InvalidInput when a goal that needs a contact area has none, or the pivot lies far away
Workpiece makeWorkpiece(const Solid& solid, const Options& options);

} // namespace massprops
