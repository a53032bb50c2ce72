// Which wishes go together: all pairs that are not listed here do.
#pragma once

#include "core/base/options.h"

#include <vector>

namespace massprops {

/// Two things that cannot be had at once.
struct RefusedPair {
  bool (*areWished)(const Options& options, bool isOpen);
  const char* sentence; ///< names both parameters and says what to do
};

/// In the order in which they are looked at.
const std::vector<RefusedPair>& refusedPairs();

/// `isOpen`: whether the surface is one side of a shell.
/// \throw InvalidInput with the sentence of the first pair that is wished
void requireCompatible(const Options& options, bool isOpen);

} // namespace massprops
