#include "core/calibration/color_seeds.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/calibration/test_glove.h"
#include "core/segmentation/color_calibration.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench::calibration {
namespace {

using testing::HasSubstr;

const nlohmann::json kGlove = {{"format", "glovebench-glove-colors"},
                               {"version", 1},
                               {"colors_rgb",
                                {{200, 30, 40},
                                 {30, 200, 40},
                                 {30, 40, 200},
                                 {200, 190, 30},
                                 {200, 30, 190},
                                 {30, 190, 200},
                                 {230, 150, 230},
                                 {120, 220, 20},
                                 {110, 40, 220},
                                 {120, 200, 230}}}};

std::string refusal(const std::string& text) {
  const std::string error = thrown_by([&] { parse_glove_colors(text, "glove.json"); });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}
std::string refusal_of(const std::string& pointer, const nlohmann::json& value) {
  nlohmann::json changed = kGlove;
  changed[nlohmann::json::json_pointer(pointer)] = value;
  return refusal(changed.dump());
}

TEST(Chroma, is_the_color_without_its_brightness) {
  EXPECT_LT(chroma_of({100, 100, 100}).norm(), 1e-12);
  // Red: Y = 76.2, U - 128 = 0.564 (B - Y), V - 128 = 0.713 (R - Y).
  EXPECT_LT((chroma_of({255, 0, 0}) - Chroma(-0.5643, 1.6727)).norm(), 1e-3);
  const Eigen::Array3d color(40, 120, 200);
  EXPECT_LT((chroma_of(color) - chroma_of(0.5 * color)).norm(), 1e-12);
  EXPECT_LT((rgb_of_chroma(chroma_of(color)) * luma_of(color) - color).abs().maxCoeff(), 1e-3);
}

TEST(ColorSeeds, of_a_list_are_its_chroma) {
  const ColorSeeds seeds = parse_glove_colors(kGlove.dump(), "glove.json");
  EXPECT_EQ(seeds[1], chroma_of({200, 30, 40}));
  EXPECT_EQ(seeds[10], chroma_of({120, 200, 230}));
}

TEST(ColorSeeds, refuse_a_damaged_list_in_one_line) {
  EXPECT_THAT(refusal(""), HasSubstr("glove.json: content: found nothing, expected JSON"));
  EXPECT_THAT(refusal("[]"), HasSubstr("top level: found an array of 0, expected an object"));
  EXPECT_THAT(refusal_of("/format", "other"), HasSubstr("format: found \"other\""));
  EXPECT_THAT(refusal_of("/format", nlohmann::json::parse(std::string(100, '[') + std::string(100, ']'))),
              HasSubstr("glove.json: nesting: found deeper nesting"));
  EXPECT_THAT(refusal_of("/version", 2), HasSubstr("version: found 2, expected a whole number in 1..1"));
  EXPECT_THAT(refusal_of("/names", "x"),
              HasSubstr("found unknown key \"names\", expected only format, version, colors_rgb"));
  EXPECT_THAT(refusal_of("/colors_rgb", "x\ny"), HasSubstr("colors_rgb: found \"x\\ny\""));
  EXPECT_THAT(refusal_of("/colors_rgb", nlohmann::json::array()),
              HasSubstr("colors_rgb: found 0 elements, expected 10"));
  EXPECT_THAT(refusal_of("/colors_rgb/3", {1, 2}), HasSubstr("colors_rgb[3]: found 2 elements, expected 3"));
  EXPECT_THAT(refusal_of("/colors_rgb/3/1", 256),
              HasSubstr("colors_rgb[3][1]: found 256, expected a number in 0..255"));
  EXPECT_THAT(refusal_of("/colors_rgb/9", {0, 0, 0}), HasSubstr("colors_rgb[9]: found black"));
}

TEST(ColorSeeds, of_a_table_lie_in_the_middle_of_its_colors) {
  ColorCalibration counted;
  const ColorSamples samples = test_samples({});
  for (const ColorSample& sample : samples.beyond()) counted.add_pixel(sample.rgb, 0);
  const ColorImage color = test_frame({}, 0).color;
  for (int v = 0; v < kTestHeight; ++v)
    for (int u = 0; u < kTestWidth; ++u) {
      const int stripe = stripe_at(u, v, {});
      if (stripe >= 1 && stripe <= kColorCount && (v - kTestMargin) % kStripe > 1)
        counted.add_pixel(color(u, v), static_cast<uint8_t>(stripe));
    }
  const ColorSeeds seeds = seeds_of_table(counted.build(), "table"), expected = test_seeds();
  for (int label = 1; label <= kColorCount; ++label)
    EXPECT_LT((seeds[label] - expected[label]).norm(), 0.05) << label;
  EXPECT_THAT(thrown_by([] { seeds_of_table(ColorTable(), "empty.table"); }),
              HasSubstr("empty.table: color 1: found no cell"));
}

TEST(ColorSeeds, are_loaded_by_what_the_file_holds) {
  const std::string folder = test_folder();
  write_file(folder + "/glove", "\n " + kGlove.dump());
  EXPECT_EQ(load_seeds(folder + "/glove"), parse_glove_colors(kGlove.dump(), ""));
  write_file(folder + "/glove", "glovebench color table, version 2, yuv\n");
  EXPECT_THROW(load_seeds(folder + "/glove"), Error);
  EXPECT_THROW(load_seeds(folder + "/none"), Error);
}

}  // namespace
}  // namespace glovebench::calibration
