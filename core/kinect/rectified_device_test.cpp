#include "core/kinect/rectified_device.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

constexpr LensDistortion kBarrel = {.k1 = -0.2, .k2 = 0.05, .p1 = 0.001, .p2 = -0.002, .k3 = 0.01};

RgbdCalibration with_lenses() {
  RgbdCalibration calibration = nominal_kinect_calibration();
  calibration.ir_lens = kBarrel;
  calibration.rgb_lens = {.k1 = 0.1};
  return calibration;
}

/// What lies at (x, y) = (X / Z, Y / Z): a smooth field, different on each axis.
double field(const Eigen::Vector2d& xy) { return 120 + 90 * std::sin(7 * xy.x()) * std::cos(5 * xy.y()); }

/// A picture of the field through a lens: each pixel sees what its undistorted ray meets.
template <typename T, typename Value>
Image<T> seen_through(const PinholeCamera& camera, const LensDistortion& lens, const Value& value) {
  Image<T> image(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d seen((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      Eigen::Vector2d xy = seen;
      for (int i = 0; i < 30; ++i) xy += seen - lens.distort(xy);
      image(u, v) = value(field(xy));
    }
  }
  return image;
}

uint16_t as_disparity(double value) { return static_cast<uint16_t>(std::lround(4 * value)); }
Rgb as_color(double value) {
  const auto channel = static_cast<uint8_t>(std::lround(value));
  return {channel, static_cast<uint8_t>(255 - channel), 250};
}

/// Gives one frame.
class OneFrame : public Device {
 public:
  OneFrame(const RgbdCalibration& calibration, const DeviceFrame& frame)
      : calibration_(calibration), frame_(frame) {}
  const RgbdCalibration& calibration() const override { return calibration_; }
  std::optional<DeviceFrame> next_frame() override { return std::exchange(frame_, std::nullopt); }

 private:
  RgbdCalibration calibration_;
  std::optional<DeviceFrame> frame_;
};

TEST(LensDistortion, OfAHandComputedPoint) {
  // r^2 = 0.05: radial 1 + 0.1 * 0.05 + 0.2 * 0.0025 + 0.5 * 0.000125 = 1.0055625.
  const LensDistortion lens = {.k1 = 0.1, .k2 = 0.2, .p1 = 0.01, .p2 = 0.02, .k3 = 0.5};
  const Eigen::Vector2d at = lens.distort({0.2, 0.1});
  EXPECT_NEAR(at.x(), 0.2 * 1.0055625 + 2 * 0.01 * 0.02 + 0.02 * (0.05 + 0.08), 1e-12);
  EXPECT_NEAR(at.y(), 0.1 * 1.0055625 + 0.01 * (0.05 + 0.02) + 2 * 0.02 * 0.02, 1e-12);
  EXPECT_TRUE(LensDistortion().is_none());
  EXPECT_FALSE(lens.is_none());
}

TEST(RectifiedDevice, GivesWhatAPinholeWouldSee) {
  const RgbdCalibration calibration = with_lenses();
  const RgbdCalibration pinhole = calibration.rectified();
  const DeviceFrame distorted = {
      .raw_disparity = seen_through<uint16_t>(calibration.ir, calibration.ir_lens, as_disparity),
      .color = seen_through<Rgb>(calibration.rgb, calibration.rgb_lens, as_color),
      .depth_timestamp_us = 5,
      .color_timestamp_us = 7};
  RectifiedDevice device(std::make_unique<OneFrame>(calibration, distorted));
  EXPECT_FALSE(device.calibration().has_lens());
  EXPECT_EQ(device.calibration().ir, calibration.ir);
  const std::optional<DeviceFrame> frame = device.next_frame();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->depth_timestamp_us, 5);
  EXPECT_EQ(frame->color_timestamp_us, 7);
  EXPECT_FALSE(device.next_frame());

  const auto disparity = seen_through<uint16_t>(pinhole.ir, {}, as_disparity);
  const auto color = seen_through<Rgb>(pinhole.rgb, {}, as_color);
  // The field's slope is up to 630 a unit of x, 1.1 a pixel of 576; four times that in disparity. The nearest pixel
  // is up to half a diagonal away, and both pictures are rounded.
  int compared = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (frame->raw_disparity(u, v) != kNoDisparity) {
        ++compared;
        ASSERT_NEAR(frame->raw_disparity(u, v), disparity(u, v), 5) << u << ", " << v;
      }
      const Rgb& rgb = frame->color(u, v);
      if (rgb[2] == 250) {
        ASSERT_NEAR(rgb[0], color(u, v)[0], 2) << u << ", " << v;
      }
    }
  }
  EXPECT_GT(compared, 640 * 480 * 95 / 100);
  EXPECT_NE(distorted.raw_disparity, disparity) << "the lens does something";
}

TEST(RectifiedDevice, NeverMixesDisparities) {
  RgbdCalibration calibration = with_lenses();
  Image<uint16_t> edge(640, 480, 400);
  for (int v = 0; v < 480; ++v) std::fill_n(&edge(320, v), 320, uint16_t{kNoDisparity});
  const Rectification rectify(calibration.ir, calibration.ir_lens);
  for (const uint16_t raw : rectify(edge)) ASSERT_TRUE(raw == 400 || raw == kNoDisparity) << raw;
}

TEST(RectifiedDevice, MovesDepthAsItMovesDisparity) {
  DeviceFrame frame = {.raw_disparity = seen_through<uint16_t>(with_lenses().ir, kBarrel, as_disparity),
                       .color = ColorImage(640, 480)};
  const auto rectified = [](const DeviceFrame& distorted) {
    return *RectifiedDevice(std::make_unique<OneFrame>(with_lenses(), distorted)).next_frame();
  };
  const DepthImage expected = depth_from_disparity(rectified(frame).raw_disparity);
  frame.depth = depth_of(frame, {});
  frame.raw_disparity = {};
  EXPECT_EQ(rectified(frame).depth, expected);
}

TEST(RectifiedDevice, IsTheDeviceItselfWhereThereIsNoLens) {
  auto device = std::make_unique<OneFrame>(nominal_kinect_calibration(), DeviceFrame{});
  const Device* before = device.get();
  EXPECT_EQ(without_lens_distortion(std::move(device)).get(), before);
}

TEST(RectifiedDevice, RefusesALensThatFoldsTheImage) {
  RgbdCalibration calibration = with_lenses();
  calibration.ir_lens.k1 = -3;
  EXPECT_THAT(thrown_by([&] { RectifiedDevice(std::make_unique<OneFrame>(calibration, DeviceFrame{})); }),
              testing::HasSubstr("distortion: found an image that folds over"));
}

TEST(RectifiedDevice, ExtremeLensesDoNoHarm) {
  for (const double k : {1e-300, 1e3, 1e300, -1e300}) {
    try {
      const PinholeCamera camera = nominal_kinect_calibration().ir;
      const Rectification rectify(camera, {.k1 = k});
      rectify(Image<uint16_t>(640, 480));
    } catch (const Error&) {
      // Also fine.
    }
  }
}

}  // namespace
}  // namespace glovebench
