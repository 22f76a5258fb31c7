#pragma once

// The time of day, for what other machines and processes compare with theirs.

#include <chrono>
#include <cstdint>

namespace glovebench {

/// Microseconds since 1970. Set clocks jump: to measure how long something takes, use steady_clock.
inline int64_t system_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

}  // namespace glovebench
