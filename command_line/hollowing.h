// One model: read, hollowed, written.
#pragma once

#include "command_line/arguments.h"
#include "core/base/options.h"
#include "core/pipeline.h"

#include <string>

namespace massprops {

/// What is asked for of one model: `{name}` filled in.
Arguments argumentsFor(const Arguments& arguments, const std::string& model);

/// What is wrong before any model is looked at: unknown formats, two models for one file, a result
/// in a model's place. \throw InvalidInput
void requireSensible(const Arguments& arguments);

struct Outcome {
  bool solved = false;
  std::string line; ///< what came out, without the model's name
};

/// Writes its files only when all has gone well.
/// \throw std::exception with a sentence for the user
Outcome hollow(const std::string& model, const Arguments& arguments, const Progress& progress);

} // namespace massprops
