#include "core/database/distance_field.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

using Field = std::vector<uint8_t>;

Field plain(const LabelImage& labels, uint8_t color, uint8_t cap) {
  Field field(labels.size());
  chamfer_field_plain(labels, color, cap, field);
  return field;
}

Field fast(const LabelImage& labels, uint8_t color, uint8_t cap) {
  Field field(labels.size());
  chamfer_field(labels, color, cap, field);
  return field;
}

TEST(ChamferField, counts_three_a_straight_step_and_four_a_diagonal_one_up_to_the_cap) {
  LabelImage labels(5, 3);
  labels(0, 1) = 2;
  const Field expected = {3, 4, 7, 10, 11,  //
                          0, 3, 6, 9,  11,  //
                          3, 4, 7, 10, 11};
  EXPECT_EQ(plain(labels, 2, 11), expected);
  EXPECT_EQ(fast(labels, 2, 11), expected);
}

TEST(ChamferField, is_the_cap_everywhere_for_an_absent_color) {
  const LabelImage labels(4, 3, 5);
  EXPECT_EQ(plain(labels, 6, 9), Field(12, 9));
  EXPECT_EQ(fast(labels, 6, 9), Field(12, 9));
}

TEST(ChamferField, fast_equals_plain) {
  for (int i = 0; i < 400; ++i) {
    RandomStream random(1, "distance field test", i, "labels");
    // Tiny images of every size, then odd ones, then wider than the largest cap reaches.
    const int width = i % 2 == 0 ? 8 << (i / 2 % 4) : 1 + i % 150, height = i % 2 == 0 ? width : 1 + i % 47;
    LabelImage labels(width, height);
    const double density = std::pow(10.0, -random.uniform(0, 4));
    for (uint8_t& label : labels) label = random.uniform(0, 1) < density ? 3 : 1;
    for (const int cap : {1, 3, 4, 12, 24, 48, 96, 190, 255}) {
      ASSERT_EQ(fast(labels, 3, static_cast<uint8_t>(cap)), plain(labels, 3, static_cast<uint8_t>(cap)))
          << width << " x " << height << ", cap " << cap;
    }
  }
}

TEST(ChamferField, of_some_rows_is_right_in_these) {
  for (int i = 0; i < 300; ++i) {
    RandomStream random(1, "distance field test", i, "rows");
    const int width = 1 + static_cast<int>(random.index(64)), height = 1 + static_cast<int>(random.index(64));
    LabelImage labels(width, height);
    const double density = std::pow(10.0, -random.uniform(0, 4));
    for (uint8_t& label : labels) label = random.uniform(0, 1) < density ? 3 : 1;
    const int first = static_cast<int>(random.index(height)),
              last = first + static_cast<int>(random.index(height - first + 1));
    const Field whole = plain(labels, 3, 96);
    Field some(labels.size());
    chamfer_field(labels, 3, 96, some, {first, last});
    const auto begin = static_cast<ptrdiff_t>(first) * width, end = static_cast<ptrdiff_t>(last) * width;
    ASSERT_TRUE(std::equal(some.begin() + begin, some.begin() + end, whole.begin() + begin)) << i;
  }
  Field field(4);
  EXPECT_THROW(chamfer_field(LabelImage(2, 2), 1, 9, field, {1, 3}), std::logic_error);
  EXPECT_THROW(chamfer_field(LabelImage(2, 2), 1, 9, field, {-1, 1}), std::logic_error);
}

}  // namespace
}  // namespace glovebench
