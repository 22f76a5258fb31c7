#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace glovebench {

/// Every random number comes from a named stream: the hash of (seed, sequence, frame, purpose). So neither
/// the number of threads nor the order of frames changes a result, and nothing is seeded from a clock.
class RandomStream {
 public:
  RandomStream(uint64_t seed, std::string_view sequence, int64_t frame, std::string_view purpose);

  uint64_t bits();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal by Box-Muller: the same on every platform, unlike std::normal_distribution.
  double normal();
  /// Uniform in 0..count-1.
  uint64_t index(uint64_t count);

 private:
  std::mt19937_64 engine_;
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace glovebench
