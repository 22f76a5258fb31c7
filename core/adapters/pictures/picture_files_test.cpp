#include "core/adapters/pictures/picture_files.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

ColorImage make_image() {
  ColorImage image(37, 11);
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      image(u, v) = {static_cast<uint8_t>(6 * u), static_cast<uint8_t>(20 * v), 40};
  return image;
}

std::vector<int> gray_of(std::string_view content) {
  const Image<uint8_t> gray = decode_gray(content, "a");
  return {gray.begin(), gray.end()};
}

std::string refusal(std::string_view content) {
  return thrown_by([&] { decode_color(content, "a.png"); });
}

TEST(PictureFiles, PngComesBackEqual) { EXPECT_EQ(decode_color(encode_png(make_image()), "a.png"), make_image()); }

TEST(PictureFiles, JpegComesBackNearlyEqual) {
  const ColorImage image = make_image(), found = decode_color(encode_jpeg(image, 95), "a.jpg");
  ASSERT_EQ(found.width(), image.width());
  ASSERT_EQ(found.height(), image.height());
  for (size_t i = 0; i < image.size(); ++i)
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(found[i][channel], image[i][channel], 12) << i;  // chroma has half the size
  EXPECT_LT(encode_jpeg(image, 20).size(), encode_jpeg(image, 95).size());
}

TEST(PictureFiles, DeepGrayKeepsItsNumbersWhateverItsColorSpace) {
  Image<uint16_t> steps(3, 2, 5000);
  steps(1, 0) = 1;
  steps(2, 1) = 65535;
  const std::string png = encode_png(steps);
  EXPECT_EQ(decode_deep(png, "a.png"), steps);
  const size_t behind_header = 33;
  const std::string srgb("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13);
  EXPECT_EQ(decode_deep(std::string(png).insert(behind_header, srgb), "a.png"), steps);
  for (const std::string& other : {encode_png(make_image()), encode_png(Image<uint8_t>(3, 2)), png.substr(0, 60)})
    EXPECT_THROW(decode_deep(other, "a.png"), Error);
}

TEST(PictureFiles, GrayIsTheLuma) {
  ColorImage image(3, 1);
  image[0] = {255, 0, 0};
  image[1] = {0, 255, 0};
  image[2] = {0, 0, 255};
  EXPECT_THAT(gray_of(encode_png(image)), ElementsAre(76, 150, 29)) << "ITU-R BT.601";
}

TEST(PictureFiles, OfOtherProgramsAreRead) {
  const auto gray = [](const char* name) {
    return gray_of(read_file(build_paths::source("ci/corpora/picture/") + name));
  };
  EXPECT_THAT(gray("small.png"), ElementsAre('a', 'b', 'c', 'd', 'e', 'f'));
  EXPECT_EQ(gray("two_by_two.pgm"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_THAT(gray("sixteen_bits.pgm"), ElementsAre(0, 255)) << "1 and 515 of 65535";
  EXPECT_THAT(gray("sixteen_bits.png"), ElementsAre(0, 128, 255)) << "100, 200 and 300 of 65535";
  EXPECT_THAT(gray("gray_alpha.png"), ElementsAre(7, 0)) << "opaque, and seen through on black";
}

TEST(PictureFiles, SixteenBitsAreStretched) {
  using namespace std::string_view_literals;
  EXPECT_THAT(gray_of("P5\n# a sensor of ten bits\n3 1 1023\n\0\x10\x01\x10\0\x90"sv), ElementsAre(0, 255, 128));
}

TEST(PictureFiles, CutAnywhereAreRefused) {
  for (const std::string& whole : {encode_png(make_image()), encode_jpeg(make_image(), 80),
                                   "P6 37 11 255\n" + std::string(37 * 11 * 3, 'x')}) {
    EXPECT_EQ(refusal(whole), "");
    for (size_t size = 0; size + 12 < whole.size(); ++size)  // without its last chunk a PNG has all pixels
      EXPECT_THAT(refusal(whole.substr(0, size)),
                  AllOf(HasSubstr("a.png: content: found "), HasSubstr("expected a")))
          << size;
  }
}

TEST(PictureFiles, ClaimsAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(refusal("P5 30000 30000 65535\n"), HasSubstr("a.png: size: found 30000x30000"));
  EXPECT_THAT(refusal("P6 0 3 255\n"), HasSubstr("size: found 0x3"));
  EXPECT_THAT(refusal("P6 3 3 65535\n" + std::string(100, 'x')), HasSubstr("found values up to 65535"));
  EXPECT_THAT(refusal("P5 -3 3 255\n"), HasSubstr("found no header"));
  EXPECT_THAT(refusal("BM"), HasSubstr("expected a PNG, JPEG, PGM or PPM file"));
}

}  // namespace
}  // namespace glovebench
