#include "wild/processes.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>

namespace massprops::wild {
namespace {

struct Running {
  std::size_t number;
  int pipe;
};

[[noreturn]] void child(const Case& c, const Limits& limits, int pipe) {
  // Of a crash the name of the signal says enough.
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const int quiet = std::freopen("/dev/null", "w", stderr) != nullptr ? 0 : 1;
  tryOut(c, limits, [&](const Trial& trial) {
    static_assert(sizeof trial <= 4096, "a pipe takes it at once");
    if (write(pipe, &trial, sizeof trial) != static_cast<ssize_t>(sizeof trial)) _exit(1);
  });
  _exit(quiet);
}

/// What the process told last, or how it ended.
Trial resultOf(int pipe, int status, const rusage& usage) {
  Trial trial;
  Trial next;
  while (read(pipe, &next, sizeof next) == static_cast<ssize_t>(sizeof next)) trial = next;
  close(pipe);
  if (trial.outcome != Outcome::Failed || trial.reason[0] != '\0') return trial;
  trial.megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
  trial.cpu = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const char* const what = signal == SIGXCPU   ? "time"
                           : signal == SIGABRT ? "assertion"
                           : signal == SIGKILL ? "killed"
                           : signal != 0       ? strsignal(signal)
                                               : "no answer";
  std::snprintf(trial.reason, sizeof trial.reason, "%s", what);
  return trial;
}

} // namespace

void runAll(const std::vector<Case>& cases, int jobs, const Limits& limits,
            const std::function<void(const Case&, const Trial&)>& visit) {
  std::map<pid_t, Running> running;
  std::map<std::size_t, Trial> waiting;
  std::size_t started = 0;
  std::size_t told = 0;
  while (told < cases.size()) {
    while (started < cases.size() && static_cast<int>(running.size()) < jobs) {
      int ends[2];
      if (pipe(ends) != 0) return;
      const pid_t process = fork();
      if (process < 0) return;
      if (process == 0) {
        close(ends[0]);
        child(cases[started], limits, ends[1]);
      }
      close(ends[1]);
      running[process] = {started++, ends[0]};
    }
    int status = 0;
    rusage usage{};
    const pid_t ended = wait4(-1, &status, 0, &usage);
    const auto found = running.find(ended);
    if (found == running.end()) return;
    waiting[found->second.number] = resultOf(found->second.pipe, status, usage);
    running.erase(found);
    for (auto next = waiting.find(told); next != waiting.end(); next = waiting.find(told)) {
      visit(cases[told], next->second);
      waiting.erase(next);
      ++told;
    }
  }
}

} // namespace massprops::wild
