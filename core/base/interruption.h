// A run that its caller ends, wherever it is.
#pragma once

#include <chrono>
#include <functional>

namespace massprops {

/// On its way out of a run that is to end. No std::exception, so that no stage takes it for a
/// failure of its own.
struct Interrupted {};

/// Who asks the caller of a run whether to go on.
class Watch;

/// Calls `run`. At its checkpoints on this thread, and while this one waits for others, `ask` is
/// called; what that throws ends the run on all its threads and is thrown from here.
void interruptibly(const std::function<void()>& ask, const std::function<void()>& run);

/// Asks, where that was not done a moment ago. Takes some 30 ns; does nothing outside of
/// `interruptibly`. \throw Interrupted where the run is to end
void checkpoint();
/// The same, but asks in any case.
void askNow();

/// The watch of what this thread does; null: none.
Watch* presentWatch();
/// Lets this thread work for a run of another one, which alone asks; puts back what was before.
class Watched {
public:
  explicit Watched(Watch* watch);
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

private:
  Watch* before_;
};

/// A fifth of what users wait without noticing; a question to Python or to a window takes
/// microseconds.
constexpr std::chrono::milliseconds kTimeBetweenQuestions{40};
/// For tests.
void setTimeBetweenQuestions(std::chrono::milliseconds time);

} // namespace massprops
