#pragma once

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <ctime>

#include "core/base/error.h"

namespace glovebench::eval {

/// Calls work(i) for i = 0..count-1. Parallel code inside `work` shares the `threads`.
template <typename Work>
void in_parallel(int threads, size_t count, const Work& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena(threads).execute([&] {
    const auto each = [&](const tbb::blocked_range<size_t>& range) {
      for (size_t i = range.begin(); i != range.end(); ++i) work(i);
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 1), each, tbb::simple_partitioner());
  });
}

inline double time_ms(clockid_t clock) {
  timespec time{};
  check(clock_gettime(clock, &time) == 0, "a thread has a clock");
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}
inline double thread_time_ms() { return time_ms(CLOCK_THREAD_CPUTIME_ID); }
inline double wall_time_ms() { return time_ms(CLOCK_MONOTONIC); }

}  // namespace glovebench::eval
