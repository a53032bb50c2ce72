// A run that its caller ends leaves nothing behind: no file, no thread, and a model as good as new.
#include "core/base/interruption.h"
#include "core/pipeline.h"

#include "large_test.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

namespace fs = std::filesystem;

struct Enough {};

std::ptrdiff_t entriesOf(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

struct Case {
  std::string name;
  TriangleMesh mesh;
  Options options;
};

Case cancelled(const std::string& name, const TriangleMesh& mesh, GoalKind goal,
               CavityShape shape) {
  Case result{name, mesh, {}};
  result.options.goal = goal;
  result.options.cavityShape = shape;
  result.options.basisSize = 8;
  result.options.innerLowerBound = 0.1;
  return result;
}

TriangleMesh overlapping() {
  return joined(blob(6), shifted(blob(5), {0.9, 0.3, 0.1}));
}

class Cancelling : public ::testing::TestWithParam<Case> {};

TEST_P(Cancelling, LeavesNothingBehindWhereverItComes) {
  LARGE_TEST();
  constexpr int kRuns = 12; // spread over all questions of a run
  constexpr int kThese = 6; // of them are tried again on the same model
  setTimeBetweenQuestions(std::chrono::milliseconds(0));
  const fs::path folder =
      fs::temp_directory_path() / ("massprops-cancelling-" + std::to_string(getpid()));
  fs::create_directory(folder);
  Options options = GetParam().options;
  options.printFile = (folder / "project.3mf").string();
  int questions = 0;
  const Result whole =
      optimizeMassProperties(GetParam().mesh, options, [&](int, const char*) { ++questions; });
  fs::remove(options.printFile);
  const std::ptrdiff_t threads = entriesOf("/proc/self/task");
  for (int run = 0; run < kRuns; ++run) {
    const int last = static_cast<int>(static_cast<long>(questions - 1) * run / kRuns);
    int asked = 0;
    const auto progress = [&](int, const char*) {
      if (asked++ == last) throw Enough{};
    };
    Model model(GetParam().mesh);
    try {
      model.run(options, progress);
      // Which thread does which part of a loop, and so how often this one asks, is not always
      // alike.
      EXPECT_LE(asked, last) << "goes on";
      fs::remove(options.printFile);
    } catch (const Enough&) {
      EXPECT_EQ(asked, last + 1) << "asked again";
    }
    EXPECT_EQ(entriesOf(folder), 0) << last;
    EXPECT_EQ(entriesOf("/proc/self/task"), threads) << last;
    if (run % kThese != 0) continue;
    const Result again = model.run(options);
    EXPECT_EQ(again.inner.vertices, whole.inner.vertices);
    EXPECT_EQ(again.inner.faces, whole.inner.faces);
    fs::remove(options.printFile);
  }
  setTimeBetweenQuestions(kTimeBetweenQuestions);
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, Cancelling,
    ::testing::Values(cancelled("best", blob(6), GoalKind::Stand, CavityShape::Automatic),
                      cancelled("offset", blob(6), GoalKind::Mass, CavityShape::Offset),
                      cancelled("mended", overlapping(), GoalKind::Hang, CavityShape::Automatic),
                      cancelled("top", leaningTop(0.1, 6), GoalKind::Spin, CavityShape::Automatic)),
    [](const auto& run) { return run.param.name; });

TEST(CancellingACrossingModel, IsTakenForNoDefect) {
  // Whose crossings are looked for beside the copies, when these fail or are made.
  TriangleMesh crossing = box({1, 1, 1}, 6);
  for (Eigen::Index v = 0; v < crossing.vertices.rows(); ++v) {
    if (crossing.vertices.row(v).isApprox(Eigen::RowVector3d(0.5, 0.5, 0.5)))
      crossing.vertices.row(v) << -0.8, -0.7, -0.6;
  }
  Options options;
  options.goal = GoalKind::Mass; // without a foot, for which they are looked for before
  options.cavityShape = CavityShape::Offset;
  std::vector<std::string> stages;
  const auto progress = [&](int, const char* stage) {
    stages.emplace_back(stage);
    if (stages.back() == "Coarse copies") throw std::runtime_error("enough");
  };
  EXPECT_THROW(optimizeMassProperties(crossing, options, progress), std::runtime_error);
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "Mending the model"), 0);
  EXPECT_EQ(stages.back(), "Coarse copies");
}

} // namespace
} // namespace massprops::testing
