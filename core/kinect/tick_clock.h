#pragma once

#include <cstdint>
#include <optional>

namespace glovebench {

/// The Kinect's own clock as libfreenect hands it out: 32 bits of 60 MHz, which come around every 71.6 s.
inline constexpr int64_t kTicksPerMicrosecond = 60;

/// Turns ticks into microseconds that do not come around. One clock serves both streams of a device: of any two
/// stamps in a row the later is less than 35.8 s after the earlier, in arrival either way around. The first stamp
/// is taken as it is, or, where its time is known by half a round, so many rounds later.
class TickClock {
 public:
  TickClock() = default;
  /// `first_us`: about when the first stamp is; of a size below 1.5e17.
  explicit TickClock(int64_t first_us) : first_us_(first_us) {}

  int64_t microseconds(uint32_t ticks) {
    if (first_us_) ticks_ = *first_us_ * kTicksPerMicrosecond;
    if (!started_ && !first_us_) ticks_ = ticks;
    started_ = true;
    first_us_.reset();
    ticks_ += static_cast<int32_t>(ticks - static_cast<uint32_t>(ticks_));
    const bool rounds_up = ticks_ % kTicksPerMicrosecond < 0;  // down, also before zero
    return ticks_ / kTicksPerMicrosecond - rounds_up;
  }

 private:
  std::optional<int64_t> first_us_;
  bool started_ = false;
  int64_t ticks_ = 0;
};

}  // namespace glovebench
