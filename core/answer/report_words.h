// What a report says in words.
#pragma once

#include "core/answer/report_subject.h"

#include <string>

namespace massprops {

/// What became of the goal, why, and what to do about it: sentences.
std::string message(const Subject& subject);

/// How to print it, so that it is what was calculated.
std::string printAs(const Subject& subject);

/// What a person should know about a model of such a size; "" where it is a usual one.
std::string unitsInWords(double diagonal);

} // namespace massprops
