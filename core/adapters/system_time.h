#pragma once

#include <chrono>
#include <cstdint>

namespace glovebench {

/// Microseconds since 1970. May jump: measure durations with steady_clock.
inline int64_t system_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

}  // namespace glovebench
