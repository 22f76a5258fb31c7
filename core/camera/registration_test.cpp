#include "core/camera/registration.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

/// A color image whose colors tell their pixel.
ColorImage coordinate_image(int width, int height) {
  ColorImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image(u, v) = {static_cast<uint8_t>(u & 255), static_cast<uint8_t>(v & 255),
                     static_cast<uint8_t>(u >> 8 | v >> 8 << 4)};
  return image;
}
int u_of(const Rgb& color) { return color[0] | (color[2] & 15) << 8; }
int v_of(const Rgb& color) { return color[1] | (color[2] >> 4) << 8; }

/// Two equal, parallel cameras of f 500 px, the RGB camera 24 mm to the right: pixels move left by 12 m px / z.
/// The principal points differ by a third of a pixel, so that no correspondence lies on a pixel border.
RgbdCalibration parallel_cameras() {
  RgbdCalibration calibration;
  calibration.ir = {.fx = 500, .fy = 500, .cx = 320, .cy = 240};
  calibration.rgb = {.fx = 500, .fy = 500, .cx = 320.3, .cy = 240.3};
  calibration.T_rgb_ir.translation().x() = -0.024;
  return calibration;
}

/// A plane at 1 m with a square at 0.5 m in columns 300..399 and rows 200..299.
DepthImage square_before_plane() {
  DepthImage depth(640, 480, 1.0f);
  for (int v = 200; v < 300; ++v)
    for (int u = 300; u < 400; ++u) depth(u, v) = 0.5f;
  return depth;
}

TEST(Registration, FindsHandComputedCorrespondences) {
  const RegisteredImage mapped =
      register_color(square_before_plane(), coordinate_image(640, 480), parallel_cameras(), {});
  ASSERT_TRUE(mapped.has_color(350, 250));
  EXPECT_EQ(u_of(mapped.color(350, 250)), 350 - 24);
  EXPECT_EQ(v_of(mapped.color(350, 250)), 250);
  ASSERT_TRUE(mapped.has_color(100, 50));
  EXPECT_EQ(u_of(mapped.color(100, 50)), 100 - 12);
  EXPECT_EQ(v_of(mapped.color(100, 50)), 50);
}

TEST(Registration, LeavesTheShadowedStripWithoutColor) {
  const RegisteredImage mapped =
      register_color(square_before_plane(), coordinate_image(640, 480), parallel_cameras(), {});
  // The square covers RGB columns 276..375, the plane at its left reaches them from column 288 on: 12 columns.
  // A sample stands for all within a pixel of it, so the strip may be a pixel wider at each of its ends.
  for (int v = 202; v < 298; ++v) {
    for (int u = 288; u < 300; ++u) ASSERT_FALSE(mapped.has_color(u, v)) << u << ", " << v;
    ASSERT_TRUE(mapped.has_color(286, v)) << v;
    ASSERT_TRUE(mapped.has_color(300, v)) << v;
    ASSERT_TRUE(mapped.has_color(401, v)) << v;  // the RGB camera sees more of the plane at the right
  }
  // Away from the square only the columns that leave the RGB image at the left have no color.
  for (int v : {0, 198, 302, 479})
    for (int u = 0; u < 640; ++u) ASSERT_EQ(mapped.has_color(u, v), u >= 12) << u << ", " << v;
}

TEST(Registration, ToleranceDecidesWhatIsHidden) {
  DepthImage depth(640, 480, 0.51f);
  for (int v = 200; v < 300; ++v)
    for (int u = 300; u < 400; ++u) depth(u, v) = 0.5f;
  // The step of 10 mm moves pixels by 0.47: the column left of the square falls on the square's first column.
  const ColorImage color = coordinate_image(640, 480);
  EXPECT_TRUE(register_color(depth, color, parallel_cameras(), {.occlusion_tolerance = 0.011}).has_color(299, 250));
  EXPECT_FALSE(
      register_color(depth, color, parallel_cameras(), {.occlusion_tolerance = 0.009}).has_color(299, 250));
}

TEST(Registration, AgreesWithProjectionForTheSyntheticCalibration) {
  const RgbdCalibration calibration = synthetic_calibration();
  // A smooth slanted surface: nothing is hidden, every pixel can be checked on its own.
  DepthImage depth(640, 480);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u)
      depth(u, v) = 0.6f + 0.0003f * static_cast<float>(u) + 0.0002f * static_cast<float>(v);
  const RegisteredImage mapped = register_color(depth, coordinate_image(640, 480), calibration, {});
  int compared = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector2d uv_px =
          calibration.rgb.project(calibration.T_rgb_ir * calibration.ir.back_project(u, v, depth(u, v)));
      const bool inside = uv_px.x() > -0.49 && uv_px.y() > -0.49 && uv_px.x() < 639.49 && uv_px.y() < 479.49;
      if (!inside) continue;
      ASSERT_TRUE(mapped.has_color(u, v)) << u << ", " << v;
      // Nearest pixel: at most half a pixel off, plus the rounding of single precision.
      ASSERT_NEAR(u_of(mapped.color(u, v)), uv_px.x(), 0.501);
      ASSERT_NEAR(v_of(mapped.color(u, v)), uv_px.y(), 0.501);
      ++compared;
    }
  EXPECT_GT(compared, 250000);
}

TEST(Registration, FootprintClosesTheGapsOfAMagnifyingCamera) {
  // The RGB camera magnifies 2.5 times: samples of the near square lie 2.5 px apart, and none of the far plane
  // may be seen between them.
  RgbdCalibration calibration = parallel_cameras();
  calibration.rgb = {.width = 1600, .height = 1200, .fx = 1250, .fy = 1250, .cx = 800.3, .cy = 600.3};
  const RegisteredImage mapped =
      register_color(square_before_plane(), coordinate_image(1600, 1200), calibration, {});
  for (int v = 203; v < 297; ++v)
    for (int u = 288; u < 300; ++u) ASSERT_FALSE(mapped.has_color(u, v)) << u << ", " << v;
  EXPECT_TRUE(mapped.has_color(285, 250));
}

TEST(Registration, what_lies_far_away_in_the_image_changes_nothing) {
  // Wherever the samples are, only a part of the images is looked at: with samples in all corners it is the whole.
  RandomStream random(1, "registration", 0, "blobs");
  for (int i = 0; i < 20; ++i) {
    const int left = static_cast<int>(random.index(600)), top = static_cast<int>(random.index(440));
    DepthImage depth(640, 480);
    for (int v = top; v < std::min(480, top + 80); ++v)
      for (int u = left; u < std::min(640, left + 80); ++u)
        if (random.index(4) != 0) depth(u, v) = static_cast<float>(random.uniform(0.4, 0.9));
    DepthImage whole = depth;
    for (const int v : {0, 479})
      for (const int u : {0, 639}) whole(u, v) = 9;
    whole(320, 0) = std::numeric_limits<float>::infinity();
    const ColorImage color = coordinate_image(640, 480);
    const RegisteredImage part = register_color(depth, color, synthetic_calibration(), {}),
                          all = register_color(whole, color, synthetic_calibration(), {});
    int compared = 0;
    for (size_t pixel = 0; pixel < depth.size(); ++pixel) {
      if (depth[pixel] == 0) continue;
      ASSERT_EQ(part.has_color[pixel], all.has_color[pixel]);
      ASSERT_EQ(part.color[pixel], all.color[pixel]);
      compared += part.has_color[pixel];
    }
    const bool inside = left > 40 && left < 520 && top > 40 && top < 360;
    EXPECT_GT(compared, inside ? 1000 : -1);
  }
}

TEST(Registration, IgnoresPixelsWithoutDepth) {
  DepthImage depth(640, 480);
  depth(5, 5) = -1.0f;
  depth(6, 5) = std::numeric_limits<float>::quiet_NaN();
  depth(7, 5) = std::numeric_limits<float>::infinity();
  const RegisteredImage mapped = register_color(depth, coordinate_image(640, 480), synthetic_calibration(), {});
  EXPECT_TRUE(std::all_of(mapped.has_color.begin(), mapped.has_color.end(), [](uint8_t has) { return has == 0; }));
}

}  // namespace
}  // namespace glovebench
