// Every two wishes that touch each other: they work together, or are refused with a sentence.
#include "core/base/option_pairs.h"
#include "core/pipeline.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

std::string projectFile() {
  return (std::filesystem::temp_directory_path() / "massprops_pairs.3mf").u8string();
}

/// A leaning box, and the same without its top.
TriangleMesh pillar(bool isOpen) {
  TriangleMesh mesh = transformed(box({10, 10, 16}, 8), shear(0.1));
  if (!isOpen) return mesh;
  Faces kept(mesh.faces.rows(), 3);
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    bool isTop = true;
    for (const int v : mesh.faces.row(f)) isTop = isTop && mesh.vertices(v, 2) > 7.999;
    if (!isTop) kept.row(row++) = mesh.faces.row(f);
  }
  mesh.faces = kept.topRows(row);
  return mesh;
}

struct Wish {
  std::string name; ///< its words stand in the sentence that refuses it
  std::function<void(Options&)> ask;
  bool opens = false;
};

const std::vector<Wish>& wishes() {
  static const std::vector<Wish> all = {
      {"surface", [](Options& o) { o.openSurface = true; }, true},
      {"outer_upper_bound", [](Options& o) { o.outerUpperBound = 0.5; }},
      {"best possible cavity", [](Options& o) { o.cavityShape = CavityShape::BestPossible; }},
      {"fill_density", [](Options& o) { o.fillDensity = 0.3; }},
      {"Stand empty and filled",
       [](Options& o) {
         o.goal = GoalKind::StandEmptyAndFilled;
         o.fillDensity = 0.3;
       }},
      {"cavity_infill", [](Options& o) { o.cavityInfill = 0.1; }},
      {"keep_selected_solid",
       [](Options& o) {
         const TriangleMesh model = pillar(false);
         o.keptSolid = {model.vertices, model.faces.topRows(8)};
       }},
      {"foot",
       [](Options& o) {
         o.foot = FootCut::Given;
         o.footDepth = 0.5;
       }},
      {"mend", [](Options& o) { o.mend = true; }},
      {"print_file", [](Options& o) { o.printFile = projectFile(); }},
      {"drain_holes",
       [](Options& o) {
         o.drainHoles = 1;
         o.drainDiameter = 2.0;
       }},
      {"cavity_shape", [](Options& o) { o.cavityShape = CavityShape::Offset; }},
      {"overhang_angle", [](Options& o) { o.overhangAngle = 45.0; }},
  };
  return all;
}

/// By the places in the list.
const std::vector<std::pair<std::string, std::string>>& refused() {
  static const std::vector<std::pair<std::string, std::string>> pairs = {
      {"surface", "outer_upper_bound"},
      {"surface", "best possible cavity"},
      {"surface", "cavity_infill"},
      {"outer_upper_bound", "keep_selected_solid"},
      {"fill_density", "cavity_infill"},
      {"Stand empty and filled", "cavity_infill"},
      {"surface", "drain_holes"},
      {"Stand empty and filled", "drain_holes"},
      {"fill_density", "drain_holes"},
      {"cavity_infill", "drain_holes"},
      {"print_file", "drain_holes"},
      {"surface", "overhang_angle"},
      {"outer_upper_bound", "overhang_angle"},
      {"cavity_infill", "overhang_angle"},
      {"outer_upper_bound", "best possible cavity"},
      {"cavity_shape", "overhang_angle"},
  };
  return pairs;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

TEST(OptionPairs, WorkOrAreRefusedWithASentence) {
  LARGE_TEST();
  for (std::size_t i = 0; i < wishes().size(); ++i) {
    for (std::size_t j = i + 1; j < wishes().size(); ++j) {
      const Wish& a = wishes()[i];
      const Wish& b = wishes()[j];
      SCOPED_TRACE(a.name + " and " + b.name);
      Options options;
      options.mend = false;
      options.innerLowerBound = 1.0;
      options.basisSize = 9;
      a.ask(options);
      b.ask(options);
      std::string refusal;
      try {
        const Result result = optimizeMassProperties(pillar(a.opens || b.opens), options);
        EXPECT_GT(result.inner.faces.rows(), 0);
      } catch (const InvalidInput& e) {
        refusal = e.what();
      }
      const bool isRefused = std::find(refused().begin(), refused().end(),
                                       std::pair(a.name, b.name)) != refused().end();
      EXPECT_EQ(refusal.empty(), !isRefused) << refusal;
      if (!isRefused) continue;
      EXPECT_NE(lower(refusal).find(lower(a.name)), std::string::npos) << refusal;
      EXPECT_NE(lower(refusal).find(lower(b.name)), std::string::npos) << refusal;
      EXPECT_NE(refusal.find(": set "), std::string::npos) << refusal;
    }
  }
  std::filesystem::remove(projectFile());
}

TEST(OptionPairs, EachRefusalIsForAPairOfItsOwn) {
  EXPECT_EQ(refusedPairs().size(), refused().size());
}

} // namespace
} // namespace massprops::testing
