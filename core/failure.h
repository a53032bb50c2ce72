// What a user reads when something was thrown.
#pragma once

#include <string>

namespace massprops {

/// Called while an exception is caught: its sentence, or what to do where it has none.
std::string sentenceOfFailure();

} // namespace massprops
