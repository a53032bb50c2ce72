// Loops over index ranges on the machine's cores.
#pragma once

#include "core/base/types.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace massprops {

/// Threads that a loop may use, the calling one included; at first as many as the machine has, at
/// most 8. For tests: no result depends on it.
int threadCount();
void setThreadCount(int count);

/// Threads that wait for the loops of the thread that made it, while it lives. Without one, each
/// loop starts and ends its own. Where the system gives no threads, the loops run on fewer.
class ThreadTeam {
public:
  ThreadTeam();
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  class Crew;

private:
  std::unique_ptr<Crew> crew_; ///< none where there is a team already
  Crew* before_;
};

/// A part of a loop: indices begin…end−1; `number` counts the parts from 0.
struct Chunk {
  Eigen::Index begin, end;
  Eigen::Index number;
};

/// The chunks of `length` indices that 0…count−1 falls into; the last may be shorter.
inline Eigen::Index chunkCount(Eigen::Index count, Eigen::Index length) {
  return (count + length - 1) / length;
}

/// Calls `body` for every chunk, in any order and on several threads at once. Where chunks begin
/// depends on `count` and `length` alone, so that sums over chunks, added in the order of their
/// numbers, have the same rounding with any number of threads.
/// An exception of `body` is rethrown when all threads have ended.
void forChunks(Eigen::Index count, Eigen::Index length,
               const std::function<void(const Chunk&)>& body);

/// Both: the second on the calling thread, the first on another one, or on the calling one later
/// when no other is free. Where both fail, the first one's exception is thrown.
void inParallel(const std::function<void()>& first, const std::function<void()>& second);

} // namespace massprops
