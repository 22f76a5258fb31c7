#include "render/synthetic_kinect.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "render/test_hand.h"

namespace glovebench::render {
namespace {

std::shared_ptr<const HandModel> hand_of_the_device() {
  return {&test_hand(), [](const HandModel*) {}};
}

std::vector<HandFrame> three_frames() {
  std::vector<HandFrame> frames(3);
  for (int i = 0; i < 3; ++i)
    frames[i] = {66'667 * i, test_posture() * (0.3 * i), test_pose({0.02 * i, 0.03, 0.7})};
  return frames;
}

std::vector<DeviceFrame> all_frames(Device& device) {
  std::vector<DeviceFrame> frames;
  while (std::optional<DeviceFrame> frame = device.next_frame()) frames.push_back(std::move(*frame));
  return frames;
}

TEST(SyntheticKinect, DepthComesBackThroughElevenBits) {
  SyntheticKinectConfig config;
  config.noise.depth = "none";
  config.noise.color_sigma_gray = 0;
  SyntheticKinect kinect(synthetic_calibration(), hand_of_the_device(), three_frames(), config);
  const DeviceFrame frame = *kinect.next_frame();
  const DepthImage depth = depth_from_disparity(frame.raw_disparity);
  const DepthImage& truth = kinect.truth().depth;
  for (size_t i = 0; i < depth.size(); ++i) {
    // Half a step of z^2 / 345.489 m, and a little for the steps' growth with z.
    ASSERT_NEAR(depth[i], truth[i], 0.505 * truth[i] * truth[i] / 345.489);
  }
  EXPECT_EQ(frame.color, kinect.truth().color);
}

TEST(SyntheticKinect, GivesEachFrameOnceWithItsTime) {
  SyntheticKinect kinect(synthetic_calibration(), hand_of_the_device(), three_frames(), {});
  const std::vector<DeviceFrame> frames = all_frames(kinect);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[2].depth_timestamp_us, 133'334);
  EXPECT_EQ(frames[2].color_timestamp_us, 133'334);
  EXPECT_NE(frames[0].color, frames[1].color);
  EXPECT_FALSE(kinect.next_frame().has_value());
}

TEST(SyntheticKinect, SameSeedSameFrames) {
  const auto frames_of = [](uint64_t seed) {
    SyntheticKinectConfig config;
    config.seed = seed;
    SyntheticKinect kinect(synthetic_calibration(), hand_of_the_device(), three_frames(), config);
    return all_frames(kinect);
  };
  const std::vector<DeviceFrame> first = frames_of(1);
  const std::vector<DeviceFrame> again = frames_of(1);
  const std::vector<DeviceFrame> other = frames_of(2);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(first[i].raw_disparity, again[i].raw_disparity);
    EXPECT_EQ(first[i].color, again[i].color);
    EXPECT_NE(first[i].raw_disparity, other[i].raw_disparity);
    EXPECT_NE(first[i].color, other[i].color);
  }
}

TEST(SyntheticKinect, RefusesImpossibleConfigurations) {
  SyntheticKinectConfig config;
  config.noise.gain_factor = -1;
  EXPECT_THROW(SyntheticKinect(synthetic_calibration(), hand_of_the_device(), three_frames(), config), Error);
  config = {};
  config.lighting.temperature_k = 0;
  EXPECT_THROW(SyntheticKinect(synthetic_calibration(), hand_of_the_device(), three_frames(), config).next_frame(),
               Error);
}

}  // namespace
}  // namespace glovebench::render
