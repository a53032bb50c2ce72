// The report as JSON.
#pragma once

#include "core/base/report.h"

#include <string>

namespace massprops {

/// One object with the keys of docs/report.md in their order: points as arrays of 3, tensors as 3
/// arrays of 3, null for what is infinite or no number. Ends with a line's end.
std::string toJson(const Report& report);

} // namespace massprops
