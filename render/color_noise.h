#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/image.h"

namespace glovebench::render {

struct FrameKey {
  uint64_t seed = 0;
  std::string_view sequence;
  int64_t frame = 0;
};

/// Random numbers of one image row (SplitMix64).
class RowRandom {
 public:
  explicit RowRandom(uint64_t state) : state_(state) {}

  /// Standard normal, up to 4.3 sigma.
  float normal();
  /// [0, 1)
  float uniform() { return static_cast<float>(next16()) * 0x1p-16f; }

 private:
  uint16_t next16() {
    if (left_ == 0) {
      state_ += 0x9e3779b97f4a7c15u;
      word_ = state_;
      word_ = (word_ ^ (word_ >> 30)) * 0xbf58476d1ce4e5b9u;
      word_ = (word_ ^ (word_ >> 27)) * 0x94d049bb133111ebu;
      word_ ^= word_ >> 31;
      left_ = 4;
    }
    const auto value = static_cast<uint16_t>(word_);
    word_ >>= 16;
    --left_;
    return value;
  }

  uint64_t state_;
  uint64_t word_ = 0;
  int left_ = 0;
};

std::vector<uint64_t> row_seeds(const FrameKey& key, std::string_view purpose, int rows);

/// Standard deviation per 8-bit channel.
inline constexpr double kColorSigma_gray = 2.0;

ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key);

}  // namespace glovebench::render
