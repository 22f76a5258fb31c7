#include "core/database/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/database/test_database.h"

namespace glovebench {
namespace {

/// Nearest pixel of the color by `distance(|du|, |dv|)`; infinite if there is none.
template <typename Distance>
double nearest(const LabelImage& labels, uint8_t color, int u, int v, Distance&& distance) {
  double best = std::numeric_limits<double>::infinity();
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x)
      if (labels(x, y) == color) best = std::min(best, distance(std::abs(x - u), std::abs(y - v)));
  }
  return best;
}

/// The cheapest path over the pixel grid: a diagonal step costs 4, a straight one 3.
double shortest_3_4_path(int du, int dv) { return 4.0 * std::min(du, dv) + 3.0 * std::abs(du - dv); }

std::vector<uint8_t> field_of(const LabelImage& labels, uint8_t color, uint8_t cap) {
  std::vector<uint8_t> field(labels.size());
  chamfer_field(labels, color, cap, field);
  return field;
}

std::vector<uint8_t> plain_field_of(const LabelImage& labels, uint8_t color, uint8_t cap) {
  std::vector<uint8_t> field(labels.size());
  chamfer_field_plain(labels, color, cap, field);
  return field;
}

LabelImage random_labels(int number, int width, int height, double density) {
  RandomStream random(1, "chamfer", number, "labels");
  LabelImage labels(width, height);
  for (uint8_t& label : labels)
    if (random.uniform() < density) label = static_cast<uint8_t>(1 + random.index(kColorCount));
  return labels;
}

TEST(DistanceField, equals_the_shortest_3_4_paths_up_to_the_cap) {
  for (const double density : {0.002, 0.01, 0.1, 0.9}) {
    for (const int cap : {1, 7, 96, 255}) {
      const LabelImage labels = random_labels(cap, 41, 23, density);
      for (int color = 1; color <= kColorCount; ++color) {
        const std::vector<uint8_t> field = field_of(labels, static_cast<uint8_t>(color), static_cast<uint8_t>(cap));
        for (int v = 0; v < labels.height(); ++v) {
          for (int u = 0; u < labels.width(); ++u) {
            const double expected = nearest(labels, static_cast<uint8_t>(color), u, v, shortest_3_4_path);
            ASSERT_EQ(field[v * labels.width() + u], std::min<double>(expected, cap));
          }
        }
      }
    }
  }
}

TEST(DistanceField, an_absent_color_costs_the_cap_everywhere) {
  const LabelImage labels(16, 16, 3);
  EXPECT_EQ(field_of(labels, 4, 96), std::vector<uint8_t>(256, 96));
  EXPECT_EQ(field_of(labels, 3, 96), std::vector<uint8_t>(256, 0));
  EXPECT_EQ(field_of(LabelImage(16, 16), 1, 24), std::vector<uint8_t>(256, 24));
}

TEST(DistanceField, an_entrys_fields_are_those_of_its_own_labels) {
  const Database& database = test_database();
  for (const int size : kTinySizes) {
    const int pixels = size * size, cap = size * 3 / 2;  // half the side, in thirds of a pixel
    for (const int entry : {0, 100, 755, 756, 1511}) {
      const LabelImage labels = entry_image(database, size, entry);
      for (int color = 1; color <= kColorCount; ++color) {
        const uint8_t* found = database.fields(size, entry) + (color - 1) * pixels;
        const std::vector<uint8_t> expected =
            field_of(labels, static_cast<uint8_t>(color), static_cast<uint8_t>(cap));
        ASSERT_TRUE(std::equal(expected.begin(), expected.end(), found)) << size << " px, entry " << entry;
      }
    }
  }
}

TEST(DistanceField, chamfering_is_within_a_few_percent_of_the_euclidean_distance) {
  // A path of steps 3 and 4 over 3 is longest against the straight line along an axis' neighborhood (+5.4%, at
  // du = 3 dv) and shortest along the diagonal (4 / 3 against sqrt(2), -5.7%).
  const Database& database = test_database();
  double deviation = 0, absolute = 0, worst_above = 0, worst_below = 0;
  int count = 0;
  for (const int entry : {0, 300, 900, 1400}) {
    const LabelImage labels = entry_image(database, 64, entry);
    for (int color = 1; color <= kColorCount; ++color) {
      for (int i = 0; i < 64 * 64; ++i) {
        const int stored = database.fields(64, entry)[(color - 1) * 64 * 64 + i];
        const double euclidean = nearest(labels, static_cast<uint8_t>(color), i % 64, i / 64,
                                         [](int du, int dv) { return std::hypot(du, dv); });
        if (euclidean == 0 || stored == 96) continue;  // on the color, or capped
        const double relative = static_cast<double>(stored) / kFieldScale / euclidean - 1;
        deviation += relative;
        absolute += std::abs(relative);
        worst_above = std::max(worst_above, relative);
        worst_below = std::min(worst_below, relative);
        ++count;
      }
    }
  }
  ASSERT_GT(count, 50'000);
  RecordProperty("mean_deviation_percent", std::to_string(100 * deviation / count));
  RecordProperty("mean_absolute_deviation_percent", std::to_string(100 * absolute / count));
  std::printf("chamfer against Euclidean: mean %+.2f%%, mean absolute %.2f%%, %+.2f%% to %+.2f%%\n",
              100 * deviation / count, 100 * absolute / count, 100 * worst_below, 100 * worst_above);
  EXPECT_LT(worst_above, 0.0541);
  EXPECT_GT(worst_below, -0.0573);
  EXPECT_LT(absolute / count, 0.04);
}

TEST(ChamferField, counts_three_a_straight_step_and_four_a_diagonal_one_up_to_the_cap) {
  LabelImage labels(5, 3);
  labels(0, 1) = 2;
  const std::vector<uint8_t> expected = {3, 4, 7, 10, 11,  //
                                         0, 3, 6, 9,  11,  //
                                         3, 4, 7, 10, 11};
  EXPECT_EQ(plain_field_of(labels, 2, 11), expected);
  EXPECT_EQ(field_of(labels, 2, 11), expected);
}

TEST(ChamferField, is_the_cap_everywhere_for_an_absent_color) {
  const LabelImage labels(4, 3, 5);
  EXPECT_EQ(plain_field_of(labels, 6, 9), std::vector<uint8_t>(12, 9));
  EXPECT_EQ(field_of(labels, 6, 9), std::vector<uint8_t>(12, 9));
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
      ASSERT_EQ(field_of(labels, 3, static_cast<uint8_t>(cap)),
                plain_field_of(labels, 3, static_cast<uint8_t>(cap)))
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
    const std::vector<uint8_t> whole = plain_field_of(labels, 3, 96);
    std::vector<uint8_t> some(labels.size());
    chamfer_field(labels, 3, 96, some, {first, last});
    const auto begin = static_cast<ptrdiff_t>(first) * width, end = static_cast<ptrdiff_t>(last) * width;
    ASSERT_TRUE(std::equal(some.begin() + begin, some.begin() + end, whole.begin() + begin)) << i;
  }
  std::vector<uint8_t> field(4);
  EXPECT_THROW(chamfer_field(LabelImage(2, 2), 1, 9, field, {1, 3}), std::logic_error);
  EXPECT_THROW(chamfer_field(LabelImage(2, 2), 1, 9, field, {-1, 1}), std::logic_error);
}

}  // namespace
}  // namespace glovebench
