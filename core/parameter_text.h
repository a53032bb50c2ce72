// Values of parameters as text.
#pragma once

#include "core/parameters.h"

#include <string>

namespace massprops {

/// The value that a text stands for: a truth value as `true` or `false`, a number with a decimal
/// point, a length also as `1.5%` of the diagonal, a choice by its entry, in any case of letters.
/// \throw InvalidInput when it stands for none
ParameterValue valueFrom(const Parameter& parameter, const std::string& text, double diagonal);

} // namespace massprops
