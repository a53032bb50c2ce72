#include "core/print/print_project.h"

#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <string>

namespace massprops::testing {
namespace {

/// A box of 40 × 30 × 20 mm, far from the origin, with an off-centre cavity of 20 × 10 × 8 mm.
const Vec3 kMiddle(1000, -200, 33);
const Vec3 kCavityMiddle = kMiddle + Vec3(6, -4, 3);
constexpr double kOuterVolume = 40 * 30 * 20;
constexpr double kCavityVolume = 20 * 10 * 8;

PrintJob hollowBox() {
  PrintJob job;
  job.outer = shifted(box({40, 30, 20}, 2), kMiddle);
  job.cavity = shifted(reversed(box({20, 10, 8})), kCavityMiddle);
  job.wall = 3.0;
  return job;
}

PrintProject projectOf(const PrintJob& job, const Options& options) {
  return printProject(job, options, "box");
}

/// Of the box in model coordinates.
Vec3 centreWith(double infill) {
  const double missing = (1.0 - infill) * kCavityVolume;
  return (kOuterVolume * kMiddle - missing * kCavityMiddle) / (kOuterVolume - missing);
}

class PrintProjectWith : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Infill, PrintProjectWith, ::testing::Values(0.0, 0.1, 0.35));

TEST_P(PrintProjectWith, WeighsWhatTheWallsAndTheInfillWeigh) {
  Options options;
  options.density = 1.3;
  options.cavityInfill = GetParam();
  const PrintProject project = projectOf(hollowBox(), options);
  EXPECT_NEAR(project.mass, 1.3e-3 * (kOuterVolume - (1.0 - GetParam()) * kCavityVolume), 1e-9);
  EXPECT_NEAR((project.centerOfMass - project.pose(centreWith(GetParam()))).norm(), 0.0, 1e-9);
}

TEST(PrintProject, StandsOnThePlateWithTheBuildAxisUp) {
  // Up, and the height of the box along it.
  const std::vector<std::pair<Vec3, double>> axes = {
      {{0, 0, 1}, 20},  {{0, 0, 1}, 20},  {{0, 1, 0}, 30}, {{1, 0, 0}, 40},
      {{0, 0, -1}, 20}, {{0, -1, 0}, 30}, {{-1, 0, 0}, 40}};
  for (int i = 0; i < 7; ++i) {
    SCOPED_TRACE(i);
    Options options;
    options.buildAxis = static_cast<BuildAxis>(i);
    const PrintProject project = projectOf(hollowBox(), options);
    const auto& [up, height] = axes[static_cast<std::size_t>(i)];
    EXPECT_NEAR((project.pose.rotation * up - Vec3::UnitZ()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(project.pose.rotation.determinant(), 1.0, 1e-12);
    const Points& body = project.object.parts.front().mesh.vertices;
    EXPECT_NEAR(body.col(2).minCoeff(), 0.0, 1e-9);
    EXPECT_NEAR(body.col(2).maxCoeff(), height, 1e-9);
    EXPECT_NEAR(body.col(0).minCoeff() + body.col(0).maxCoeff(), 0.0, 1e-9);
    EXPECT_NEAR(body.col(1).minCoeff() + body.col(1).maxCoeff(), 0.0, 1e-9);
  }
}

TEST(PrintProject, IsBuiltAsItIsUsedUnlessSaidOtherwise) {
  Options options;
  options.upAxis = UpAxis::MinusX;
  const PrintProject used = projectOf(hollowBox(), options);
  options.upAxis = UpAxis::PlusZ;
  options.buildAxis = BuildAxis::MinusX;
  const PrintProject given = projectOf(hollowBox(), options);
  EXPECT_EQ(used.pose.rotation, given.pose.rotation);
  EXPECT_EQ(modelXml(used.object), modelXml(given.object));
}

TEST(PrintProject, HasTheCavityAsAModifierOnlyWhereItHasInfill) {
  Options options;
  const PrintProject hollow = projectOf(hollowBox(), options);
  ASSERT_EQ(hollow.object.parts.size(), 2U);
  EXPECT_NEAR(quadratureMoments(hollow.object.parts[0].mesh)[0], kOuterVolume - kCavityVolume,
              1e-6);
  EXPECT_EQ(hollow.object.parts[1].role, PartRole::SupportBlocker);

  options.cavityInfill = 0.1;
  const PrintProject light = projectOf(hollowBox(), options);
  ASSERT_EQ(light.object.parts.size(), 2U);
  EXPECT_NEAR(quadratureMoments(light.object.parts[0].mesh)[0], kOuterVolume, 1e-6);
  EXPECT_EQ(light.object.parts[1].role, PartRole::Modifier);
  EXPECT_NEAR(quadratureMoments(light.object.parts[1].mesh)[0], kCavityVolume, 1e-6);
  const SlicerSettings& settings = light.object.parts[1].settings;
  EXPECT_NE(std::find(settings.begin(), settings.end(),
                      std::pair<std::string, std::string>("fill_density", "10%")),
            settings.end());
}

TEST(PrintProject, BlocksSupportWhereALayerHangsOverTheCavity) {
  const PrintProject project = projectOf(hollowBox(), {});
  const Points& blocker = project.object.parts[1].mesh.vertices;
  const double top = project.pose(Vec3(kCavityMiddle + Vec3(0, 0, 4))).z();
  EXPECT_NEAR(blocker.col(2).maxCoeff(), top + project.settings.layerHeight, 1e-9);
}

TEST(PrintProject, IsOneClosedPartOfAnOpenSurfaceAndItsInside) {
  // A cup: the outside and the inside end on the same rim.
  const auto bowl = [](double radius, double depth) {
    TriangleMesh cone = revolved({{0, 0}, {10, 0}, {radius, -depth}, {0, -depth}}, 24);
    Faces kept(cone.faces.rows(), 3);
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < cone.faces.rows(); ++f) {
      bool isLid = true;
      for (const int v : cone.faces.row(f)) isLid = isLid && cone.vertices(v, 2) == 0.0;
      if (!isLid) kept.row(row++) = cone.faces.row(f);
    }
    cone.faces = kept.topRows(row);
    return cone;
  };
  PrintJob job;
  job.outer = bowl(10, 12);
  job.cavity = reversed(bowl(8, 10));
  job.isOpen = true;
  job.wall = 1.0;
  const PrintProject project = projectOf(job, {});
  ASSERT_EQ(project.object.parts.size(), 1U);
  EXPECT_TRUE(isClosedAndOriented(project.object.parts[0].mesh));
}

TEST(PrintProject, LeavesAWallRoomForItsPerimeters) {
  PrintJob job = hollowBox();
  job.wall = 0.89;
  EXPECT_EQ(projectOf(job, {}).settings.perimeters, 1);
  job.wall = 0.91;
  EXPECT_EQ(projectOf(job, {}).settings.perimeters, 2);
}

TEST(PrintProject, SaysWhereItsFirstLayerIsTooSmall) {
  PrintJob job;
  job.outer = scaled(sphere(8), 20.0);
  job.wall = 1.0;
  const PrintProject ball = projectOf(job, {});
  EXPECT_FALSE(ball.firstLayerHolds);
  Report report;
  describe(ball, report);
  EXPECT_NE(std::get<std::string>(report.at("print_note")).find("too small"), std::string::npos);
  const std::string parts = partsOfPrusaSlicer(ball.object);
  EXPECT_NE(parts.find(R"(key="brim_width" value="5")"), std::string::npos);
  EXPECT_TRUE(projectOf(hollowBox(), {}).firstLayerHolds);
}

TEST(PrintProject, SaysWhereAWallIsThinnerThanALine) {
  PrintJob job = hollowBox();
  Report report;
  describe(projectOf(job, {}), report);
  EXPECT_THROW(report.at("print_note"), std::out_of_range);
  job.wall = 0.4;
  describe(projectOf(job, {}), report);
  EXPECT_NE(std::get<std::string>(report.at("print_note")).find("0.45 mm"), std::string::npos);
}

TEST(PrintProject, NamesEachPartsTriangles) {
  Options options;
  options.cavityInfill = 0.1;
  const PrintProject project = projectOf(hollowBox(), options);
  for (const std::string& parts :
       {partsOfPrusaSlicer(project.object), partsOfBambu(project.object)}) {
    EXPECT_NE(parts.find(R"(firstid="0" lastid="47")"), std::string::npos) << parts;
    EXPECT_NE(parts.find(R"(firstid="48" lastid="59")"), std::string::npos) << parts;
  }
}

TEST(PrintProject, HasTheSameBytesWithAnotherDecimalSignAndAtAnotherTime) {
  const auto bytes = [](double seconds) {
    Report report;
    report.add("seconds_total", seconds);
    report.add("mass_after", 1.5);
    std::string all;
    for (const ArchiveEntry& file : filesOf(projectOf(hollowBox(), {}), report)) {
      all += file.name + file.content;
    }
    return all;
  };
  const std::string before = bytes(1.25);
  EXPECT_NE(before.find("mass_after = 1.5"), std::string::npos);
  EXPECT_EQ(before.find("1.25"), std::string::npos);
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8"); // where it is installed
  EXPECT_EQ(bytes(2.5), before);
  std::setlocale(LC_ALL, locale.c_str());
}

TEST(PrintProject, ShowsTheCavityInItsThumbnail) {
  const std::string with = projectOf(hollowBox(), {}).thumbnail;
  PrintJob solid = hollowBox();
  solid.cavity = {};
  const std::string without = projectOf(solid, {}).thumbnail;
  EXPECT_EQ(with.substr(1, 3), "PNG");
  EXPECT_NE(with, without);
}

} // namespace
} // namespace massprops::testing
