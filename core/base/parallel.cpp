#include "core/base/parallel.h"

#include "core/base/interruption.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace massprops {
namespace {

constexpr int kMostThreads = 8;

int machineThreads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

std::atomic<int>& threads() {
  static std::atomic<int> count = machineThreads();
  return count;
}

/// Waits without sleeping, for a while: falling asleep and waking up takes as long as many a loop.
template <class Condition>
void waitAwake(const Condition& isReady) {
  constexpr std::chrono::microseconds kPatience{100};
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!isReady() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

/// What a thread does until its helpers have ended: nothing, for that is soon, or it takes part in
/// other loops, which may end later.
enum class Waiting { Idle, Helping };

/// What helpers call, up to `wanted` times together.
struct Task {
  const std::function<void()>& run;
  int wanted; ///< helpers that may still join
  Watch* watch = presentWatch();
  std::atomic<int> helping = 0;
  std::exception_ptr failure = nullptr;
};

} // namespace

namespace {
/// What the loops of this thread run on.
thread_local ThreadTeam::Crew* present = nullptr;
} // namespace

class ThreadTeam::Crew {
public:
  explicit Crew(int helpers) {
    helpers_.reserve(static_cast<std::size_t>(helpers));
    try {
      for (int i = 0; i < helpers; ++i) helpers_.emplace_back([this] { help(); });
    } catch (const std::exception&) {
      // No more threads are to be had: fewer will do.
    }
  }
  ~Crew() {
    {
      const std::lock_guard lock(mutex_);
      isOver_ = true;
    }
    changed_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Calls `own`, while helpers call `others` up to `wanted` times; ends when all have ended,
  /// whatever they throw. Returns how often helpers did.
  int share(const std::function<void()>& own, const std::function<void()>& others, int wanted,
            Waiting waiting) {
    const int helpers = std::min(wanted, static_cast<int>(helpers_.size()));
    Task task{others, helpers};
    if (helpers > 0) {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(&task);
      ++open_;
    }
    changed_.notify_all();
    std::exception_ptr failure;
    try {
      own();
    } catch (...) {
      failure = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      close(task);
    }
    const auto isOver = [&] { return task.helping == 0; };
    if (waiting == Waiting::Helping) {
      while (helpUntil(isOver)) {
      }
    } else {
      waitAwake(isOver);
      std::unique_lock lock(mutex_);
      wait(lock, isOver);
    }
    if (failure || task.failure) std::rethrow_exception(failure ? failure : task.failure);
    return helpers - task.wanted;
  }

private:
  /// No more helpers. \pre the lock is held
  void close(const Task& task) {
    const auto place = std::find(tasks_.begin(), tasks_.end(), &task);
    if (place == tasks_.end()) return;
    tasks_.erase(place);
    --open_;
  }

  /// Meanwhile the run may be ended; then its tasks soon are, so there is no less to wait for.
  template <class Condition>
  void wait(std::unique_lock<std::mutex>& lock, const Condition& isReady) {
    constexpr std::chrono::milliseconds kAtOnce{20};
    if (presentWatch() == nullptr) changed_.wait(lock, isReady);
    while (!changed_.wait_for(lock, kAtOnce, isReady)) {
      lock.unlock();
      try {
        checkpoint();
      } catch (const Interrupted&) {
        // Thrown again at the next one, after the wait.
      }
      lock.lock();
    }
  }

  /// Waits for a task and helps with it, or for the end; returns whether it was a task.
  template <class IsOver>
  bool helpUntil(const IsOver& isOver) {
    waitAwake([&] { return isOver() || open_ > 0; });
    std::unique_lock lock(mutex_);
    wait(lock, [&] { return isOver() || !tasks_.empty(); });
    if (isOver()) return false;
    Task& task = *tasks_.front();
    ++task.helping;
    if (--task.wanted == 0) close(task);
    lock.unlock();
    std::exception_ptr failure;
    try {
      const Watched watched(task.watch);
      task.run();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) task.failure = failure;
    --task.helping;
    changed_.notify_all();
    return true;
  }

  void help() {
    present = this; // loops within loops
    while (helpUntil([&] { return isOver_.load(); })) {
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Task*> tasks_;  ///< that want helpers
  std::atomic<int> open_ = 0; ///< as many
  std::atomic<bool> isOver_ = false;
  std::vector<std::thread> helpers_;
};

ThreadTeam::ThreadTeam() : before_(present) {
  if (present != nullptr) return;
  crew_ = std::make_unique<Crew>(threadCount() - 1);
  present = crew_.get();
}

ThreadTeam::~ThreadTeam() {
  present = before_;
}

int threadCount() {
  return threads();
}

void setThreadCount(int count) {
  threads() = std::clamp(count, 1, kMostThreads);
}

void forChunks(Eigen::Index count, Eigen::Index length,
               const std::function<void(const Chunk&)>& body) {
  const Eigen::Index chunks = chunkCount(count, length);
  const auto call = [&](Eigen::Index c) {
    checkpoint();
    body({c * length, std::min(count, (c + 1) * length), c});
  };
  const auto workers = static_cast<int>(std::min<Eigen::Index>(threadCount(), chunks));
  if (workers <= 1) {
    for (Eigen::Index c = 0; c < chunks; ++c) call(c);
    return;
  }
  // Each begins with a part of its own: what a thread had in one loop is in its cache for the next.
  std::vector<std::atomic<bool>> isTaken(static_cast<std::size_t>(chunks));
  const auto work = [&](int worker) {
    const Eigen::Index first = worker * chunks / workers;
    for (Eigen::Index i = 0; i < chunks; ++i) {
      const Eigen::Index c = (first + i) % chunks;
      if (!isTaken[static_cast<std::size_t>(c)].exchange(true)) call(c);
    }
  };
  std::atomic<int> helpers = 0;
  const ThreadTeam team;
  present->share([&] { work(0); }, [&] { work(++helpers); }, workers - 1, Waiting::Idle);
}

void inParallel(const std::function<void()>& first, const std::function<void()>& second) {
  if (threadCount() == 1) {
    first();
    second();
    return;
  }
  const ThreadTeam team;
  std::exception_ptr ofSecond;
  const auto keepingFailure = [&] {
    try {
      second();
    } catch (...) {
      ofSecond = std::current_exception();
    }
  };
  if (present->share(keepingFailure, first, 1, Waiting::Helping) == 0) first();
  if (ofSecond) std::rethrow_exception(ofSecond);
}

} // namespace massprops
