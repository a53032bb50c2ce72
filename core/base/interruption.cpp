#include "core/base/interruption.h"

#include <atomic>
#include <exception>
#include <thread>

namespace massprops {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<std::chrono::milliseconds> timeBetween{kTimeBetweenQuestions};

thread_local Watch* present = nullptr;

} // namespace

class Watch {
public:
  explicit Watch(const std::function<void()>& ask) : ask_(ask) {}

  void check(bool isDue) {
    if (isOver_) throw Interrupted();
    if (std::this_thread::get_id() != owner_) return;
    const Clock::time_point now = Clock::now();
    if (!isDue && now - asked_ < timeBetween.load()) return;
    asked_ = now;
    try {
      ask_();
    } catch (...) {
      reason_ = std::current_exception();
      isOver_ = true;
      throw Interrupted();
    }
  }
  [[noreturn]] void rethrowReason() const { std::rethrow_exception(reason_); }

private:
  const std::function<void()>& ask_;
  const std::thread::id owner_ = std::this_thread::get_id();
  Clock::time_point asked_ = Clock::now();
  std::exception_ptr reason_;
  std::atomic<bool> isOver_ = false;
};

void interruptibly(const std::function<void()>& ask, const std::function<void()>& run) {
  Watch watch(ask);
  const Watched watched(&watch);
  try {
    run();
  } catch (const Interrupted&) {
    watch.rethrowReason();
  }
}

void checkpoint() {
  if (present != nullptr) present->check(false);
}

void askNow() {
  if (present != nullptr) present->check(true);
}

Watch* presentWatch() {
  return present;
}

Watched::Watched(Watch* watch) : before_(present) {
  present = watch;
}

Watched::~Watched() {
  present = before_;
}

void setTimeBetweenQuestions(std::chrono::milliseconds time) {
  timeBetween = time;
}

} // namespace massprops
