// Models as people publish them: every goal, wall and shape of cavity that is asked for, a process
// each, judged by the code of tests/judge, which shares none with the library.
// benchmarks/results.md keeps summaries with the sources of the models.
//
// usage: wild walls shapes goals files…
//   walls   in per cent of the diagonal: 1,2
//   shapes  entries of cavity_shape: 0,1,2. With 1 and 2 their processor times are compared at last
//   goals   names below, or all: stand,mass. Where it says so the contact is an ellipse with half
//           axes of a fiftieth of the diagonal, for models that touch the ground in a point.
//   files   name.obj:2 is the model with every triangle cut in four, twice
#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/pipeline.h"
#include "core/vcg_conversion.h"
#include "judge/checks.h"
#include "judge/guarantee.h"
#include "shapes.h"

#include <vcg/complex/algorithms/clean.h>
#include <wrap/io_trimesh/import.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using namespace massprops;

struct Vertex;
struct Face;
struct Used : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
struct Vertex : vcg::Vertex<Used, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
struct Face : vcg::Face<Used, vcg::face::VertexRef, vcg::face::BitFlags> {};
struct Mesh : vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

/// As the host opens it, equal vertices merged, with a longest side of 100.
TriangleMesh readMesh(const std::string& file) {
  const std::size_t colon = file.find_last_of(':');
  const std::string path = file.substr(0, colon);
  const int cuts = colon == std::string::npos ? 0 : std::stoi(file.substr(colon + 1));
  Mesh mesh;
  namespace io = vcg::tri::io;
  if (path.size() > 4 && path.compare(path.size() - 4, 4, ".obj") == 0) {
    io::ImporterOBJ<Mesh>::Info info;
    if (!io::ImporterOBJ<Mesh>::LoadMask(path.c_str(), info)) return {};
    // Faces whose textures or normals it has no place for would be left out.
    info.mask = io::Mask::IOM_VERTCOORD | io::Mask::IOM_FACEINDEX;
    io::ImporterOBJ<Mesh>::Open(mesh, path.c_str(), info);
  } else {
    int mask = 0;
    io::Importer<Mesh>::Open(mesh, path.c_str(), mask);
  }
  vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(mesh);
  vcg::tri::Clean<Mesh>::RemoveUnreferencedVertex(mesh);
  if (mesh.VN() == 0) return {};
  TriangleMesh result = fromVcg(mesh, Placement::Identity());
  for (int i = 0; i < cuts; ++i) result = testing::subdivided(result);
  const double side =
      (result.vertices.colwise().maxCoeff() - result.vertices.colwise().minCoeff()).maxCoeff();
  // As a float mesh stores it.
  result.vertices = (result.vertices * (100.0 / side)).cast<float>().cast<double>().eval();
  return result;
}

struct Asked {
  const char* name;
  GoalKind goal;
  const char* verdict; ///< key of what the goal is judged by
  double small;        ///< a gain below this is judged by itself
  std::function<void(Options&, double diagonal)> change = [](Options&, double) {};
};

void standOnEllipse(Options& options, double diagonal) {
  options.radiusX = options.radiusY = 0.02 * diagonal;
}

const std::vector<Asked>& goals() {
  static const std::vector<Asked> list = {
      {"stand", GoalKind::Stand, "tip_angle", 0.2},
      {"stand_on_ellipse", GoalKind::Stand, "tip_angle", 0.2, standOnEllipse},
      {"spin", GoalKind::Spin, "axis_tilt", 0.2},
      {"yo_yo", GoalKind::YoYo, "axis_tilt", 0.2},
      {"filled_on_ellipse", GoalKind::StandEmptyAndFilled, "tip_angle_filled", 0.2,
       [](Options& options, double diagonal) {
         standOnEllipse(options, diagonal);
         options.fillDensity = 1.0;
       }},
      {"roll_upright", GoalKind::RollUpright, "rest_tilt", 0.2},
      {"float", GoalKind::Float, "heel_angle", 0.2},
      {"hang", GoalKind::Hang, "hanging_angle", 0.2},
      {"mass", GoalKind::Mass, "mass", 0.01},
  };
  return list;
}

struct Line {
  char text[400] = "";
  enum Kind { Served, NothingFits, Refused, Failed } kind = Failed;
  bool solved = false;
  bool isSmall = false; ///< the gain that is possible
  bool isBroken = false;
  double gap = -1.0;
  double cpu = 0.0;
};

/// Of this process in megabytes, by its key in /proc: VmRSS now, VmHWM at most.
double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, key.size(), key) == 0) return std::stod(line.substr(key.size() + 1)) / 1024;
  }
  return NAN;
}

/// What reading a model took does not count from here on.
void forgetMostMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class T>
T valueOf(const Result& result, const std::string& key, T otherwise) {
  for (const auto& [name, value] : result.report.entries) {
    if (name == key) return std::get<T>(value);
  }
  return otherwise;
}

double number(const Result& result, const std::string& key) {
  return valueOf<double>(result, key, NAN);
}

/// What the result breaks of what is promised for every model; empty: nothing.
std::string broken(const TriangleMesh& outer, const TriangleMesh& inner, double wall,
                   const Result& result) {
  if (!testing::isClosedAndOriented(inner)) return "not closed";
  if (testing::intersectingPairs(inner) != 0) return "crosses itself";
  if (testing::intersectingPairs(inner, outer) != 0) return "crosses the outer surface";
  // Nothing crosses, so that some vertices of every component would do; all take minutes.
  constexpr Eigen::Index kSome = 64;
  const Eigen::Index step = std::max<Eigen::Index>(inner.vertices.rows() / kSome, 1);
  TriangleMesh some;
  some.vertices.resize((inner.vertices.rows() + step - 1) / step, 3);
  for (Eigen::Index i = 0; i < some.vertices.rows(); ++i)
    some.vertices.row(i) = inner.vertices.row(i * step);
  if (!testing::isInside(some, outer)) return "not inside";
  if (testing::separation(inner, outer).least < wall) return "a wall too thin";
  // Both layers together bound the material.
  const double volume = testing::quadratureMoments(outer)[0] + testing::quadratureMoments(inner)[0];
  const double reported = number(result, "volume_after");
  return std::abs(volume - reported) <= 1e-6 * std::abs(reported) ? "" : "another volume";
}

Line measure(const std::string& path, const Asked& asked, double wallShare, CavityShape shape) {
  Line line;
  const std::string file = path.substr(path.find_last_of('/') + 1);
  const TriangleMesh model = readMesh(path);
  if (model.faces.rows() == 0) {
    std::snprintf(line.text, sizeof line.text, "%-38.38s cannot be read", file.c_str());
    return line;
  }
  const double diagonal =
      (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
  Options options;
  options.goal = asked.goal;
  options.cavityShape = shape;
  options.innerLowerBound = wallShare * diagonal;
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  asked.change(options, diagonal);
  const int length = std::snprintf(line.text, sizeof line.text, "%-38.38s %7ld %-17s %4.3g %d ",
                                   file.c_str(), static_cast<long>(model.faces.rows()), asked.name,
                                   100.0 * wallShare, static_cast<int>(shape));
  char* rest = line.text + length;
  const std::size_t room = sizeof line.text - static_cast<std::size_t>(length);
  forgetMostMemory();
  const double memoryBefore = memory("VmRSS:");
  const double before = cpuSeconds();
  const Stopwatch time;
  Result result;
  try {
    result = optimizeMassProperties(model, options);
  } catch (const std::exception& error) {
    line.kind = Line::Refused;
    line.cpu = cpuSeconds() - before;
    std::snprintf(rest, room, "refused: %.160s", error.what());
    return line;
  }
  const double seconds = time.seconds();
  line.cpu = cpuSeconds() - before;
  const double memoryAbove = memory("VmHWM:") - memoryBefore;
  const std::string verdict = asked.verdict;
  const double solid = number(result, verdict + "_before");
  const double limit = number(result, verdict + "_limit");
  line.gap = number(result, "gap_to_limit");
  line.solved = std::get<bool>(result.report.at("solved"));
  const double after = number(result, verdict + "_after");
  line.isSmall = asked.goal == GoalKind::Mass
                     ? solid - after < (1.0 - line.gap) * asked.small * solid
                     : std::abs(limit - solid) < asked.small;
  line.kind = result.inner.faces.rows() > 0 ? Line::Served : Line::NothingFits;
  std::string fault;
  if (line.kind == Line::Served) {
    const TriangleMesh& outer = result.outer ? *result.outer : model;
    fault = broken(outer, result.inner, *options.innerLowerBound, result);
    line.isBroken = !fault.empty();
  }
  const auto delivered = valueOf<std::string>(result, "cavity_shape", "");
  std::snprintf(
      rest, room, "%-4s %8.3f %8.3f %8.3f %7.2f%%%s %8.1e %7ld %7.2f %7.2f %7.2f %5.0f  %s%.40s",
      line.kind == Line::NothingFits ? "none"
      : line.solved                  ? "yes"
                                     : "no",
      solid, after, limit, 100.0 * line.gap, line.isSmall ? "*" : " ",
      number(result, "max_constraint_violation"), static_cast<long>(result.inner.faces.rows()),
      line.cpu, seconds, number(result, "seconds_check"), memoryAbove,
      fault.empty() ? "" : ("BROKEN: " + fault + "; ").c_str(), delivered.c_str());
  return line;
}

/// In a process of its own: memory is that of the case, and a crash or a case without an end is
/// only its own.
Line measureApart(const std::string& path, const Asked& asked, double wall, CavityShape shape) {
  constexpr unsigned kSeconds = 300;
  int ends[2];
  Line line;
  if (pipe(ends) != 0) return line;
  const pid_t child = fork();
  if (child == 0) {
    alarm(kSeconds);
    line = measure(path, asked, wall, shape);
    if (write(ends[1], &line, sizeof line) != static_cast<ssize_t>(sizeof line)) _exit(1);
    _exit(0);
  }
  close(ends[1]);
  std::size_t got = 0;
  while (got < sizeof line) {
    const auto n = read(ends[0], reinterpret_cast<char*>(&line) + got, sizeof line - got);
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (got == sizeof line) return line;
  line = Line{};
  std::snprintf(line.text, sizeof line.text, "%-38.38s %7s %-17s %4.3g %d FAILED: %s",
                path.substr(path.find_last_of('/') + 1).c_str(), "", asked.name, 100.0 * wall,
                static_cast<int>(shape),
                WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "no answer");
  return line;
}

std::vector<std::string> words(const char* list) {
  std::vector<std::string> result;
  std::stringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) result.push_back(word);
  return result;
}

void summarize(const std::string& title, const std::vector<Line>& lines) {
  std::array<int, 4> count{};
  std::vector<double> gaps;
  std::vector<double> seconds;
  int solved = 0;
  int broken = 0;
  int small = 0;
  for (const Line& line : lines) {
    ++count[static_cast<std::size_t>(line.kind)];
    solved += static_cast<int>(line.solved);
    broken += static_cast<int>(line.isBroken);
    if (line.kind != Line::Served && line.kind != Line::NothingFits) continue;
    seconds.push_back(line.cpu);
    if (line.isSmall) {
      ++small;
    } else if (std::isfinite(line.gap)) {
      gaps.push_back(line.gap);
    }
  }
  std::sort(gaps.begin(), gaps.end());
  std::sort(seconds.begin(), seconds.end());
  const auto middle = [](const std::vector<double>& v) {
    return v.empty() ? NAN : v[v.size() / 2];
  };
  std::printf("%-32s %3zu models: hollow %d, nothing fits %d, refused %d, failed %d; solved %d, "
              "broken %d; gap median %.2f %%, largest %.2f %%, above 3 %%: %ld of %zu, small gains "
              "apart: %d; CPU median %.2f s, largest %.2f s\n",
              title.c_str(), lines.size(), count[Line::Served], count[Line::NothingFits],
              count[Line::Refused], count[Line::Failed], solved, broken, 100.0 * middle(gaps),
              gaps.empty() ? NAN : 100.0 * gaps.back(),
              static_cast<long>(gaps.end() - std::upper_bound(gaps.begin(), gaps.end(), 0.03)),
              gaps.size(), small, middle(seconds), seconds.empty() ? NAN : seconds.back());
}

/// Processor time of the best possible cavity over that of the offset surface, model by model.
void compare(const std::string& title, const std::vector<Line>& offset,
             const std::vector<Line>& best) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    const bool areBoth = std::max(offset[i].kind, best[i].kind) <= Line::NothingFits;
    if (areBoth) ratios.push_back(best[i].cpu / offset[i].cpu);
  }
  if (ratios.empty()) return;
  std::sort(ratios.begin(), ratios.end());
  std::printf("%-32s Best possible over Offset surface, CPU, %zu models: median %.2f, largest "
              "%.2f, above 2: %ld\n",
              title.c_str(), ratios.size(), ratios[ratios.size() / 2], ratios.back(),
              static_cast<long>(ratios.end() - std::upper_bound(ratios.begin(), ratios.end(), 2)));
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::printf("usage: wild walls shapes goals files…\n");
    return 2;
  }
  const std::vector<std::string> wanted = words(argv[3]);
  std::printf("%-38s %7s %-17s %4s %s %-4s %8s %8s %8s %8s %8s %7s %7s %7s %7s %5s\n", "model",
              "faces", "goal", "wall", "s", "done", "before", "after", "limit", "gap", "violat.",
              "inner", "CPU s", "s", "check s", "MB");
  std::map<std::pair<std::string, std::string>, std::vector<Line>> byTitle; // and by shape
  for (int i = 4; i < argc; ++i) {
    for (const Asked& asked : goals()) {
      if (wanted.front() != "all" &&
          std::find(wanted.begin(), wanted.end(), asked.name) == wanted.end())
        continue;
      for (const std::string& wall : words(argv[1])) {
        for (const std::string& shape : words(argv[2])) {
          const Line line = measureApart(argv[i], asked, std::stod(wall) / 100.0,
                                         static_cast<CavityShape>(std::stoi(shape)));
          std::printf("%s\n", line.text);
          std::fflush(stdout);
          byTitle[{std::string(asked.name) + ", wall " + wall + " %", shape}].push_back(line);
        }
      }
    }
  }
  for (const auto& [title, lines] : byTitle) {
    summarize(title.first + ", shape " + title.second, lines);
    const auto offset = byTitle.find({title.first, "1"});
    if (title.second == "2" && offset != byTitle.end()) compare(title.first, offset->second, lines);
  }
}
