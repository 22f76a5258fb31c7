#pragma once

#include <ctime>

#include "core/base/error.h"

namespace glovebench::eval {

/// Processor time of this thread.
inline double thread_time_ms() {
  timespec time{};
  check(clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) == 0, "a thread has a clock");
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace glovebench::eval
