// Another number of threads for a test.
#pragma once

#include "core/base/parallel.h"

namespace massprops::testing {

/// So many threads, even if they are more than cores, and back.
class ThreadCount {
public:
  explicit ThreadCount(int count) : before_(threadCount()) { setThreadCount(count); }
  ~ThreadCount() { setThreadCount(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

private:
  int before_;
};

} // namespace massprops::testing
