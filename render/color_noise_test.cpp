#include "render/color_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace glovebench::render {
namespace {

TEST(RowRandom, GivesTheWordsOfSplitMix64FromTheirLowEnd) {
  const RowRandom random(0);  // 0xe220a8397b1dcdaf, 0x6e789e6aa1b965f4, ...
  const std::array<int, 5> words = {0xcdaf, 0x7b1d, 0xa839, 0xe220, 0x65f4};
  std::array<float, 5> normals{};
  random.normals(normals);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(random.uniform(i), static_cast<float>(words[i]) / 65536);
    EXPECT_EQ(random.normal(i), normals[i]);
    EXPECT_EQ(normals[i] > 0, words[i] >= 0x8000) << "quantiles rise";
  }
}

TEST(ColorNoise, HasItsSigmaAndNoBias) {
  const ColorImage clean(320, 240, Rgb{100, 128, 200});
  const ColorImage noisy = add_color_noise(clean, kColorSigma_gray, {7, "test", 3});
  double sum = 0;
  double squares = 0;
  for (size_t i = 0; i < clean.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double difference = noisy[i][channel] - clean[i][channel];
      sum += difference;
      squares += difference * difference;
    }
  }
  const double count = 3.0 * static_cast<double>(clean.size());
  // 230,400 samples: standard errors 0.004 and 0.003 gray levels. Rounding adds 1/12 to the variance.
  EXPECT_NEAR(sum / count, 0.0, 0.02);
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(4.0 + 1.0 / 12.0), 0.02);
  EXPECT_EQ(add_color_noise(clean, 0, {7, "test", 3}), clean);
}

}  // namespace
}  // namespace glovebench::render
