// Tests that say of themselves that they are large.
#pragma once

#include <gtest/gtest.h>

namespace massprops::testing {

#ifdef MASSPROPS_SANITIZED
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

} // namespace massprops::testing

/// First statement of a test that sanitizers, forty times as slow, would keep for minutes: there it
/// is skipped, and said to be. A body that is contoured, searched or mended in whole is large.
#define LARGE_TEST()                                                                               \
  if (massprops::testing::kIsSanitized) GTEST_SKIP() << "large: not under sanitizers"
