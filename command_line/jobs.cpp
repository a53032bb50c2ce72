#include "command_line/jobs.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <system_error>

namespace massprops {
namespace {

std::system_error failureOf(const char* call) {
  return {errno, std::generic_category(), call};
}

/// A child ends with its parent, which may have ended already.
void endWith(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(2);
}

} // namespace

int runJobs(const std::vector<std::string>& models, int jobs,
            const std::function<int(const std::string& model)>& work,
            const std::function<void(const std::string& model)>& crashed) {
  std::signal(SIGCHLD, SIG_DFL); // who is started with it ignored is never told how children end
  const pid_t self = getpid();
  std::map<pid_t, std::string> running;
  int worst = 0;
  const auto waitForOne = [&] {
    int status = 0;
    const pid_t child = waitpid(-1, &status, 0);
    if (child < 0 && errno != EINTR) throw failureOf("waitpid");
    const auto ended = running.find(child);
    if (ended == running.end()) return;
    if (!WIFEXITED(status)) crashed(ended->second);
    worst = std::max(worst, WIFEXITED(status) ? WEXITSTATUS(status) : 2);
    running.erase(ended);
  };
  for (const std::string& model : models) {
    if (static_cast<int>(running.size()) >= jobs) waitForOne();
    std::cout.flush();
    const pid_t child = fork();
    if (child < 0) throw failureOf("fork");
    if (child == 0) {
      endWith(self);
      const int status = work(model);
      std::cout.flush();
      _exit(status);
    }
    running[child] = model;
  }
  while (!running.empty()) waitForOne();
  return worst;
}

} // namespace massprops
