#include <cstring>

#include "core/kinect/frame_pairer.h"
#include "core/kinect/tick_clock.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

/// Two streams as a device could give them: of five bytes each the first says which, the others are ticks.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  FramePairer<int64_t, int64_t> pairer({.max_waiting = 16});
  TickClock clock;
  size_t depths = 0, pairs = 0;
  const auto take_pairs = [&] {
    while (const auto pair = pairer.pop()) {
      check(std::abs(pair->depth_us - pair->color_us) <= PairingRules().max_gap_us, "a pair is near in time");
      check(pair->depth == pair->depth_us && pair->color == pair->color_us, "an image keeps its time");
      ++pairs;
    }
  };
  for (; size >= 5; data += 5, size -= 5) {
    uint32_t ticks = 0;
    std::memcpy(&ticks, data + 1, sizeof ticks);
    const int64_t time_us = clock.microseconds(ticks);
    depths += data[0] % 2;
    if (data[0] % 2 == 1) pairer.push_depth(time_us, time_us);
    if (data[0] % 2 == 0) pairer.push_color(time_us, time_us);
    take_pairs();
  }
  pairer.finish();
  take_pairs();
  const size_t unpaired = static_cast<size_t>(pairer.unpaired()), back = static_cast<size_t>(pairer.went_back());
  check(pairs + unpaired <= depths && depths <= pairs + unpaired + back, "each depth image is told once");
  return 0;
}
