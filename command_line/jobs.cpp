#include "command_line/jobs.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <map>
#include <system_error>

namespace massprops {

int runJobs(const std::vector<std::string>& models, int jobs,
            const std::function<int(const std::string& model)>& work,
            const std::function<void(const std::string& model)>& crashed) {
  std::map<pid_t, std::string> running;
  int worst = 0;
  const auto waitForOne = [&] {
    int status = 0;
    const pid_t child = waitpid(-1, &status, 0);
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
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
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
