// Every sentence that the filter promises about a result, checked without any code of core/.
#pragma once

#include "core/pipeline.h"
#include "property/cases.h"

#include <string>
#include <vector>

namespace massprops::testing {

/// What is not as promised, one sentence each; empty when all is.
std::vector<std::string> brokenPromises(const PropertyCase& c, const Result& result);

/// Least distance between two surfaces that do not cross, and that of every vertex of `a` from `b`.
struct Separation {
  double least;
  Vector atVertex;
};
Separation separation(const TriangleMesh& a, const TriangleMesh& b);

/// Whether a component encloses almost nothing.
bool hasFlatComponent(const TriangleMesh& mesh);

} // namespace massprops::testing
