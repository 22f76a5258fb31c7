#include "core/calibration/color_samples.h"

#include <gtest/gtest.h>

#include "core/calibration/test_glove.h"

namespace glovebench::calibration {
namespace {

TEST(ColorSamples, keep_even_pixels_and_what_lies_between_them) {
  const ColorSamples samples = test_samples({.noise_gray = 0}, 1);
  const int64_t stripes = (kTestWidth - 2 * kTestMargin) * kStripe * (kColorCount + 1);
  EXPECT_EQ(samples.frames(), 1);
  EXPECT_EQ(samples.inside_pixels(), stripes);
  // Of each stripe's rows the mixed one and its neighbors are not even, nor are its ends, where the table begins.
  const int64_t even = (kTestWidth - 2 * kTestMargin - 2) * (kStripe - 3) * (kColorCount + 1);
  EXPECT_NEAR(static_cast<double>(samples.inside().size()), static_cast<double>(even),
              0.03 * static_cast<double>(even));
  EXPECT_GT(samples.mixed().size(), 10U * 100U) << "a row for each border between stripes at least";
  for (const MixedSample& mixed : samples.mixed()) EXPECT_NE(mixed.near, mixed.other);
  EXPECT_GT(samples.beyond().size(), 100U);
  EXPECT_LT(samples.noise_gray(), 0.7) << "rounding";
}

TEST(ColorSamples, measure_the_cameras_noise) {
  for (const double noise : {1.0, 2.0, 5.0})
    EXPECT_NEAR(test_samples({.noise_gray = noise}).noise_gray(), noise, 0.15 * noise + 0.1);
  EXPECT_EQ(test_samples({.hand = false}).noise_gray(), 0);
}

TEST(ColorSamples, tell_the_volume_from_what_lies_beyond) {
  const VolumeView view = view_volume(test_frame({.missing = 4}, 0), test_calibration(), {});
  for (int v = 0; v < kTestHeight; ++v)
    for (int u = 0; u < kTestWidth; ++u)
      ASSERT_EQ(view.inside(u, v) != 0, stripe_at(u, v, {.missing = 4}) != 0) << u << ", " << v;
  const ColorSamples none = test_samples({.hand = false});
  EXPECT_TRUE(none.inside().empty());
  EXPECT_TRUE(none.mixed().empty());
  EXPECT_EQ(none.inside_pixels(), 0);
}

}  // namespace
}  // namespace glovebench::calibration
