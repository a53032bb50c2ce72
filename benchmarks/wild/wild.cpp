// Models as people publish them: every goal, wall and shape of cavity that is asked for, judged by
// the code of tests/judge, which shares none with the library. benchmarks/results.md keeps
// summaries with the sources of the models.
//
// usage: wild [jobs=1] [seconds=60] [megabytes=2048] walls shapes goals paths…
//   walls   in per cent of the diagonal: 1,2
//   shapes  entries of cavity_shape: 0,1,2. With 1 and 2 their processor times are compared at last
//   goals   names of wild/trial.cpp, or all: stand,mass
//   paths   files, or folders with all that is in them; name.obj:2 is the model with every triangle
//           cut in four, twice
//
// Columns: what the solid, the result and the limit reach; gap (* the gain is small), violation,
// triangles; the least wall that was measured and the way that mending moved the surface, in walls;
// the volume of the (mended) solid, by what the given triangles enclose; seconds of processor and
// wall time, and for checking and mending the model; memory above the model.
#include "wild/model_files.h"
#include "wild/processes.h"
#include "wild/summary.h"
#include "wild/trial.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace massprops;
using namespace massprops::wild;

namespace {

std::vector<std::string> words(const std::string& list) {
  std::vector<std::string> result;
  std::stringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) result.push_back(word);
  return result;
}

std::vector<Case> casesOf(const std::vector<std::string>& arguments) {
  const std::vector<std::string> wanted = words(arguments[2]);
  std::vector<Case> cases;
  for (const std::string& path : modelFiles({arguments.begin() + 3, arguments.end()})) {
    for (const Asked& asked : goals()) {
      if (wanted.front() != "all" &&
          std::find(wanted.begin(), wanted.end(), asked.name) == wanted.end())
        continue;
      for (const std::string& wall : words(arguments[0])) {
        for (const std::string& shape : words(arguments[1])) {
          cases.push_back(
              {path, &asked, std::stod(wall) / 100.0, static_cast<CavityShape>(std::stoi(shape))});
        }
      }
    }
  }
  return cases;
}

} // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::map<std::string, double> named = {{"jobs", 1.0}, {"seconds", 60.0}, {"megabytes", 2048.0}};
  while (!arguments.empty()) {
    const std::size_t equals = arguments.front().find('=');
    const auto found = named.find(arguments.front().substr(0, equals));
    if (equals == std::string::npos || found == named.end()) break;
    found->second = std::stod(arguments.front().substr(equals + 1));
    arguments.erase(arguments.begin());
  }
  if (arguments.size() < 4) {
    std::printf("usage: wild [jobs=1] [seconds=60] [megabytes=2048] walls shapes goals paths…\n");
    return 2;
  }
  printHead();
  std::vector<std::pair<Case, Trial>> trials;
  runAll(casesOf(arguments), static_cast<int>(named["jobs"]),
         {named["seconds"], named["megabytes"]}, [&](const Case& c, const Trial& trial) {
           print(c, trial);
           trials.emplace_back(c, trial);
         });
  printSummary(trials);
}
