// A run is ended from wherever it is, by what its caller throws and by nothing else.
#include "core/base/interruption.h"
#include "core/base/parallel.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace massprops::testing {
namespace {

/// Every checkpoint asks.
class AskingAlways : public ::testing::TestWithParam<int> {
protected:
  AskingAlways() : threads_(GetParam()) { setTimeBetweenQuestions(std::chrono::milliseconds(0)); }
  ~AskingAlways() override { setTimeBetweenQuestions(kTimeBetweenQuestions); }

private:
  ThreadCount threads_;
};

TEST_P(AskingAlways, AnswersGoPastWhoeverCatchesFailures) {
  bool isTakenForFailure = false;
  const auto run = [&] {
    try {
      checkpoint();
    } catch (const std::exception&) {
      isTakenForFailure = true;
    }
  };
  EXPECT_THROW(interruptibly([] { throw std::logic_error("enough"); }, run), std::logic_error);
  EXPECT_FALSE(isTakenForFailure);
}

TEST_P(AskingAlways, LoopsOfAllThreadsEnd) {
  for (int last = 0; last < 20; ++last) {
    int asked = 0;
    const auto ask = [&] {
      if (asked++ == last) throw std::string("enough");
    };
    std::atomic<int> done = 0;
    const auto run = [&] {
      inParallel([&] { forChunks(1000, 1, [&](const Chunk&) { ++done; }); },
                 [&] { forChunks(1000, 1, [&](const Chunk&) { ++done; }); });
    };
    EXPECT_THROW(interruptibly(ask, run), std::string) << last;
    EXPECT_EQ(asked, last + 1) << "nobody is asked who has answered";
    EXPECT_LT(done, 2000);
  }
}

TEST_P(AskingAlways, WhoWaitsForAnotherThreadAsks) {
  // The other thread never ends by itself.
  std::atomic<bool> isWaitedFor = false;
  const auto ask = [&] {
    if (isWaitedFor) throw std::string("enough");
  };
  const auto endless = [&] {
    isWaitedFor = true;
    while (true) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      checkpoint();
    }
  };
  EXPECT_THROW(interruptibly(ask, [&] { inParallel(endless, [] {}); }), std::string);
}

TEST_P(AskingAlways, OnlyTheCallersThreadAsks) {
  const std::thread::id own = std::this_thread::get_id();
  const auto ask = [&] { EXPECT_EQ(std::this_thread::get_id(), own); };
  interruptibly(ask, [] { forChunks(200, 1, [](const Chunk&) { checkpoint(); }); });
  bool isAsked = false;
  interruptibly([&] { isAsked = true; }, [] { askNow(); });
  EXPECT_TRUE(isAsked);
  isAsked = false;
  askNow(); // outside of any run
  EXPECT_FALSE(isAsked);
}

INSTANTIATE_TEST_SUITE_P(Threads, AskingAlways, ::testing::Values(1, 2, 4));

TEST(Questions, AreFewWhereThereIsLittleTime) {
  int asked = 0;
  const auto run = [] {
    for (int i = 0; i < 1000; ++i) checkpoint();
  };
  interruptibly([&] { ++asked; }, run);
  EXPECT_LT(asked, 1000);
}

} // namespace
} // namespace massprops::testing
