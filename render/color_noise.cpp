#include "render/color_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace glovebench::render {
namespace {

/// Standard normal quantiles at the centers of 65,536 equal shares of probability. Looking a number up is ten times
/// as fast as Box-Muller.
std::vector<float> make_normal_quantiles() {
  constexpr int kCount = 1 << 16;
  std::vector<float> quantiles(kCount);
  double x = 0;
  for (int i = kCount / 2; i < kCount; ++i) {
    const double upper_tail = 1.0 - (i + 0.5) / kCount;
    // Newton's method from the neighbor's quantile; the tail is convex there, so that it converges from below.
    for (int step = 0; step < 20; ++step) {
      const double tail = 0.5 * std::erfc(x / std::sqrt(2.0));
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      const double change = (tail - upper_tail) / density;
      x += change;
      if (std::abs(change) < 1e-12) break;
    }
    quantiles[i] = static_cast<float>(x);
    quantiles[kCount - 1 - i] = -quantiles[i];
  }
  return quantiles;
}

}  // namespace

RowRandom::RowRandom(uint64_t seed) : seed_(seed) {
  static const std::vector<float> quantiles = make_normal_quantiles();
  quantiles_ = quantiles.data();
}

void RowRandom::normals(std::span<float> values) const {
  const int count = static_cast<int>(values.size()), whole = count / 4 * 4;
  float* value = values.data();
  for (int i = 0; i < whole; i += 4) {
    const uint64_t four = word(i / 4);
    for (int k = 0; k < 4; ++k) *value++ = quantiles_[static_cast<uint16_t>(four >> (16 * k))];
  }
  for (int i = whole; i < count; ++i) *value++ = normal(i);
}

std::vector<uint64_t> row_seeds(const FrameKey& key, std::string_view purpose, int rows) {
  RandomStream stream(key.seed, key.sequence, key.frame, purpose);
  std::vector<uint64_t> seeds(rows);
  for (uint64_t& seed : seeds) seed = stream.bits();
  return seeds;
}

ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key) {
  const std::vector<uint64_t> seeds = row_seeds(key, "color noise", color.height());
  const auto sigma = static_cast<float>(sigma_gray);
  ColorImage noisy = color;
  std::vector<float> normals(3 * static_cast<size_t>(color.width()));
  for (int v = 0; v < color.height(); ++v) {
    RowRandom(seeds[v]).normals(normals);
    const float* normal = normals.data();
    for (Rgb& pixel : std::span(noisy.row(v), static_cast<size_t>(noisy.width()))) {
      for (uint8_t& channel : pixel) {
        const float value = static_cast<float>(channel) + sigma * *normal++;
        channel = static_cast<uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
      }
    }
  }
  return noisy;
}

}  // namespace glovebench::render
