// massprops: the filter without MeshLab.
#include "command_line/arguments.h"
#include "command_line/description.h"
#include "command_line/hollowing.h"
#include "command_line/jobs.h"
#include "core/base/parallel.h"
#include "core/failure.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace {

using namespace massprops;

enum Status { kSolved = 0, kMissed = 1, kRefused = 2 };

void complain(const std::string& model, const std::string& sentence) {
  std::cerr << "massprops: " + (model.empty() ? "" : model + ": ") + sentence + "\n";
}

Progress barOnTerminal() {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [](int percent, const char* stage) {
    // \033[K clears what is left of a longer line.
    std::cerr << '\r' << percent << " % " << stage << "\033[K" << std::flush;
    if (percent == 100) std::cerr << "\r\033[K" << std::flush;
  };
}

int run(const std::string& model, const Arguments& arguments) {
  const bool isAlone = arguments.jobs == 1;
  const Progress progress = arguments.quiet || !isAlone ? Progress{} : barOnTerminal();
  try {
    const Outcome outcome = hollow(model, arguments, progress);
    // The report alone, where it is the output.
    if (!arguments.quiet && arguments.outputs.report != "-") {
      std::cout << model + ": " + outcome.line + "\n" << std::flush;
    }
    return outcome.solved ? kSolved : kMissed;
  } catch (...) {
    if (progress) std::cerr << "\r\033[K";
    complain(model, sentenceOfFailure());
    return kRefused;
  }
}

int runAll(const Arguments& arguments) {
  requireSensible(arguments);
  if (arguments.models.size() == 1) return run(arguments.models.front(), arguments);
  setThreadCount(std::max(1, threadCount() / arguments.jobs));
  return runJobs(
      arguments.models, arguments.jobs,
      [&](const std::string& model) { return run(model, arguments); },
      [](const std::string& model) {
        complain(model, "The program crashed on this model; the others go on.");
      });
}

} // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    if (!arguments.describe.empty()) {
      std::cout << described(arguments.describe);
      return kSolved;
    }
    return runAll(arguments);
  } catch (const ParsedEnd& end) {
    return end.exitStatus;
  } catch (...) {
    complain("", sentenceOfFailure());
    return kRefused;
  }
}
