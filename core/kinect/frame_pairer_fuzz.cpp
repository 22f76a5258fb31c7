#include "core/base/fuzz_target.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {

/// Two streams as a device could give them: of five bytes each the first says which, the others are ticks.
void frame_pairer_fuzz(std::string_view bytes) {
  without_error([&] {
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
    for (FuzzInput input(bytes); !input.empty();) {
      const bool is_depth = input.next<uint8_t>() % 2 == 1;
      const auto ticks = input.next<uint32_t>();
      const int64_t time_us = clock.microseconds(ticks);
      depths += is_depth ? 1 : 0;
      if (is_depth) pairer.push_depth(time_us, time_us);
      if (!is_depth) pairer.push_color(time_us, time_us);
      take_pairs();
    }
    pairer.finish();
    take_pairs();
    const size_t unpaired = static_cast<size_t>(pairer.unpaired()), back = static_cast<size_t>(pairer.went_back());
    check(pairs + unpaired <= depths && depths <= pairs + unpaired + back, "each depth image is told once");
  });
}

}  // namespace glovebench
