// Runs the filter on random models and checks every promise about every result.
//
// usage: property_run [--cases N] [--seed S] [--jobs J] [--only I] [--output FOLDER] [--verbose]
//
// Every case runs in a process of its own, so that a crash or a hang is a finding like any other.
// A finding prints how to run its case alone, and its model is written to FOLDER as PLY.
#include "core/base/stopwatch.h"
#include "judge/checks.h"
#include "judge/guarantee.h"
#include "shapes.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

/// A case that computes for longer counts as hanging, and so does one that waits for longer.
constexpr unsigned kSecondsAllowed = 60;
constexpr unsigned kWaitAllowed = 600;

struct Arguments {
  int cases = 360;
  std::uint32_t seed = 1;
  int jobs = 1;
  int only = -1;
  bool verbose = false;
  std::string output = "property_findings";
};

Arguments parsed(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--verbose") {
      a.verbose = true;
      continue;
    }
    if (i + 1 == argc) throw std::runtime_error(name + " needs a value");
    const std::string value = argv[++i];
    if (name == "--cases") {
      a.cases = std::stoi(value);
    } else if (name == "--seed") {
      a.seed = static_cast<std::uint32_t>(std::stoul(value));
    } else if (name == "--jobs") {
      a.jobs = std::stoi(value);
    } else if (name == "--only") {
      a.only = std::stoi(value);
    } else if (name == "--output") {
      a.output = value;
    } else {
      throw std::runtime_error("unknown option " + name);
    }
  }
  return a;
}

void writePly(const std::string& path, const TriangleMesh& mesh) {
  std::ofstream file(path);
  file.precision(17);
  file << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.rows()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
       << mesh.faces.rows() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
    file << mesh.vertices(v, 0) << ' ' << mesh.vertices(v, 1) << ' ' << mesh.vertices(v, 2) << '\n';
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    file << "3 " << mesh.faces(f, 0) << ' ' << mesh.faces(f, 1) << ' ' << mesh.faces(f, 2) << '\n';
}

/// What a child process tells: lines `key text`.
///   family …, about …, outcome hollow|solid|no gain|refused, broken …, note …
class Teller {
public:
  explicit Teller(int pipe) : pipe_(pipe) {}
  void operator()(const std::string& key, const std::string& text) const {
    std::string line = key + " " + text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    line += '\n';
    if (write(pipe_, line.data(), line.size()) < 0) _exit(3);
  }

private:
  int pipe_;
};

std::string outcomeOf(const Result& result) {
  if (result.inner.faces.rows() > 0) return "hollow";
  const bool noRoom = std::any_of(result.report.entries.begin(), result.report.entries.end(),
                                  [](const auto& entry) { return entry.first == "largest_wall"; });
  return noRoom ? "solid" : "no gain";
}

/// A wall a little below the largest that is said to work must work.
void runAtLargestWall(PropertyCase c, double largest, const Teller& tell) {
  c.wall = 0.99 * largest;
  c.options.innerLowerBound = c.wall;
  const Result result = optimizeMassProperties(c.input, c.options);
  const std::string outcome = outcomeOf(result);
  tell("note", "at 0.99 of the largest wall: " + outcome);
  if (outcome == "solid") tell("broken", "nothing can be hollowed at 0.99 of the largest wall");
  for (const std::string& sentence : brokenPromises(c, result))
    tell("broken", "at 0.99 of the largest wall: " + sentence);
}

/// The mended solid is the one that was broken: within 1 % of its mass, 3 % where it was wrapped,
/// and half a per cent of the diagonal of its centre.
void tellOfMending(const PropertyCase& c, const Result& result, const Teller& tell) {
  const std::string repairs = std::get<std::string>(result.report.at("repairs"));
  tell("note", "mended: " + repairs);
  const Body clean = bodyOf(quadratureMoments(c.body));
  const double share = std::get<double>(result.report.at("volume_before")) / clean.mass - 1.0;
  const bool isWrapped = repairs.find("wrapped") != std::string::npos;
  if (std::abs(share) > (isWrapped ? 0.03 : 0.01))
    tell("broken", "mending changed the volume by " + std::to_string(share));
  const Vec3 centre = std::get<Vec3>(result.report.at("center_of_mass_before"));
  const double diagonal =
      (c.body.vertices.colwise().maxCoeff() - c.body.vertices.colwise().minCoeff()).norm();
  if ((centre - clean.centre).norm() > 0.005 * diagonal)
    tell("broken", "mending moved the centre of mass");
}

void runCase(const Arguments& arguments, int index, const Teller& tell) {
  PropertyCase c = makeCase(arguments.seed, index);
  tell("family", c.family);
  tell("about", std::to_string(c.body.vertices.rows()) + " vertices, " + c.description);
  std::filesystem::create_directories(arguments.output);
  const std::string file =
      arguments.output + "/" + std::to_string(arguments.seed) + "-" + std::to_string(index);
  // Written first, for a crash tells nothing; the parent removes it when all is well.
  writePly(file + ".ply", c.input);
  try {
    int percent = 0;
    bool inOrder = true;
    const Result result = optimizeMassProperties(c.input, c.options, [&](int now, const char*) {
      inOrder = inOrder && now >= percent && now <= 100;
      percent = now;
    });
    const std::string outcome = outcomeOf(result);
    tell("outcome", outcome);
    if (!inOrder || percent != 100) tell("broken", "the progress does not go from 0 to 100");
    for (const auto& [key, value] : result.report.entries) {
      if (arguments.verbose) tell("note", key + " = " + toString(value));
      if (key == "skeleton_failures" && std::get<int>(value) > 0) tell("note", "skeleton failed");
    }
    if (arguments.verbose && result.inner.faces.rows() > 0)
      writePly(file + "-inner.ply", result.inner);
    if (c.isBroken) {
      tellOfMending(c, result, tell);
      // From here on what it was mended to counts.
      if (!result.outer) return;
      c.body = *result.outer;
    }
    for (const std::string& sentence : brokenPromises(c, result)) tell("broken", sentence);
    if (outcome == "solid") {
      const double largest = std::get<double>(result.report.at("largest_wall"));
      if (largest > 0.0) {
        if (!(largest < c.wall)) tell("broken", "the largest wall is not below the wall asked for");
        runAtLargestWall(c, largest, tell);
      } else {
        tell("note", "no wall works");
      }
    }
  } catch (const InvalidInput& e) {
    tell("outcome", "refused");
    tell("note", e.what());
    // Only what does not bound a body may be refused.
    const TriangleMesh plain = c.cavities.faces.rows() > 0 ? joined(c.body, c.cavities) : c.body;
    if (intersectingPairs(plain) == 0 && !hasFlatComponent(plain))
      tell("broken", "refused without a reason");
  } catch (const std::exception& e) {
    tell("broken", std::string("exception: ") + e.what());
  }
}

struct Outcome {
  int index = 0;
  std::string family = "?", about, outcome = "?";
  std::vector<std::string> broken, notes;
  double seconds = 0.0; ///< of computing, on all cores
};

struct Running {
  pid_t process;
  int pipe;
  int index;
};

Running start(const Arguments& arguments, int index) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) {
    close(ends[0]);
    const rlimit computing{kSecondsAllowed, kSecondsAllowed + 1};
    setrlimit(RLIMIT_CPU, &computing);
    alarm(kWaitAllowed);
    runCase(arguments, index, Teller(ends[1]));
    _exit(0);
  }
  close(ends[1]);
  return {process, ends[0], index};
}

Outcome finish(const Running& running, int status, double seconds) {
  Outcome result;
  result.index = running.index;
  result.seconds = seconds;
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(running.pipe, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(running.pipe);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    const std::string key = line.substr(0, space);
    const std::string value = line.substr(space + 1);
    if (key == "family") result.family = value;
    if (key == "about") result.about = value;
    if (key == "outcome") result.outcome = value;
    if (key == "broken") result.broken.push_back(value);
    if (key == "note") result.notes.push_back(value);
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM)) {
    result.broken.push_back("still running after " + std::to_string(kSecondsAllowed) +
                            " s of computing");
  } else if (WIFSIGNALED(status)) {
    result.broken.push_back(std::string("crashed: ") + strsignal(WTERMSIG(status)));
  } else if (WEXITSTATUS(status) != 0) {
    result.broken.push_back("ended with status " + std::to_string(WEXITSTATUS(status)));
  }
  return result;
}

void print(const Arguments& arguments, const Outcome& o) {
  if (o.broken.empty() && !arguments.verbose && arguments.only < 0) return;
  std::printf("%s case %d (%s, %s, %.1f s): %s\n", o.broken.empty() ? "ok" : "BROKEN", o.index,
              o.family.c_str(), o.outcome.c_str(), o.seconds, o.about.c_str());
  for (const std::string& sentence : o.broken) std::printf("    %s\n", sentence.c_str());
  for (const std::string& note : o.notes) std::printf("    (%s)\n", note.c_str());
  if (!o.broken.empty())
    std::printf("    again: property_run --seed %u --only %d\n", arguments.seed, o.index);
  std::fflush(stdout);
}

void printTable(std::vector<Outcome> outcomes) {
  struct Row {
    int cases = 0, hollow = 0, solid = 0, noGain = 0, refused = 0, broken = 0;
    double seconds = 0.0, slowest = 0.0;
  };
  std::map<std::string, Row> rows;
  for (const Outcome& o : outcomes) {
    for (Row* row : {&rows[o.family], &rows["~ all"]}) {
      ++row->cases;
      row->hollow += o.outcome == "hollow" ? 1 : 0;
      row->solid += o.outcome == "solid" ? 1 : 0;
      row->noGain += o.outcome == "no gain" ? 1 : 0;
      row->refused += o.outcome == "refused" ? 1 : 0;
      row->broken += o.broken.empty() ? 0 : 1;
      row->seconds += o.seconds;
      row->slowest = std::max(row->slowest, o.seconds);
    }
  }
  std::printf("\n%-8s %6s %7s %8s %8s %8s %7s %9s %9s\n", "family", "cases", "hollow", "no room",
              "no gain", "refused", "broken", "seconds", "slowest");
  for (const auto& [family, r] : rows)
    std::printf("%-8s %6d %7d %8d %8d %8d %7d %9.1f %9.1f\n",
                family == "~ all" ? "all" : family.c_str(), r.cases, r.hollow, r.solid, r.noGain,
                r.refused, r.broken, r.seconds, r.slowest);
  std::sort(outcomes.begin(), outcomes.end(),
            [](const Outcome& a, const Outcome& b) { return a.seconds > b.seconds; });
  std::printf("\nslowest:\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(5, outcomes.size()); ++i)
    std::printf("  %5.1f s  case %d (%s, %s): %s\n", outcomes[i].seconds, outcomes[i].index,
                outcomes[i].family.c_str(), outcomes[i].outcome.c_str(), outcomes[i].about.c_str());
}

int run(const Arguments& arguments) {
  std::vector<int> waiting;
  for (int i = arguments.cases - 1; i >= 0; --i) waiting.push_back(i);
  if (arguments.only >= 0) waiting = {arguments.only};
  const Stopwatch total;
  std::vector<Running> running;
  std::vector<Outcome> outcomes;
  while (!waiting.empty() || !running.empty()) {
    while (!waiting.empty() && static_cast<int>(running.size()) < arguments.jobs) {
      running.push_back(start(arguments, waiting.back()));
      waiting.pop_back();
    }
    int status = 0;
    rusage used{};
    const pid_t ended = wait4(-1, &status, 0, &used);
    const auto which = std::find_if(running.begin(), running.end(),
                                    [&](const Running& r) { return r.process == ended; });
    if (which == running.end()) continue;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    Outcome outcome = finish(*which, status, seconds(used.ru_utime) + seconds(used.ru_stime));
    if (outcome.broken.empty() && !arguments.verbose) {
      std::filesystem::remove(arguments.output + "/" + std::to_string(arguments.seed) + "-" +
                              std::to_string(outcome.index) + ".ply");
    }
    print(arguments, outcome);
    outcomes.push_back(std::move(outcome));
    running.erase(which);
  }
  const auto broken = std::count_if(outcomes.begin(), outcomes.end(),
                                    [](const Outcome& o) { return !o.broken.empty(); });
  if (arguments.only < 0) printTable(outcomes);
  std::printf("\n%zu cases, %ld broken, %.0f s\n", outcomes.size(), static_cast<long>(broken),
              total.seconds());
  if (broken == 0 && std::filesystem::is_directory(arguments.output) &&
      std::filesystem::is_empty(arguments.output))
    std::filesystem::remove(arguments.output);
  return broken == 0 ? 0 : 1;
}

} // namespace
} // namespace massprops::testing

int main(int argc, char** argv) {
  try {
    return massprops::testing::run(massprops::testing::parsed(argc, argv));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "property_run: %s\n", e.what());
    return 2;
  }
}
