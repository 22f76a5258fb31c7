#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

struct FrameKey {
  uint64_t seed = 0;
  std::string_view sequence;
  int64_t frame = 0;
};

/// The random numbers of one image row (SplitMix64), each by its place: 0, 1, ...
class RowRandom {
 public:
  explicit RowRandom(uint64_t seed);

  /// Standard normal, up to 4.3 sigma.
  float normal(int i) const { return quantiles_[bits(i)]; }
  /// normal(0), normal(1), ...
  void normals(std::span<float> values) const;
  /// [0, 1)
  float uniform(int i) const { return static_cast<float>(bits(i)) * 0x1p-16f; }

 private:
  /// Four numbers.
  uint64_t word(int i) const {
    uint64_t word = seed_ + 0x9e3779b97f4a7c15u * (static_cast<uint64_t>(i) + 1);
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    return word ^ (word >> 31);
  }
  uint16_t bits(int i) const { return static_cast<uint16_t>(word(i / 4) >> (16 * (i % 4))); }

  uint64_t seed_;
  const float* quantiles_;  ///< of the 2^16 numbers
};

std::vector<uint64_t> row_seeds(const FrameKey& key, std::string_view purpose, int rows);

/// Standard deviation per 8-bit channel.
inline constexpr double kColorSigma_gray = 2.0;

ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key);

}  // namespace glovebench::render
