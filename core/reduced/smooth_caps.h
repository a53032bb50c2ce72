// Where a part becomes solid the cavity ends smoothly.
#pragma once

#include "core/reduced/cavity_search.h"

namespace massprops {

/// The cavity with smooth ends (docs/math.md "Ends of the offset surface"): the fans that run to
/// the skeleton there go, and so do specks that hang on them alone. In their place come skins under
/// tension, those first that serve the goal best, pressed until the constraints hold again. An end
/// at which caps do not pass inspection, cost the goal noticeably or exceed `greatestVolume` stays
/// as it was, and so do all where there are very many. These count as pleated, as do those whose
/// caps have edges that turn by more than 60°.
/// \pre the cavity passed inspection
CavityResult withSmoothCaps(const CavityTask& task, const CavityResult& found);

} // namespace massprops
