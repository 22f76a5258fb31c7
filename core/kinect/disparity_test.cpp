#include "core/kinect/disparity.h"

#include <gtest/gtest.h>

#include <limits>

namespace glovebench {
namespace {

TEST(Disparity, MatchesHandComputedDepths) {
  // 345489 / (1089.41 - raw), in mm; to the 0.005 mm to which these are written.
  EXPECT_NEAR(depth_from_disparity(0) * 1000, 317.134, 0.005);
  EXPECT_NEAR(depth_from_disparity(398) * 1000, 499.688, 0.005);
  EXPECT_NEAR(depth_from_disparity(744) * 1000, 1000.229, 0.005);
  EXPECT_NEAR(depth_from_disparity(859) * 1000, 1499.453, 0.005);
}

TEST(Disparity, HasNoDepthBeyondItsRange) {
  EXPECT_GT(depth_from_disparity(kMaxDisparity), 50.0f);
  EXPECT_EQ(depth_from_disparity(kMaxDisparity + 1), 0.0f);
  EXPECT_EQ(depth_from_disparity(kNoDisparity), 0.0f);
  EXPECT_EQ(depth_from_disparity(uint16_t{65535}), 0.0f);
}

TEST(Disparity, EveryStepReturns) {
  for (uint16_t raw = 0; raw <= kMaxDisparity; ++raw)
    ASSERT_EQ(disparity_from_depth(depth_from_disparity(raw)), raw);
}

TEST(Disparity, DepthReturnsWithinHalfAStep) {
  for (double z = 0.3175; z < 10.0; z += 0.0007) {
    const uint16_t raw = disparity_from_depth(z);
    ASSERT_LE(raw, kMaxDisparity) << z;
    // A step is z^2 / 345.489; its curvature and the float's rounding add less than 2% here.
    ASSERT_NEAR(depth_from_disparity(raw), z, 0.51 * z * z / 345.489 * 1.02) << z;
  }
}

TEST(Disparity, RefusesWhatHasNoStep) {
  EXPECT_EQ(disparity_from_depth(0), kNoDisparity);
  EXPECT_EQ(disparity_from_depth(-1), kNoDisparity);
  EXPECT_EQ(disparity_from_depth(0.31), kNoDisparity);  // nearer than raw 0
  EXPECT_EQ(disparity_from_depth(100), kNoDisparity);
  EXPECT_EQ(disparity_from_depth(std::numeric_limits<double>::infinity()), kNoDisparity);
  EXPECT_EQ(disparity_from_depth(std::numeric_limits<double>::quiet_NaN()), kNoDisparity);
}

TEST(Disparity, ConvertsImagesPixelByPixel) {
  Image<uint16_t> raw(3, 2, kNoDisparity);
  raw(2, 1) = 744;
  const DepthImage depth = depth_from_disparity(raw);
  EXPECT_EQ(depth(0, 0), 0.0f);
  EXPECT_EQ(depth(2, 1), depth_from_disparity(744));
}

TEST(Disparity, DepthOfAFrameIsWhatTheDeviceMeasured) {
  DeviceFrame frame;
  frame.depth = DepthImage(3, 1);
  frame.depth(1, 0) = 0.5f;
  frame.depth(2, 0) = 0.95f;
  EXPECT_EQ(depth_of(frame, DisparityLine{-0.003, 3.3}), frame.depth);
  EXPECT_EQ(depth_of(frame, {}, 0.9)(1, 0), 0.5f);
  EXPECT_EQ(depth_of(frame, {}, 0.9)(2, 0), 0.0f);
  const DeviceFrame of_disparity = {Image<uint16_t>(3, 1, 744)};
  EXPECT_EQ(depth_of(of_disparity, {}), depth_from_disparity(of_disparity.raw_disparity));
}

TEST(Disparity, LeavesOutWhatIsTooFar) {
  Image<uint16_t> raw(3, 1, kNoDisparity);
  raw(1, 0) = 398;
  raw(2, 0) = 744;
  const DepthImage depth = depth_from_disparity(raw, std::nullopt, 0.9);
  EXPECT_EQ(depth(0, 0), 0.0f);
  EXPECT_EQ(depth(1, 0), depth_from_disparity(398));
  EXPECT_EQ(depth(2, 0), 0.0f) << "at 1 m";
  EXPECT_EQ(depth_from_disparity(raw, std::nullopt, 1.1), depth_from_disparity(raw));
}

/// The driver's formula, as a line.
DisparityLine line_of_the_driver() { return {-1 / 345.489, 1089.41 / 345.489}; }

TEST(DisparityLine, OfTheDriverIsTheFormula) {
  for (int raw = 0; raw <= 65535; ++raw) {
    const auto step = static_cast<uint16_t>(raw);
    ASSERT_NEAR(depth_from_disparity(step, line_of_the_driver()), depth_from_disparity(step),
                1e-6 * depth_from_disparity(step))
        << raw;
  }
  for (double z : {0.1, 0.3175, 0.7, 5.0, 50.0, 100.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(disparity_from_depth(z, line_of_the_driver()), disparity_from_depth(z)) << z;
}

TEST(DisparityLine, MatchesHandComputedDepths) {
  const DisparityLine line{-0.003, 3.3};
  EXPECT_NEAR(depth_from_disparity(600, line), 1 / 1.5, 1e-6);
  EXPECT_EQ(disparity_from_depth(1 / 1.5, line), 600);
  EXPECT_EQ(depth_from_disparity(1100, line), 0.0f) << "at infinity";
  EXPECT_EQ(depth_from_disparity(1500, line), 0.0f) << "behind the camera";
}

TEST(DisparityLine, HasNoDepthWhereTheDeviceHasNoValue) {
  const DisparityLine wide{-0.0001, 3.3};
  EXPECT_GT(depth_from_disparity(2046, wide), 0.3f);
  EXPECT_EQ(depth_from_disparity(kNoDisparity, wide), 0.0f);
  EXPECT_EQ(depth_from_disparity(uint16_t{2048}, wide), 0.0f);
  EXPECT_EQ(disparity_from_depth(1 / (3.3 - 0.2047), wide), kNoDisparity);
  EXPECT_EQ(disparity_from_depth(0.29, wide), kNoDisparity) << "nearer than raw 0";
}

TEST(DisparityLine, ConvertsImagesPixelByPixel) {
  Image<uint16_t> raw(2048 + 1, 1);
  for (size_t i = 0; i < raw.size(); ++i) raw[i] = static_cast<uint16_t>(i);
  const DisparityLine line{-0.003, 3.3};
  const DepthImage depth = depth_from_disparity(raw, line), near = depth_from_disparity(raw, line, 1.0);
  for (size_t i = 0; i < raw.size(); ++i) {
    ASSERT_EQ(depth[i], depth_from_disparity(raw[i], line));
    ASSERT_EQ(near[i], depth[i] > 1 ? 0.0f : depth[i]);
  }
}

}  // namespace
}  // namespace glovebench
