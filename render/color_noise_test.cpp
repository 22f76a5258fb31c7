#include "render/color_noise.h"

#include <gtest/gtest.h>

namespace glovebench::render {
namespace {

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
