#include "core/parallel.h"

#include <atomic>
#include <future>
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

} // namespace

int threadCount() {
  return threads();
}

void setThreadCount(int count) {
  threads() = std::clamp(count, 1, kMostThreads);
}

void forChunks(Eigen::Index count, Eigen::Index length,
               const std::function<void(const Chunk&)>& body) {
  const Eigen::Index chunks = chunkCount(count, length);
  std::atomic<Eigen::Index> next = 0;
  const auto work = [&] {
    for (Eigen::Index c = next++; c < chunks; c = next++) {
      body({c * length, std::min(count, (c + 1) * length), c});
    }
  };
  std::vector<std::future<void>> others;
  for (Eigen::Index t = 1; t < std::min<Eigen::Index>(threadCount(), chunks); ++t) {
    others.push_back(std::async(std::launch::async, work));
  }
  // The futures of std::async wait in their destructors, should this throw.
  work();
  for (std::future<void>& other : others) other.get();
}

void inParallel(const std::function<void()>& first, const std::function<void()>& second) {
  if (threadCount() == 1) {
    first();
    second();
    return;
  }
  std::future<void> other = std::async(std::launch::async, first);
  second();
  other.get();
}

} // namespace massprops
