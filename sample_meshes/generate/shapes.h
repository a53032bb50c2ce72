// The sample models: millimetres, up is +z, standing on z = 0.
#pragma once

#include "surface_mesher.h"

#include <string>
#include <vector>

namespace samples {

struct Sample {
  std::string name; ///< file name without extension
  MeshingProblem problem;
};

std::vector<Sample> allSamples();

} // namespace samples
