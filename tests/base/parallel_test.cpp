// Loops on several threads: everything is done, once, and what goes wrong is reported.
#include "core/base/parallel.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace massprops::testing {
namespace {

/// How often each index is met.
std::vector<int> visits(Eigen::Index count, Eigen::Index length) {
  std::vector<std::atomic<int>> met(static_cast<std::size_t>(count));
  forChunks(count, length, [&](const Chunk& chunk) {
    EXPECT_EQ(chunk.begin, chunk.number * length);
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) ++met[static_cast<std::size_t>(i)];
  });
  return {met.begin(), met.end()};
}

class Loops : public ::testing::TestWithParam<int> {};

TEST_P(Loops, MeetEveryIndexOnce) {
  const ThreadCount threads(GetParam());
  for (const bool inTeam : {false, true}) {
    std::unique_ptr<ThreadTeam> team;
    if (inTeam) team = std::make_unique<ThreadTeam>();
    for (const Eigen::Index count : {0, 1, 2, 7, 100, 1000}) {
      for (const Eigen::Index length : {1, 3, 64, 5000}) {
        EXPECT_EQ(visits(count, length), std::vector<int>(static_cast<std::size_t>(count), 1));
      }
    }
  }
}

TEST_P(Loops, PassOnWhatAChunkThrowsAndGoOn) {
  const ThreadCount threads(GetParam());
  const ThreadTeam team;
  for (Eigen::Index bad = 0; bad < 20; ++bad) {
    const auto fails = [&](const Chunk& chunk) {
      if (chunk.number == bad) throw std::runtime_error(std::to_string(bad));
    };
    try {
      forChunks(20, 1, fails);
      ADD_FAILURE() << "no exception of chunk " << bad;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(e.what(), std::to_string(bad));
    }
    EXPECT_EQ(visits(50, 2), std::vector<int>(50, 1));
  }
}

TEST_P(Loops, MayStandInsideOfEachOther) {
  const ThreadCount threads(GetParam());
  const ThreadTeam team;
  std::atomic<int> sum = 0;
  forChunks(6, 1, [&](const Chunk& outer) {
    forChunks(10, 2, [&](const Chunk& inner) {
      sum += static_cast<int>(inner.end - inner.begin) * static_cast<int>(outer.number + 1);
    });
  });
  EXPECT_EQ(sum, 10 * (1 + 2 + 3 + 4 + 5 + 6));
}

TEST_P(Loops, RunBesideALongTask) {
  const ThreadCount threads(GetParam());
  const ThreadTeam team;
  std::atomic<int> loops = 0;
  bool isDone = false;
  inParallel(
      [&] {
        // With one thread the task comes first and must not wait.
        while (threadCount() > 1 && loops < 100) std::this_thread::yield();
        isDone = true;
      },
      [&] {
        for (int i = 0; i < 100; ++i, ++loops) EXPECT_EQ(visits(9, 2), std::vector<int>(9, 1));
      });
  EXPECT_TRUE(isDone);
  EXPECT_EQ(loops, 100);
}

TEST_P(Loops, OfTwoCallersDoNotMix) {
  const ThreadCount threads(GetParam());
  const auto work = [] {
    const ThreadTeam team;
    for (int i = 0; i < 200; ++i) EXPECT_EQ(visits(40, 3), std::vector<int>(40, 1));
  };
  std::thread other(work);
  work();
  other.join();
}

INSTANTIATE_TEST_SUITE_P(Threads, Loops, ::testing::Values(1, 2, 3, 8));

TEST(InParallel, PassesOnWhatEitherThrows) {
  const ThreadCount threads(2);
  const ThreadTeam team;
  const auto fine = [] {};
  const auto fails = [] { throw std::runtime_error("bad"); };
  EXPECT_THROW(inParallel(fails, fine), std::runtime_error);
  EXPECT_THROW(inParallel(fine, fails), std::runtime_error);
  EXPECT_THROW(inParallel(fails, [] { throw std::logic_error("the second"); }), std::runtime_error);
  int calls = 0;
  inParallel([&] { ++calls; }, fine);
  EXPECT_EQ(calls, 1);
}

std::ptrdiff_t threadsOfThisProcess() {
  using std::filesystem::directory_iterator;
  return std::distance(directory_iterator("/proc/self/task"), directory_iterator());
}

TEST(ThreadTeam, IsWhatLoopsWithinLoopsRunOn) {
  const ThreadCount threads(3);
  const ThreadTeam team;
  const std::ptrdiff_t all = threadsOfThisProcess();
  std::atomic<bool> isMore = false;
  std::atomic<int> begun = 0;
  forChunks(3, 1, [&](const Chunk&) {
    // On every thread of the team.
    ++begun;
    while (begun < 3) std::this_thread::yield();
    forChunks(20, 1, [&](const Chunk&) {
      if (threadsOfThisProcess() > all) isMore = true;
    });
  });
  EXPECT_FALSE(isMore);
}

TEST(ThreadTeam, WorksOnAllItsThreadsAndLeavesNoneBehind) {
  const ThreadCount threads(3);
  const std::ptrdiff_t before = threadsOfThisProcess();
  std::mutex mutex;
  std::set<std::thread::id> seen;
  {
    const ThreadTeam team;
    // As many chunks at once as there are threads: none ends before all have begun.
    std::atomic<int> begun = 0;
    forChunks(3, 1, [&](const Chunk&) {
      ++begun;
      while (begun < 3) std::this_thread::yield();
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  }
  EXPECT_EQ(seen.size(), 3U);
  // The system may list a thread a little longer than it runs.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (threadsOfThisProcess() > before && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_LE(threadsOfThisProcess(), before);
}

} // namespace
} // namespace massprops::testing
