// Random models and what is asked of them: the same case for the same seed and number.
#pragma once

#include "core/base/options.h"
#include "core/base/types.h"

#include <cstdint>
#include <string>

namespace massprops::testing {

struct PropertyCase {
  std::string family;      ///< what kind of model
  std::string description; ///< model, pose, disguise and options, in one line
  /// As it is handed in: perhaps unwelded, mirrored, tiny, far away, with a cavity.
  TriangleMesh input;
  /// The same bodies as one plain mesh, outward, in the same place: what the result is checked
  /// against. Without existing cavities.
  TriangleMesh body;
  /// Existing cavities, facing into them; often empty.
  TriangleMesh cavities;
  Options options;
  double wall = 0.0; ///< that is asked for, in model units
  bool floats = false;
  bool isBroken = false; ///< `input` has defects that are to be mended: `body` is what it was
};

/// Models have up to about 3000 vertices. Some cross themselves: they are to be refused.
PropertyCase makeCase(std::uint32_t seed, int number);

} // namespace massprops::testing
