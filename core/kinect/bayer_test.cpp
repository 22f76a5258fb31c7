#include "core/kinect/bayer.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/random.h"

namespace glovebench {
namespace {

TEST(Bayer, IsGreenRedBlueGreen) {
  ColorImage color(4, 2);
  for (int v = 0; v < 2; ++v)
    for (int u = 0; u < 4; ++u)
      color(u, v) = {static_cast<uint8_t>(100 + u), static_cast<uint8_t>(150 + u), static_cast<uint8_t>(200 + u)};
  const Image<uint8_t> mosaic = bayer_from_color(color);
  const std::vector<int> expected = {150, 101, 152, 103, 200, 151, 202, 153};
  EXPECT_EQ(std::vector<int>(mosaic.begin(), mosaic.end()), expected);
}

TEST(Bayer, MatchesHandComputedColors) {
  // g r g r
  // b g b g
  // g r g r
  // b g b g
  Image<uint8_t> mosaic(4, 4);
  for (size_t i = 0; i < mosaic.size(); ++i) mosaic[i] = static_cast<uint8_t>(10 * i);
  const ColorImage color = color_from_bayer(mosaic);
  // A green pixel in a row of blue: red above and below (10, 90), blue left and right (40, 60).
  EXPECT_EQ(color(1, 1), (Rgb{50, 50, 50}));
  // A red pixel: green of the four beside it, blue of the four corners.
  EXPECT_EQ(color(1, 2), (Rgb{90, (50 + 80 + 100 + 130 + 2) / 4, (40 + 60 + 120 + 140 + 2) / 4}));
  // The corner has one red neighbor, one blue one.
  EXPECT_EQ(color(0, 0), (Rgb{10, 0, 40}));
}

TEST(Bayer, KeepsWhatTheSensorTook) {
  Image<uint8_t> mosaic(32, 24);
  RandomStream random(1, "bayer", 0, "pixels");
  for (uint8_t& value : mosaic) value = static_cast<uint8_t>(random.index(256));
  EXPECT_EQ(bayer_from_color(color_from_bayer(mosaic)), mosaic);
}

TEST(Bayer, ReturnsAPlaneOfColor) {
  // Bilinear: exact where color changes evenly, away from the border.
  ColorImage color(40, 30);
  for (int v = 0; v < 30; ++v)
    for (int u = 0; u < 40; ++u)
      color(u, v) = {static_cast<uint8_t>(2 * u + 3 * v), static_cast<uint8_t>(200 - 4 * u),
                     static_cast<uint8_t>(50 + 5 * v)};
  const ColorImage returned = color_from_bayer(bayer_from_color(color));
  for (int v = 1; v < 29; ++v)
    for (int u = 1; u < 39; ++u) ASSERT_EQ(returned(u, v), color(u, v)) << u << ", " << v;
}

TEST(Bayer, RefusesWhatHasNoSquares) {
  EXPECT_THROW(color_from_bayer(Image<uint8_t>()), Error);
  EXPECT_THROW(color_from_bayer(Image<uint8_t>(3, 2)), Error);
  EXPECT_THROW(color_from_bayer(Image<uint8_t>(4, 5)), Error);
  EXPECT_THROW(bayer_from_color(ColorImage(5, 4)), Error);
  EXPECT_NO_THROW(color_from_bayer(Image<uint8_t>(2, 2)));
}

}  // namespace
}  // namespace glovebench
