#include "render/subjects/hand_dimensions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace glovebench::render {
namespace {

void expect_within(double value, const Published& published, double deviations, const char* what, int seed) {
  const double mm = 1000 * value;
  EXPECT_LE(std::abs(mm - published.mean_mm), deviations * published.sd_mm) << what << " of seed " << seed;
}

TEST(HandDimensions, LieWithinThePublishedRanges) {
  for (int seed = 1; seed <= 200; ++seed) {
    const HandDimensions hand = draw_dimensions(seed);
    expect_within(hand.length, published_length(hand.woman), 2.001, "length", seed);
    // Two draws of at most two deviations, correlated: 2 * (0.6 + 0.8).
    expect_within(hand.breadth, published_breadth(hand.woman), 2.801, "breadth", seed);
    for (int finger = 0; finger < 5; ++finger) {
      for (int s = 0; s < 3; ++s)
        expect_within(hand.segments[finger][s], published_segment(finger, s), 3.5, "segment", seed);
      expect_within(hand.pulp[finger], published_segment(finger, 3), 3.5, "pulp", seed);
    }
  }
}

TEST(HandDimensions, HaveThePublishedMeansAndCorrelations) {
  constexpr int kHands = 2000;
  double sum_l = 0, sum_b = 0, sum_ll = 0, sum_bb = 0, sum_lb = 0;
  double segment = 0;
  int men = 0;
  for (int seed = 1; seed <= kHands; ++seed) {
    const HandDimensions hand = draw_dimensions(seed);
    segment += 1000 * hand.segments[2][0] / kHands;
    if (hand.woman) continue;
    const double l = 1000 * hand.length, b = 1000 * hand.breadth;
    ++men;
    sum_l += l, sum_b += b, sum_ll += l * l, sum_bb += b * b, sum_lb += l * b;
  }
  EXPECT_NEAR(men, kHands / 2, 100);  // 4.5 deviations of a fair coin
  const double mean_l = sum_l / men, mean_b = sum_b / men;
  EXPECT_NEAR(mean_l, published_length(false).mean_mm, 1.2);  // over three standard errors
  EXPECT_NEAR(mean_b, published_breadth(false).mean_mm, 0.5);
  const double correlation = (sum_lb / men - mean_l * mean_b) /
                             std::sqrt((sum_ll / men - mean_l * mean_l) * (sum_bb / men - mean_b * mean_b));
  EXPECT_NEAR(correlation, 0.6, 0.07);
  EXPECT_NEAR(segment, published_segment(2, 0).mean_mm, 1.0);
}

}  // namespace
}  // namespace glovebench::render
