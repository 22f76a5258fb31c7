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

TEST(Disparity, LeavesOutWhatIsTooFar) {
  Image<uint16_t> raw(3, 1, kNoDisparity);
  raw(1, 0) = 398;
  raw(2, 0) = 744;
  const DepthImage depth = depth_from_disparity(raw, 0.9);
  EXPECT_EQ(depth(0, 0), 0.0f);
  EXPECT_EQ(depth(1, 0), depth_from_disparity(398));
  EXPECT_EQ(depth(2, 0), 0.0f) << "at 1 m";
  EXPECT_EQ(depth_from_disparity(raw, 1.1), depth_from_disparity(raw));
}

}  // namespace
}  // namespace glovebench
