#include "render/subjects/hand_dimensions.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace glovebench::render {
namespace {

/// Mean hand length of men and women together in NATICK/TR-15/007: the hand that Table I's segments belong to.
constexpr double kMeanLength_mm = 189.3;
constexpr double kCorrelation = 0.6;
constexpr double kSegmentSpread = 0.04;
constexpr double kGirthSpread = 0.03;

constexpr std::array<std::array<Published, 4>, 5> kSegments = {{
    {{{46.22, 3.94}, {31.57, 3.13}, {21.67, 1.60}, {5.67, 0.61}}},
    {{{39.78, 4.94}, {22.38, 2.51}, {15.82, 2.26}, {3.84, 0.59}}},
    {{{44.63, 3.81}, {26.33, 3.00}, {17.40, 1.85}, {3.95, 0.61}}},
    {{{41.37, 3.87}, {25.65, 3.29}, {17.30, 2.22}, {3.95, 0.60}}},
    {{{32.74, 2.77}, {18.11, 2.54}, {15.96, 2.45}, {3.73, 0.62}}},
}};

// NATICK/TR-92/011, means of men.
constexpr double kBreadthOfMen_mm = 90.4;
constexpr std::array<double, 5> kMiddleGirth_mm = {72.3, 68.4, 69.6, 64.9, 57.8};
constexpr std::array<double, 4> kDistalGirth_mm = {57.4, 57.8, 53.8, 49.2};
constexpr double kWristBreadth_mm = 65.8;
constexpr double kWristGirth_mm = 174.3;

double truncated_normal(RandomStream& random) { return std::clamp(random.normal(), -2.0, 2.0); }

}  // namespace

Published published_length(bool woman) { return woman ? Published{181, 9.5} : Published{193, 10}; }

Published published_breadth(bool woman) { return woman ? Published{78, 4} : Published{88, 4.4}; }

Published published_segment(int finger, int segment) { return kSegments.at(finger).at(segment); }

HandDimensions draw_dimensions(uint64_t seed) {
  RandomStream random(seed, "capsule hand", 0, "dimensions");
  HandDimensions hand;
  hand.woman = random.index(2) == 1;
  const double z_length = truncated_normal(random);
  const double z_breadth =
      kCorrelation * z_length + std::sqrt(1 - kCorrelation * kCorrelation) * truncated_normal(random);
  const Published length = published_length(hand.woman), breadth = published_breadth(hand.woman);
  hand.length = (length.mean_mm + length.sd_mm * z_length) / 1000;
  hand.breadth = (breadth.mean_mm + breadth.sd_mm * z_breadth) / 1000;

  const auto drawn = [&random](double mean_mm, double scale, double spread) {
    return mean_mm / 1000 * scale * (1 + spread * truncated_normal(random));
  };
  const double by_length = hand.length / (kMeanLength_mm / 1000);
  const double by_breadth = hand.breadth / (kBreadthOfMen_mm / 1000);
  for (int finger = 0; finger < 5; ++finger) {
    for (int s = 0; s < 3; ++s)
      hand.segments[finger][s] = drawn(kSegments[finger][s].mean_mm, by_length, kSegmentSpread);
    hand.pulp[finger] = drawn(kSegments[finger][3].mean_mm, by_length, kSegmentSpread);
    hand.middle_girth[finger] = drawn(kMiddleGirth_mm[finger], by_breadth, kGirthSpread);
    if (finger > 0) hand.distal_girth[finger - 1] = drawn(kDistalGirth_mm[finger - 1], by_breadth, kGirthSpread);
  }
  hand.wrist_breadth = drawn(kWristBreadth_mm, by_breadth, kGirthSpread);
  hand.wrist_girth = drawn(kWristGirth_mm, by_breadth, kGirthSpread);
  return hand;
}

}  // namespace glovebench::render
