// Outer surface and cavities become one closed body where holes are cut.
#pragma once

#include "core/drill/hole.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// Closed surfaces, outward.
struct DrilledBody {
  TriangleMesh body;
  std::vector<TriangleMesh> plugs; ///< one for each hole, in its place
};

/// Cuts holes into what lies between two closed, outward surfaces, one inside of the other. A plug
/// is what was cut out, but for a clearance all round; it ends in pieces of the two surfaces. Cut
/// exactly, then rounded by `representable`; checked to be closed, free of crossings, and of the
/// genus and the number of pieces that so many holes make. Empty: it is not, however the drill is
/// turned about its axis.
std::optional<DrilledBody> drilled(const TriangleMesh& outer, const TriangleMesh& cavity,
                                   const std::vector<Hole>& holes, double clearance,
                                   const std::function<Points(const Points&)>& representable);

} // namespace massprops
