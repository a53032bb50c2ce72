// What the filter delivered for a model, and what it said about it.
#pragma once

#include "simulation/body.h"
#include "simulation/comparison.h"
#include "simulation/record.h"

#include <string>

namespace simulation {

struct Delivery {
  Mesh model; ///< as it was before
  Mesh outer; ///< the model, or what the filter made of its outside
  Mesh inner; ///< empty without a cavity
  Record report;
  Record script;
};

/// Reads `<prefix>_report.txt`, `<prefix>_inner.ply` and `<prefix>_outer.ply`; the latter two may
/// be missing.
Delivery readDelivery(const std::string& modelPath, const std::string& prefix,
                      const std::string& scriptPath);

/// Weighs the bodies before and after, and lets them do what the goal promises.
void compareDelivery(const Delivery& delivery, Comparison& comparison);

} // namespace simulation
