#include "core/base/random.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>
#include <numbers>

namespace glovebench {
namespace {

uint64_t stream_seed(uint64_t seed, std::string_view sequence, int64_t frame, std::string_view purpose) {
  const std::string key = fmt::format("{}/{}/{}/{}", seed, sequence, frame, purpose);
  return XXH3_64bits(key.data(), key.size());
}

}  // namespace

RandomStream::RandomStream(uint64_t seed, std::string_view sequence, int64_t frame, std::string_view purpose)
    : engine_(stream_seed(seed, sequence, frame, purpose)) {}

uint64_t RandomStream::bits() { return engine_(); }

double RandomStream::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

uint64_t RandomStream::index(uint64_t count) {
  return static_cast<uint64_t>(uniform() * static_cast<double>(count));
}

}  // namespace glovebench
