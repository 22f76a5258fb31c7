#include "reports/metrics/coverage.h"

#include <gtest/gtest.h>

#include "reports/example_result.h"

namespace glovebench::reports {
namespace {

FrameRecord coverage_frame(double position_mm, double rotation_deg, double fingertips_mm, double visible_percent) {
  FrameRecord frame = example_frame(0, position_mm, 3, rotation_deg);
  frame["fingertip_error_mm"] = fingertips_mm;
  frame["visible_percent"] = visible_percent;
  return frame;
}

TEST(CoverageLevels, UsableEndsAt10MillimetersAnd10DegreesAndFingertipsAt20Millimeters) {
  EXPECT_EQ(is_usable(coverage_frame(9.99, 9.99, 19.99, 100)), true);
  EXPECT_EQ(is_usable(coverage_frame(10, 0, 0, 100)), false);
  EXPECT_EQ(is_usable(coverage_frame(0, 10, 0, 100)), false);
  EXPECT_EQ(is_usable(coverage_frame(0, 0, 20, 100)), false);
  EXPECT_EQ(is_usable(example_lost_frame(0)), false);
}

TEST(CoverageLevels, VisibleBeginsAt30Percent) {
  EXPECT_TRUE(is_visible(coverage_frame(0, 0, 0, 30)));
  EXPECT_FALSE(is_visible(coverage_frame(0, 0, 0, 29.9)));
  EXPECT_FALSE(is_visible(FrameRecord())) << "an older result does not say";
}

TEST(CoverageLevels, FilesThatRoundCountTheSame) {
  FrameRecord nearly = coverage_frame(9.9999999, 0, 0, 29.9999999), written = coverage_frame(10, 0, 0, 30);
  EXPECT_EQ(is_usable(nearly), is_usable(written));
  EXPECT_EQ(is_visible(nearly), is_visible(written));
}

TEST(CoverageLevels, AreSharesOfTheVisibleFrames) {
  const std::vector<SeedRun> runs = {{1,
                                      {coverage_frame(3, 3, 3, 100),    // usable
                                       coverage_frame(20, 3, 15, 80),   // found
                                       coverage_frame(3, 3, 25, 80),    // found: its fingertips are off
                                       coverage_frame(60, 3, 65, 30),   // far off
                                       example_lost_frame(4),           // visible, lost
                                       coverage_frame(3, 3, 3, 10)}}};  // usable, but hardly to be seen
  const Coverage coverage = count_coverage(runs);
  EXPECT_EQ(coverage, (Coverage{6, 4, 1, 1, 1, 5, 3, 1}));
  EXPECT_DOUBLE_EQ(*coverage.found_share(), 3 / 5.0);
  EXPECT_DOUBLE_EQ(*coverage.usable_share(), 1 / 5.0);
  EXPECT_DOUBLE_EQ(*coverage.share(), 4 / 6.0) << "of all frames, as ever";
  double unusable = 0;
  int frames = 0;
  for (const FrameRecord& frame : runs[0].frames)
    if (const auto value = value_of(metric_of("unusable_percent"), frame)) unusable += *value, ++frames;
  EXPECT_EQ(frames, 5);
  EXPECT_DOUBLE_EQ(unusable, 400);
}

TEST(CoverageLevels, NoVisibleFrameIsNotAShareOf0) {
  const Coverage coverage = count_coverage({{1, {coverage_frame(3, 3, 3, 0)}}});
  EXPECT_FALSE(coverage.found_share() || coverage.usable_share());
}

/// A camera of 100 by 100 pixels and a color camera 0.1 m to its right, both with f = 100: at z = 0.5 m the first
/// one sees x from -0.2525 to 0.2475 m, the second one from -0.1525 to 0.3475 m.
RgbdCalibration small_cameras() {
  RgbdCalibration calibration;
  calibration.ir = calibration.rgb = {100, 100, 100, 100, 50, 50};
  calibration.T_rgb_ir = Eigen::Translation3d(-0.1, 0, 0);
  return calibration;
}

/// A hand of right triangles with legs of 1 cm times `size` that face the camera or turn away from it.
class Facets {
 public:
  void add(const Eigen::Vector3f& centroid, float size = 1, bool faces = true) {
    const auto first = static_cast<uint32_t>(hand_.vertices.size());
    const float leg = 0.01F * size;
    const Eigen::Vector3f corner = centroid - Eigen::Vector3f(leg / 3, leg / 3, 0);
    hand_.vertices.push_back(corner);
    hand_.vertices.push_back(corner + Eigen::Vector3f(leg, 0, 0));
    hand_.vertices.push_back(corner + Eigen::Vector3f(0, leg, 0));
    // x right, y down: this order turns its outside to +z, away from the camera.
    triangles_.push_back({{first, first + 1, first + 2}, 1, 0});
    if (faces) std::swap(triangles_.back().vertices[1], triangles_.back().vertices[2]);
  }
  double percent(const Eigen::Isometry3d& T_camera_hand = Eigen::Isometry3d::Identity()) const {
    return visible_percent(hand_, triangles_, T_camera_hand, small_cameras());
  }

 private:
  PosedHand hand_;
  std::vector<Triangle> triangles_;
};

TEST(VisiblePercent, IsTheShareOfTheAreaThatFacesTheCamera) {
  Facets facets;
  EXPECT_EQ(facets.percent(), 0) << "nothing faces the camera";
  facets.add({0, 0, 0.5F});
  facets.add({0, 0, 0.6F}, 5, false);
  EXPECT_NEAR(facets.percent(), 100, 1e-4) << "what turns away does not count";
  facets.add({0.4F, 0, 0.5F}, 2);  // out of the image, four times the area
  EXPECT_NEAR(facets.percent(), 20, 1e-4);
}

TEST(VisiblePercent, BothImagesMustHoldIt) {
  const auto percent_at = [](float x, float y) {
    Facets facets;
    facets.add({x, y, 0.5F});
    return facets.percent();
  };
  EXPECT_EQ(percent_at(0.245F, 0), 100);
  EXPECT_EQ(percent_at(0.25F, 0), 0) << "right of the depth image";
  EXPECT_EQ(percent_at(-0.15F, 0), 100);
  EXPECT_EQ(percent_at(-0.155F, 0), 0) << "left of the color image";
  EXPECT_EQ(percent_at(0, -0.25F), 100);
  EXPECT_EQ(percent_at(0, -0.255F), 0);
  EXPECT_EQ(percent_at(0, 0.25F), 0);
}

TEST(VisiblePercent, TheVolumeMustHoldIt) {
  Facets facets;
  facets.add({0, 0, 0});
  const auto percent_at = [&](double z) {
    return facets.percent(Eigen::Isometry3d(Eigen::Translation3d(0, 0, z)));
  };
  EXPECT_EQ(percent_at(0.399), 0);
  EXPECT_EQ(percent_at(0.401), 100);
  EXPECT_EQ(percent_at(0.949), 100);
  EXPECT_EQ(percent_at(0.951), 0);
  EXPECT_EQ(percent_at(-0.5), 0) << "behind the camera, whose triangles then turn away";
}

}  // namespace
}  // namespace glovebench::reports
