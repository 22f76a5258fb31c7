#include "core/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace glovebench {
namespace {

std::vector<uint64_t> first_bits(RandomStream stream) {
  std::vector<uint64_t> bits;
  for (int i = 0; i < 100; ++i) bits.push_back(stream.bits());
  return bits;
}

TEST(RandomStream, the_same_name_gives_the_same_numbers_whatever_was_drawn_before) {
  const std::vector<uint64_t> alone = first_bits({1, "Tr1", 7, "depth"});
  RandomStream other(1, "Tr1", 6, "depth");
  for (int i = 0; i < 1000; ++i) other.normal();
  EXPECT_EQ(first_bits({1, "Tr1", 7, "depth"}), alone);
}

TEST(RandomStream, each_part_of_the_name_makes_another_stream) {
  const std::set<std::vector<uint64_t>> streams = {
      first_bits({1, "Tr1", 7, "depth"}),  first_bits({2, "Tr1", 7, "depth"}), first_bits({1, "Tr2", 7, "depth"}),
      first_bits({1, "Tr1", 8, "depth"}),  first_bits({1, "Tr1", 7, "color"}), first_bits({1, "Tr1", -7, "depth"}),
      first_bits({17, "Tr1", 7, "depth"}),
  };
  EXPECT_EQ(streams.size(), 7u);
}

TEST(RandomStream, neighboring_frames_are_not_correlated) {
  constexpr int kFrames = 20'000;
  double sum = 0;
  for (int frame = 0; frame < kFrames; ++frame)
    sum += RandomStream(1, "Tr1", frame, "depth").normal() * RandomStream(1, "Tr1", frame + 1, "depth").normal();
  // The mean product of independent normals has standard deviation 1 / sqrt(20,000) = 0.0071; four of them.
  EXPECT_NEAR(sum / kFrames, 0, 0.0283);
}

TEST(RandomStream, normal_has_mean_0_variance_1_and_normal_tails) {
  constexpr int kCount = 200'000;
  RandomStream stream(1, "moments", 0, "test");
  double sum = 0, squares = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = stream.normal();
    sum += x;
    squares += x * x;
    beyond_two += std::abs(x) > 2;
  }
  // Four standard deviations of the estimates: 1 / sqrt(n), sqrt(2 / n) and sqrt(p (1 - p) / n), p = 0.0455.
  EXPECT_NEAR(sum / kCount, 0, 4 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(squares / kCount, 1, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(static_cast<double>(beyond_two) / kCount, 0.0455, 4 * std::sqrt(0.0455 * 0.9545 / kCount));
}

TEST(RandomStream, uniform_and_index_stay_in_range_and_reach_all_of_it) {
  constexpr int kCount = 70'000;
  RandomStream stream(1, "uniform", 0, "test");
  double sum = 0;
  std::array<int, 7> hits{};
  for (int i = 0; i < kCount; ++i) {
    const double x = stream.uniform(-2, 5);
    ASSERT_GE(x, -2);
    ASSERT_LT(x, 5);
    sum += x;
    const uint64_t index = stream.index(7);
    ASSERT_LT(index, 7u);
    ++hits[index];
  }
  EXPECT_NEAR(sum / kCount, 1.5, 4 * 7 / std::sqrt(12.0 * kCount));  // four standard deviations
  for (const int count : hits) EXPECT_NEAR(count, 10'000, 4 * std::sqrt(10'000 * 6.0 / 7));
}

}  // namespace
}  // namespace glovebench
