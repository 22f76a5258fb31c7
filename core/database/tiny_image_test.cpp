#include "core/database/tiny_image.h"

#include <gtest/gtest.h>

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
  for (const int size : kTinySizes) {
    EXPECT_EQ(make_tiny_image(a, bounding_square(a), size), make_tiny_image(b, bounding_square(b), size));
  }
}

}  // namespace
}  // namespace glovebench
