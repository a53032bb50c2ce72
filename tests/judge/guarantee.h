// Every sentence that the filter promises about a result, checked without any code of core/.
#pragma once

#include "core/pipeline.h"
#include "property/cases.h"

#include <string>
#include <vector>

namespace massprops::testing {

/// What is not as promised, one sentence each; empty when all is.
std::vector<std::string> brokenPromises(const PropertyCase& c, const Result& result);

/// Least distance between two surfaces that do not cross, and for every vertex of `a` the least
/// over the triangles around it as far as it is below `horizon`.
struct Separation {
  double least;
  Vector atVertex;
};
Separation separation(const TriangleMesh& a, const TriangleMesh& b, double horizon);

/// Whether a component encloses almost nothing.
bool hasFlatComponent(const TriangleMesh& mesh);

} // namespace massprops::testing
