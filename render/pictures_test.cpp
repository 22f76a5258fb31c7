#include "render/pictures.h"

#include <gtest/gtest.h>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/test_folder.h"

namespace glovebench::render {
namespace {

TEST(Pictures, OutlineRunsAlongBorders) {
  LabelImage labels(8, 6);
  for (int v = 2; v < 4; ++v)
    for (int u = 3; u < 6; ++u) labels(u, v) = 4;
  const ColorImage picture = overlay_outline(ColorImage(8, 6, Rgb{10, 20, 30}), labels);
  const Rgb white{255, 255, 255};
  EXPECT_EQ(picture(2, 2), white);
  EXPECT_EQ(picture(5, 3), white);
  EXPECT_EQ(picture(4, 1), white);
  EXPECT_EQ(picture(4, 2), (Rgb{0, 0, 0})) << "an edge, for light backgrounds";
  EXPECT_EQ(picture(0, 0), (Rgb{10, 20, 30}));
}

TEST(Pictures, DepthWithoutValueIsBlackAndNearDiffersFromFar) {
  DepthImage depth(3, 1);
  depth(1, 0) = 0.5f;
  depth(2, 0) = 1.0f;
  const ColorImage picture = picture_of_depth(depth, 0.5, 1.0);
  EXPECT_EQ(picture(0, 0), (Rgb{0, 0, 0}));
  EXPECT_GT(picture(1, 0)[0], picture(1, 0)[2]);  // near is red
  EXPECT_LT(picture(2, 0)[0], picture(2, 0)[2]);  // far is blue
}

TEST(Pictures, DepthDifferenceTellsNearerFartherAndMissingApart) {
  DepthImage depth(6, 1), other(6, 1);
  for (const int u : {0, 1, 2, 3}) depth(u, 0) = 0.7f;
  other(0, 0) = 0.7f;   // equal
  other(1, 0) = 0.65f;  // nearer by more than the range
  other(2, 0) = 0.71f;  // farther by half of it
  other(4, 0) = 0.7f;   // only this one
  const ColorImage picture = picture_of_depth_difference(depth, other, 0.02);
  EXPECT_EQ(picture(0, 0), (Rgb{247, 247, 247}));
  EXPECT_EQ(picture(1, 0), (Rgb{33, 102, 172}));
  EXPECT_EQ(picture(2, 0), (Rgb{213, 168, 129})) << "half way from white to the orange end";
  EXPECT_EQ(picture(3, 0), picture(4, 0)) << "only one of the two";
  EXPECT_NE(picture(5, 0), picture(4, 0)) << "none";
}

TEST(Pictures, PaletteTellsLabelsApart) {
  LabelImage labels(kColorCount + 1, 1);
  for (int i = 0; i <= kColorCount; ++i) labels(i, 0) = static_cast<uint8_t>(i);
  const ColorImage picture = picture_of_labels(labels);
  for (int a = 0; a <= kColorCount; ++a)
    for (int b = a + 1; b <= kColorCount; ++b) EXPECT_NE(picture(a, 0), picture(b, 0));
}

TEST(Pictures, PngReadsBackEqual) {
  const std::string path = test_folder() + "/small.png";
  ColorImage image(6, 3, Rgb{1, 2, 3});
  image(4, 0) = {200, 100, 50};
  write_png(path, image);
  EXPECT_EQ(decode_color(read_file(path), path), image);
  EXPECT_THROW(write_png("/proc/no/such/folder/x.png", image), Error);
}

}  // namespace
}  // namespace glovebench::render
