// Where a part becomes solid the cavity ends in a smooth cap.
#pragma once

#include "core/reduced/cavity_search.h"

namespace massprops {

/// The cavity with its ends closed anew (docs/math.md "Ends of the offset surface"): the fans that
/// run to the skeleton there go, and so do specks that hang on them alone. In their place come
/// skins under tension, those first that serve the goal best, pressed until the constraints hold
/// again. An end at which no such cap passes inspection stays as it was, and so do
/// the ends that cost the goal most where all caps together would cost it noticeably or exceed
/// `greatestVolume`; all do where nothing else helps. \pre the cavity passed inspection
CavityResult withSmoothCaps(const CavityTask& task, const CavityResult& found);

} // namespace massprops
