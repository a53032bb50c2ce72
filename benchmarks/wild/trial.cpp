#include "wild/trial.h"

#include "core/base/stopwatch.h"
#include "core/pipeline.h"
#include "judge/checks.h"
#include "judge/enclosure.h"
#include "judge/guarantee.h"
#include "judge/standing_gain.h"
#include "wild/model_files.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <new>
#include <variant>

namespace massprops::wild {
namespace {

/// Of the diagonal's cube: less is a sheet.
constexpr double kEnclosesNothing = 1e-5;
/// Of the wall: of rooms narrower than a wall, with what the depth is known within.
constexpr double kNarrow = 1.5 * 1.02;
constexpr double kSmallGain = 0.05; // degrees

void standOnEllipse(Options& options, double diagonal) {
  options.radiusX = options.radiusY = 0.02 * diagonal;
}

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

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

void limit(__rlimit_resource_t resource, double most) {
  rlimit value{};
  getrlimit(resource, &value);
  value.rlim_cur = std::isfinite(most) ? static_cast<rlim_t>(most) : value.rlim_max;
  setrlimit(resource, &value);
}

/// From now on.
void limitSeconds(double seconds) {
  limit(RLIMIT_CPU, std::ceil(cpuSeconds() + seconds));
}

template <std::size_t n>
void write(char (&to)[n], const std::string& text) {
  std::snprintf(to, n, "%s", text.c_str());
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

/// Both layers, equal vertices as one.
TriangleMesh welded(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh result;
  result.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  std::map<std::array<double, 3>, int> known;
  std::vector<Vec3> points;
  Eigen::Index row = 0;
  for (const TriangleMesh* mesh : {&a, &b}) {
    for (Eigen::Index f = 0; f < mesh->faces.rows(); ++f, ++row) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = mesh->vertices.row(mesh->faces(f, k)).transpose();
        const auto [place, isNew] =
            known.emplace(std::array<double, 3>{p.x(), p.y(), p.z()}, points.size());
        if (isNew) points.push_back(p);
        result.faces(row, k) = place->second;
      }
    }
  }
  result.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    result.vertices.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return result;
}

/// Faces of the layer without a corner on the surface: those of the strips have one.
TriangleMesh withoutStrips(const TriangleMesh& layer, const TriangleMesh& surface) {
  std::map<std::array<double, 3>, int> onSurface;
  for (const auto& p : surface.vertices.rowwise()) onSurface[{p[0], p[1], p[2]}] = 0;
  TriangleMesh result{layer.vertices, layer.faces};
  Eigen::Index rows = 0;
  for (const auto& face : layer.faces.rowwise()) {
    const bool isStrip = std::any_of(face.begin(), face.end(), [&](int v) {
      const auto p = layer.vertices.row(v);
      return onSurface.count({p[0], p[1], p[2]}) > 0;
    });
    if (!isStrip) result.faces.row(rows++) = face;
  }
  result.faces.conservativeResize(rows, 3);
  return result;
}

bool isVolumeReported(double volume, const Result& result) {
  const double reported = number(result, "volume_after");
  return std::abs(volume - reported) <= 1e-6 * std::abs(reported);
}

/// What the cavity breaks of what is promised for every model; empty: nothing.
std::string broken(const TriangleMesh& outer, const TriangleMesh& inner, double wall,
                   const Result& result, Trial& trial) {
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
  const double least = testing::separation(inner, outer).least;
  trial.wall = least / wall;
  if (least < wall) return "a wall too thin";
  // Both layers together bound the material.
  const double volume = testing::quadratureMoments(outer)[0] + testing::quadratureMoments(inner)[0];
  return isVolumeReported(volume, result) ? "" : "another volume";
}

std::string brokenShell(const TriangleMesh& skin, const TriangleMesh& layer, double wall,
                        const Result& result, Trial& trial) {
  const TriangleMesh shell = welded(skin, layer);
  if (!testing::isClosedAndOriented(shell)) return "not closed";
  if (testing::intersectingPairs(shell) != 0) return "crosses itself";
  const double least = testing::separation(withoutStrips(layer, skin), skin).least;
  trial.wall = least / wall;
  if (least < wall) return "a wall too thin";
  return isVolumeReported(testing::quadratureMoments(shell)[0], result) ? "" : "another volume";
}

/// What the report says.
void readReport(const Result& result, const Case& c, double wall, Trial& trial) {
  const std::string verdict = c.asked->verdict;
  trial.before = number(result, verdict + "_before");
  trial.after = number(result, verdict + "_after");
  trial.limit = number(result, verdict + "_limit");
  trial.gap = number(result, "gap_to_limit");
  trial.checkSeconds = number(result, "seconds_check");
  trial.violation = number(result, "max_constraint_violation");
  trial.isSolved = valueOf(result, "solved", false);
  trial.isSmall =
      c.asked->goal == GoalKind::Mass
          ? trial.before - trial.after < (1.0 - trial.gap) * c.asked->small * trial.before
          : std::abs(trial.limit - trial.before) < c.asked->small;
  trial.innerFaces = static_cast<long>(result.inner.faces.rows());
  const std::string repairs = valueOf<std::string>(result, "repairs", "");
  trial.isWrapped = repairs.find("wrapped") != std::string::npos;
  trial.moved = number(result, "repair_distance") / wall;
  write(trial.repairs, repairs);
}

Options optionsFor(const Case& c, double diagonal) {
  Options options;
  options.goal = c.asked->goal;
  options.cavityShape = c.shape;
  options.innerLowerBound = c.wallShare * diagonal;
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  c.asked->change(options, diagonal);
  return options;
}

/// Whether there is a result.
bool work(const TriangleMesh& model, Options& options, const Limits& limits, Trial& trial,
          Result& result) {
  forgetMostMemory();
  const double before = cpuSeconds();
  const double memoryBefore = memory("VmRSS:");
  const Stopwatch time;
  limitSeconds(limits.seconds);
  limit(RLIMIT_DATA, limits.megabytes * 1024.0 * 1024.0);
  const auto attempt = [&] {
    try {
      result = optimizeMassProperties(model, options);
      return true;
    } catch (const InvalidInput& refusal) {
      trial.outcome = Outcome::Refused;
      write(trial.reason, refusal.what());
    } catch (const std::bad_alloc&) {
      write(trial.reason, "memory");
    } catch (const std::exception& error) {
      write(trial.reason, std::string("exception: ") + error.what());
    }
    return false;
  };
  bool isDone = attempt();
  const auto isVase = [&] {
    return !isDone && trial.outcome == Outcome::Refused &&
           std::string(trial.reason).find("open_surface") != std::string::npos;
  };
  // Many are made with y upwards, so that their open base is there.
  if (isVase()) {
    trial = {};
    trial.isTurned = true;
    options.upAxis = UpAxis::PlusY;
    isDone = attempt();
  }
  if (isVase()) {
    trial = {};
    trial.isShell = options.openSurface = true;
    options.upAxis = UpAxis::PlusZ;
    isDone = attempt();
  }
  trial.cpu = cpuSeconds() - before;
  trial.seconds = time.seconds();
  trial.megabytes = memory("VmHWM:") - memoryBefore;
  limit(RLIMIT_DATA, INFINITY);
  limit(RLIMIT_CPU, INFINITY);
  return isDone;
}

} // namespace

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

bool isServed(const Trial& trial) {
  if (!trial.isJudged) return false;
  if (trial.outcome == Outcome::Hollow) return !trial.isBroken;
  return trial.outcome == Outcome::NothingFits && !isContradicted(trial);
}

bool isContradicted(const Trial& trial) {
  return trial.outcome == Outcome::NothingFits && trial.deepest > kNarrow &&
         trial.gain > kSmallGain;
}

void tryOut(const Case& c, const Limits& limits, const std::function<void(const Trial&)>& tell) {
  Trial trial;
  trial.outcome = Outcome::Unreadable;
  tell(trial); // for the reader may crash
  const TriangleMesh model = readModel(c.path);
  if (model.faces.rows() == 0 || !model.vertices.allFinite()) return;
  trial.outcome = Outcome::Failed;
  tell(trial);
  const double diagonal =
      (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
  Options options = optionsFor(c, diagonal);
  const double wall = *options.innerLowerBound;
  Result result;
  const bool isDone = work(model, options, limits, trial, result);
  if (isDone) {
    readReport(result, c, wall, trial);
    trial.outcome = trial.innerFaces > 0 ? Outcome::Hollow : Outcome::NothingFits;
  }
  trial.faces = static_cast<long>(model.faces.rows());
  tell(trial);

  constexpr double kJudgingSeconds = 900.0;
  limitSeconds(kJudgingSeconds);
  const testing::Enclosure enclosure = testing::enclosedBy(model);
  if (isDone && !trial.isShell) trial.volume = number(result, "volume_before") / enclosure.volume;
  if (!isDone && enclosure.volume < kEnclosesNothing * std::pow(diagonal, 3)) {
    trial.outcome = Outcome::EnclosesNothing;
  } else if (trial.outcome == Outcome::Hollow) {
    const TriangleMesh& outer = result.outer ? *result.outer : model;
    const auto check = trial.isShell ? brokenShell : broken;
    const std::string fault = check(outer, result.inner, wall, result, trial);
    trial.isBroken = !fault.empty();
    write(trial.reason, fault);
  } else if (trial.outcome == Outcome::NothingFits) {
    trial.deepest = testing::depthOf(model, wall).atMost / wall;
    if (c.asked->goal == GoalKind::Stand && trial.deepest > kNarrow && !trial.isTurned) {
      // Finer cubes only where coarse ones, which are in doubt too many, tell of a gain.
      for (const double side : {0.5 * wall, 0.25 * wall}) {
        const testing::StandingGain angles =
            testing::standingGain(result.outer ? *result.outer : model, wall, side);
        // Else it stands on something else.
        if (std::abs(angles.solid - trial.before) < kSmallGain)
          trial.gain = angles.best - angles.solid;
        if (trial.gain <= kSmallGain) break;
      }
    }
  }
  trial.isJudged = true;
  tell(trial);
}

} // namespace massprops::wild
