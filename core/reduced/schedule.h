// When the stages of a run begin.
#pragma once

namespace massprops {

/// Per cent of the time, as it was on models of some ten thousand vertices.
struct Schedule {
  int copy = 5, skeleton = 12, directions = 55, search = 58;
  static constexpr int kLimit = 5, kBest = 45; ///< of the best possible cavity
  static constexpr int kEnd = 95;              ///< of the search
  static constexpr int kJudged = 96;           ///< margins and proofs begin
};

} // namespace massprops
