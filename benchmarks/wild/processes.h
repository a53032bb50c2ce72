// Trials side by side, a process each: memory is that of the case, and a crash or a case without an
// end is only its own.
#pragma once

#include "wild/trial.h"

#include <functional>
#include <vector>

namespace massprops::wild {

/// Calls `visit` in the order of the cases, as soon as all before have ended.
void runAll(const std::vector<Case>& cases, int jobs, const Limits& limits,
            const std::function<void(const Case&, const Trial&)>& visit);

} // namespace massprops::wild
