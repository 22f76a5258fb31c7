#include "core/database/tiny_image.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

TEST(TinyImage, square_is_centered_on_the_bounding_box) {
  LabelImage labels(20, 10);
  labels(4, 3) = 1;
  labels(11, 6) = 2;
  const Square square = bounding_square(labels);
  EXPECT_EQ(square.side, 8);
  EXPECT_EQ(square.left, 4);
  EXPECT_EQ(square.top, 1);  // rows 3..6 lie in the middle of 1..8
  EXPECT_EQ(bounding_square(LabelImage(5, 5)).side, 0);
}

TEST(TinyImage, cells_take_the_majority_and_ties_go_to_the_glove) {
  LabelImage labels(16, 16);
  // Cell (0,0): 3 of color 2, 1 none. Cell (1,0): 2 of color 5, 2 none. Cell (0,1): 1 of color 3, 3 none.
  labels(0, 0) = labels(1, 0) = labels(0, 1) = 2;
  labels(2, 0) = labels(3, 0) = 5;
  labels(0, 2) = 3;
  const LabelImage tiny = make_tiny_image(labels, {0, 0, 16}, 8);
  EXPECT_EQ(tiny(0, 0), 2);
  EXPECT_EQ(tiny(1, 0), 5);
  EXPECT_EQ(tiny(0, 1), 0);
}

TEST(TinyImage, a_small_square_is_enlarged_and_one_over_the_border_is_padded) {
  LabelImage labels(4, 4, 7);
  const LabelImage enlarged = make_tiny_image(labels, {0, 0, 4}, 8);
  EXPECT_EQ(enlarged, LabelImage(8, 8, 7));
  const LabelImage padded = make_tiny_image(labels, {-4, 0, 8}, 8);
  EXPECT_EQ(padded(3, 0), 0);
  EXPECT_EQ(padded(4, 0), 7);
  EXPECT_EQ(padded(4, 4), 0);
}

TEST(TinyImage, does_not_depend_on_where_the_hand_is) {
  LabelImage a(100, 100), b(100, 100);
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 20; ++u) {
      const auto label = static_cast<uint8_t>((u / 5 + v / 7) % 4);
      a(10 + u, 10 + v) = label;
      b(61 + u, 47 + v) = label;
    }
  }
  for (const int size : kTinySizes)
    EXPECT_EQ(make_tiny_image(a, bounding_square(a), size), make_tiny_image(b, bounding_square(b), size));
}

/// Blobs of every label, with single pixels among them.
LabelImage random_labels(RandomStream& random, int width, int height) {
  LabelImage labels(width, height);
  const auto below = [&](int end) { return static_cast<int>(random.uniform(0, end)); };
  for (int blob = 0; blob < 12; ++blob) {
    const int left = below(width), top = below(height), right = left + 1 + below(width / 3),
              bottom = top + 1 + below(height / 3);
    const auto label = static_cast<uint8_t>(below(kColorCount + 1));
    for (int v = top; v < std::min(bottom, height); ++v)
      for (int u = left; u < std::min(right, width); ++u)
        labels(u, v) = random.uniform(0, 1) < 0.9 ? label : static_cast<uint8_t>(below(kColorCount + 1));
  }
  return labels;
}

TEST(TinyImage, bounding_square_holds_every_labeled_pixel_and_touches_the_outermost) {
  for (int i = 0; i < 200; ++i) {
    RandomStream random(1, "tiny image test", i, "square");
    LabelImage labels(3 + i % 41, 2 + i % 23);
    for (int pixel = 0; pixel < 1 + i % 7; ++pixel)
      labels[static_cast<size_t>(random.uniform(0, static_cast<double>(labels.size())))] = 10;
    int left = labels.width(), right = -1, top = labels.height(), bottom = -1;
    for (int v = 0; v < labels.height(); ++v) {
      for (int u = 0; u < labels.width(); ++u) {
        if (labels(u, v) == 0) continue;
        left = std::min(left, u), right = std::max(right, u), top = std::min(top, v), bottom = std::max(bottom, v);
      }
    }
    const Square square = bounding_square(labels);
    EXPECT_EQ(square.side, std::max(right - left, bottom - top) + 1);
    EXPECT_EQ(square.left, left - (square.side - (right - left + 1)) / 2);
    EXPECT_EQ(square.top, top - (square.side - (bottom - top + 1)) / 2);
  }
}

TEST(TinyImage, fast_equals_plain) {
  for (int i = 0; i < 100; ++i) {
    RandomStream random(1, "tiny image test", i, "labels");
    const LabelImage labels = random_labels(random, 40 + i, 140 - i);
    // Around the hand, then smaller than the tiny images, then over each border and far outside.
    for (const Square& square : {bounding_square(labels), Square{7, 5, 1 + i % 6}, Square{-30, -20, 71},
                                 Square{20, 30, 200}, Square{500, 3, 40}, Square{-90, 3, 40}, Square{0, 0, 0}})
      for (const int size : kTinySizes)
        ASSERT_EQ(make_tiny_image(labels, square, size), make_tiny_image_plain(labels, square, size)) << i;
  }
}

TEST(TinyImage, fast_equals_plain_where_a_cell_has_more_pixels_than_sixteen_bits_count) {
  const LabelImage labels(2100, 2100, 4);
  EXPECT_EQ(make_tiny_image(labels, {0, 0, 2100}, 8), LabelImage(8, 8, 4));
}

TEST(PackedLabels, hold_two_pixels_a_byte) {
  LabelImage labels(3, 1);
  labels[0] = 10;
  labels[1] = 1;
  labels[2] = 7;
  std::vector<uint8_t> packed(packed_bytes(labels.size()));
  pack_labels(labels, packed);
  EXPECT_EQ(packed, (std::vector<uint8_t>{0x1a, 0x07}));
}

TEST(PackedLabels, come_back_whatever_the_size) {
  for (int width = 1; width <= 64; width += 7) {
    for (const int height : {1, 8, 23, 64}) {
      RandomStream random(1, "packed labels", width, "labels");
      LabelImage labels(width, height);
      for (uint8_t& label : labels) label = static_cast<uint8_t>(random.index(kColorCount + 1));
      std::vector<uint8_t> packed(packed_bytes(labels.size()));
      pack_labels(labels, packed);
      EXPECT_EQ(unpack_labels(packed, width, height), labels) << width << " x " << height;
    }
  }
}

TEST(PackedLabels, of_another_size_are_refused) {
  std::vector<uint8_t> packed(4);
  EXPECT_THROW(pack_labels(LabelImage(3, 3), packed), std::logic_error);
  EXPECT_THROW(unpack_labels(packed, 3, 3), std::logic_error);
}

}  // namespace
}  // namespace glovebench
