#include "core/segmentation/color_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "core/base/whole_file.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

class ColorTableFile : public testing::Test {
 protected:
  const fs::path folder_ = test_folder();
  const std::string path_ = (folder_ / "glove.colors").string();
};

ColorTable random_table(ColorSpace space = ColorSpace::yuv) {
  RandomStream random(3, "color table", 0, "labels");
  std::vector<uint8_t> labels(ColorTable::kCells);
  for (uint8_t& label : labels) label = static_cast<uint8_t>(random.index(kColorCount + 1));
  return ColorTable(labels, space);
}

std::string load_error(const std::string& path) {
  return thrown_by([&] { ColorTable::load(path); });
}

TEST(Yuv, MatchesHandComputedValues) {
  // BT.601: Y = 0.299 R + 0.587 G + 0.114 B, U = 128 + 0.564 (B - Y), V = 128 + 0.713 (R - Y).
  EXPECT_EQ(yuv_from_rgb({0, 0, 0}), (Yuv{0, 128, 128}));
  EXPECT_EQ(yuv_from_rgb({255, 255, 255}), (Yuv{255, 128, 128}));
  EXPECT_EQ(yuv_from_rgb({255, 0, 0}), (Yuv{76, 85, 255}));
  EXPECT_EQ(yuv_from_rgb({0, 255, 0}), (Yuv{150, 44, 21}));
  EXPECT_EQ(yuv_from_rgb({0, 0, 255}), (Yuv{29, 255, 107}));
  EXPECT_EQ(yuv_from_rgb({100, 100, 100}), (Yuv{100, 128, 128}));
}

TEST(ColorTable, CellsAreFourStepsWide) {
  EXPECT_EQ(ColorTable::cell({0, 0, 0}), 0u);
  EXPECT_EQ(ColorTable::cell({3, 3, 3}), 0u);
  EXPECT_EQ(ColorTable::cell({4, 0, 0}), 64u * 64u);
  EXPECT_EQ(ColorTable::cell({0, 4, 0}), 64u);
  EXPECT_EQ(ColorTable::cell({0, 0, 4}), 1u);
  EXPECT_EQ(ColorTable::cell({255, 255, 255}), ColorTable::kCells - 1);
}

TEST(ColorTable, RefusesImpossibleLabels) {
  EXPECT_THROW(ColorTable(std::vector<uint8_t>(5)), Error);
  std::vector<uint8_t> labels(ColorTable::kCells, kColorCount);
  EXPECT_NO_THROW(ColorTable{labels});
  labels[17] = kColorCount + 1;
  EXPECT_THROW(ColorTable{labels}, Error);
}

TEST(ColorTable, LooksUpInItsOwnSpace) {
  const Rgb color = {200, 30, 40};  // cell (50, 7, 10) of RGB
  std::vector<uint8_t> cells(ColorTable::kCells, 0);
  cells[(50 * 64 + 7) * 64 + 10] = 3;
  EXPECT_EQ(ColorTable(cells, ColorSpace::rgb).label(color), 3);
  EXPECT_EQ(ColorTable(cells, ColorSpace::yuv).label(color), 0);
  EXPECT_EQ(ColorTable(cells).space(), ColorSpace::yuv);
  for (const ColorSpace space : {ColorSpace::yuv, ColorSpace::rgb})
    EXPECT_EQ(from_name<ColorSpace>(to_string(space)), space);
  EXPECT_EQ(from_name<ColorSpace>("hsv"), std::nullopt);
}

TEST_F(ColorTableFile, LoadsWhatWasSaved) {
  for (const ColorSpace space : {ColorSpace::yuv, ColorSpace::rgb}) {
    const ColorTable table = random_table(space);
    table.save(path_);
    EXPECT_EQ(ColorTable::load(path_).labels(), table.labels());
    EXPECT_EQ(ColorTable::load(path_).space(), space);
  }
}

TEST_F(ColorTableFile, NamesFileAndFieldOfDamage) {
  random_table().save(path_);
  const std::string good = read_file(path_);
  const auto error_of = [&](const std::string& content) {
    write_file(path_, content);
    return load_error(path_);
  };
  EXPECT_EQ(error_of(good), "");
  std::string other_version = good;
  other_version[good.find(',', good.find("version")) - 1] = '1';
  EXPECT_NE(error_of(other_version).find(path_ + ": version: found \"1, yuv\""), std::string::npos);
  std::string other_space = good;
  other_space[good.find('\n') - 1] = 'x';
  EXPECT_NE(error_of(other_space).find(path_ + ": color space: found \"yux\""), std::string::npos);
  EXPECT_NE(error_of("PK" + good).find(path_ + ": header"), std::string::npos);
  EXPECT_NE(error_of(good.substr(0, good.size() - 1)).find(path_ + ": size"), std::string::npos);
  EXPECT_NE(error_of(good + "x").find(path_ + ": size"), std::string::npos);
  EXPECT_NE(error_of("").find(path_ + ": header"), std::string::npos);
  fs::remove(path_);
  EXPECT_NE(load_error(path_).find(path_), std::string::npos);
}

TEST_F(ColorTableFile, RefusesEveryByteFlip) {
  random_table().save(path_);
  const std::string good = read_file(path_);
  RandomStream random(5, "color table", 0, "flips");
  for (int i = 0; i < 100; ++i) {
    std::string bad = good;
    // Half of the flips hit the header.
    const size_t at = random.index(i % 2 == 0 ? 73 : bad.size());
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.index(8)));
    write_file(path_, bad);
    EXPECT_NE(load_error(path_), "") << "byte " << at;
  }
}

TEST(Segment, LabelsOnlyPixelsThatHaveAColor) {
  std::vector<uint8_t> cells(ColorTable::kCells, 0);
  cells[ColorTable::cell(yuv_from_rgb({200, 30, 40}))] = 4;
  const ColorTable table(cells);
  RegisteredImage mapped{ColorImage(3, 1), Image<uint8_t>(3, 1)};
  mapped.color(0, 0) = mapped.color(1, 0) = {200, 30, 40};
  mapped.color(2, 0) = {30, 200, 40};
  mapped.has_color(0, 0) = mapped.has_color(2, 0) = 1;
  const LabelImage labels = segment(mapped, table);
  EXPECT_EQ(labels(0, 0), 4);
  EXPECT_EQ(labels(1, 0), 0);  // the same color, but hidden from the RGB camera
  EXPECT_EQ(labels(2, 0), 0);
}

TEST(Segment, LabelsEveryPixelLikeTheTableInEitherSpace) {
  RandomStream random(4, "color table", 0, "image");
  RegisteredImage mapped{ColorImage(31, 17), Image<uint8_t>(31, 17)};
  for (Rgb& rgb : mapped.color)
    for (uint8_t& channel : rgb) channel = static_cast<uint8_t>(random.index(256));
  for (uint8_t& has_color : mapped.has_color) has_color = static_cast<uint8_t>(random.index(2));
  for (const ColorSpace space : {ColorSpace::yuv, ColorSpace::rgb}) {
    const ColorTable table = random_table(space);
    const LabelImage of_mapped = segment(mapped, table), of_image = segment(mapped.color, table);
    for (size_t i = 0; i < of_image.size(); ++i) {
      EXPECT_EQ(of_image[i], table.label(mapped.color[i]));
      EXPECT_EQ(of_mapped[i], mapped.has_color[i] ? table.label(mapped.color[i]) : 0);
    }
  }
}

/// Votes counted one by one; ties go to the center's label, else to the smallest.
uint8_t counted_majority(const LabelImage& labels, int u, int v) {
  std::array<int, kColorCount + 1> votes{};
  for (int j = v - 1; j <= v + 1; ++j)
    for (int i = u - 1; i <= u + 1; ++i)
      if (labels.contains(i, j)) ++votes[labels(i, j)];
  const auto most = std::max_element(votes.begin(), votes.end());
  return votes[labels(u, v)] == *most ? labels(u, v) : static_cast<uint8_t>(most - votes.begin());
}

TEST(MajorityFilter, CountsVotesLikeThePlainWay) {
  // Blocks (so that ties, uniform runs and borders occur) with a tenth of the pixels wrong.
  LabelImage labels(37, 23);
  RandomStream random(9, "majority", 0, "labels");
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u)
      labels(u, v) =
          static_cast<uint8_t>(u > 18 && random.uniform() < 0.3 ? random.index(11) : (u / 14 + v / 9) % 4);
  const LabelImage filtered = majority_filter(labels);
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u)
      EXPECT_EQ(filtered(u, v), counted_majority(labels, u, v)) << u << ", " << v;
}

TEST(MajorityFilter, RemovesSpecksAndFillsHoles) {
  LabelImage labels(20, 20);
  labels(3, 3) = 5;
  for (int v = 8; v < 18; ++v)
    for (int u = 8; u < 18; ++u) labels(u, v) = 2;
  labels(12, 12) = 0;
  const LabelImage filtered = majority_filter(labels);
  EXPECT_EQ(filtered(3, 3), 0);
  EXPECT_EQ(filtered(12, 12), 2);
  EXPECT_EQ(majority_filter(LabelImage()).size(), 0u);
}

struct Scene {
  LabelImage labels{9, 7};
  DepthImage depth{9, 7, 0.7F};
};

/// Patch 3 at the left, 5 at the right.
Scene two_patches() {
  Scene scene;
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 9; ++u) scene.labels(u, v) = u < 4 ? 3 : 5;
  return scene;
}

TEST(SurfaceMajority, closes_the_gap_between_two_patches) {
  Scene scene = two_patches();
  const LabelImage whole = scene.labels;
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 0;  // what mixes 3 and 5
  const LabelImage filtered = surface_majority(scene.labels, scene.depth);
  for (int v = 0; v < 7; ++v) {
    EXPECT_EQ(filtered(4, v), 3) << "three votes each: the smaller label";
    EXPECT_EQ(filtered(3, v), 3);
    EXPECT_EQ(filtered(5, v), 5);
  }
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 7;  // or is taken for a third color
  scene.labels(4, 3) = 5;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth)(4, 3), 5);
  EXPECT_EQ(surface_majority(whole, scene.depth), whole) << "nothing to mend";
}

TEST(SurfaceMajority, stays_on_the_surface) {
  Scene scene = two_patches();
  for (int v = 0; v < 7; ++v) scene.depth(4, v) = 0.75F;  // behind both
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 0;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth), scene.labels);
  for (int v = 0; v < 7; ++v) scene.depth(4, v) = 0;  // without a depth there is no point
  EXPECT_EQ(surface_majority(scene.labels, scene.depth), scene.labels);
  EXPECT_EQ(surface_majority(scene.labels, scene.depth, 1.0)(3, 3), 3);
}

TEST(SurfaceMajority, removes_a_speck_within_a_patch_and_grows_none_from_one_alone) {
  Scene scene = two_patches();
  scene.labels(2, 3) = 8;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth)(2, 3), 3);
  Scene empty;
  empty.labels(4, 3) = 8;
  EXPECT_EQ(surface_majority(empty.labels, empty.depth), empty.labels);
  empty.labels(4, 4) = 8;
  EXPECT_EQ(surface_majority(empty.labels, empty.depth)(3, 3), 8) << "two vote";
  EXPECT_EQ(surface_majority(LabelImage(), DepthImage()).size(), 0U);
}

/// Votes counted one by one.
uint8_t counted_surface_majority(const LabelImage& labels, const DepthImage& depth, int u, int v) {
  std::array<int, kColorCount + 1> votes{};
  for (int j = v - 1; j <= v + 1; ++j)
    for (int i = u - 1; i <= u + 1; ++i)
      if (labels.contains(i, j) && std::abs(double{depth(i, j)} - depth(u, v)) < 0.02) ++votes[labels(i, j)];
  const uint8_t own = labels(u, v);
  if (depth(u, v) == 0 || (own == 0 && std::accumulate(votes.begin() + 1, votes.end(), 0) < 2)) return own;
  const auto most = std::max_element(votes.begin() + 1, votes.end());
  return own != 0 && votes[own] == *most ? own : static_cast<uint8_t>(most - votes.begin());
}

TEST(SurfaceMajority, counts_votes_like_the_plain_way) {
  for (const int width : {1, 7, 8, 9, 37}) {
    LabelImage labels(width, 23);
    DepthImage depth(width, 23);
    RandomStream random(5, "surface majority", width, "votes");
    for (int v = 0; v < labels.height(); ++v)
      for (int u = 0; u < labels.width(); ++u) {
        const bool is_mixed = u + v > 18 && random.uniform() < 0.3;
        labels(u, v) = static_cast<uint8_t>(is_mixed ? random.index(11) : (u / 14 + v / 9) % 4);
        depth(u, v) = random.uniform() < 0.1 ? 0 : 0.7F + 0.01F * static_cast<float>(random.index(4));
      }
    const LabelImage filtered = surface_majority(labels, depth);
    for (int v = 0; v < labels.height(); ++v)
      for (int u = 0; u < labels.width(); ++u)
        EXPECT_EQ(filtered(u, v), counted_surface_majority(labels, depth, u, v)) << width << ": " << u << ", " << v;
  }
}

TEST(SurfaceMajority, never_takes_a_label_away_and_never_one_that_is_not_near) {
  RandomStream random(4, "surface majority", 0, "labels");
  LabelImage labels(40, 30);
  DepthImage depth(40, 30);
  for (uint8_t& label : labels) label = static_cast<uint8_t>(random.index(4));
  for (float& z : depth) z = 0.7F + 0.05F * static_cast<float>(random.index(2));
  const LabelImage filtered = surface_majority(labels, depth);
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u) {
      EXPECT_TRUE(labels(u, v) == 0 || filtered(u, v) != 0);
      bool near = filtered(u, v) == 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          near |= labels.contains(u + i, v + j) && labels(u + i, v + j) == filtered(u, v) &&
                  std::abs(depth(u + i, v + j) - depth(u, v)) < 0.02F;
      EXPECT_TRUE(near);
    }
}

}  // namespace
}  // namespace glovebench
