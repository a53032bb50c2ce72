// Several models at once, a process each: one that crashes or eats the memory stops no other.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace massprops {

/// Calls `work` for each model in a child process of its own, at most `jobs` at a time, in the
/// order of the list. `work` returns an exit status; `crashed` is called here for a child that
/// ended without one. Returns the greatest status, 2 for a child that crashed. \pre no threads run.
/// \throw std::system_error when no process can be started
int runJobs(const std::vector<std::string>& models, int jobs,
            const std::function<int(const std::string& model)>& work,
            const std::function<void(const std::string& model)>& crashed);

} // namespace massprops
