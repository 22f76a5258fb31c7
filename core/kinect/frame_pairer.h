#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

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

struct PairingRules {
  int64_t max_gap_us = 50'000;     ///< farther apart they are no pair
  int64_t restart_us = 1'000'000;  ///< a clock that went back by more than this was started again
  size_t max_waiting = std::numeric_limits<size_t>::max();  ///< depth images and color images that are kept, each
};

/// Pairs depth images with color images by time stamp while they arrive, each kind in its own order in time: each
/// depth image goes with the color image nearest in time, the earlier of two that are equally near. So a depth
/// image waits for the first color image that is not before it, but no longer than until depth is ahead by
/// `max_gap_us`, too many wait, or the stream has ended. A color image may go with several depth images.
///
/// Out come the depth images that have a partner, in order of time; all others are counted. What is not later than
/// the one before of its kind is dropped, unless the clock was started again: then what waits is dropped, and the
/// time of the pairs goes back, too. Reads no clock. `Depth` and `Color` are what the images are carried in;
/// `Color` is copied.
template <typename Depth, typename Color>
class FramePairer {
 public:
  struct Pair {
    int64_t depth_us = 0;
    Depth depth;
    int64_t color_us = 0;
    Color color;
  };

  explicit FramePairer(PairingRules rules = {}) : rules_(rules) {}

  void push_depth(int64_t time_us, Depth depth) {
    if (!is_later(time_us, latest_depth_us_)) return;
    latest_depth_us_ = time_us;
    depths_.emplace_back(time_us, std::move(depth));
    pair_up();
  }
  void push_color(int64_t time_us, Color color) {
    if (!is_later(time_us, latest_color_us_)) return;
    latest_color_us_ = time_us;
    colors_.emplace_back(time_us, std::move(color));
    pair_up();
    if (colors_.size() > rules_.max_waiting) colors_.pop_front();
  }
  /// Nothing more will arrive: what waits is paired with what there is.
  void finish() {
    finished_ = true;
    pair_up();
  }
  /// The next pair, if there is one now.
  std::optional<Pair> pop() {
    if (pairs_.empty()) return std::nullopt;
    Pair pair = std::move(pairs_.front());
    pairs_.pop_front();
    return pair;
  }

  /// Depth images without a partner.
  int unpaired() const { return unpaired_; }
  /// Images whose time stamp was not later than that of the one before.
  int went_back() const { return went_back_; }

 private:
  using Time = std::optional<int64_t>;

  bool is_later(int64_t time_us, Time latest_us) {
    if (!latest_us || time_us > *latest_us) return true;
    if (*latest_us - time_us <= rules_.restart_us) {
      ++went_back_;
      return false;
    }
    unpaired_ += static_cast<int>(depths_.size());
    depths_.clear();
    colors_.clear();
    latest_depth_us_ = latest_color_us_ = std::nullopt;
    return true;
  }

  bool may_wait() const {
    const int64_t ahead_us = *latest_depth_us_ - depths_.front().first;
    return !finished_ && ahead_us <= rules_.max_gap_us && depths_.size() <= rules_.max_waiting;
  }

  void pair_up() {
    while (!depths_.empty()) {
      const int64_t time_us = depths_.front().first;
      // Of the color images the first is the only one that may be before all depth images that are still to come.
      while (colors_.size() > 1 && colors_[1].first <= time_us) colors_.pop_front();
      const bool decided = !colors_.empty() && colors_.back().first >= time_us;
      if (!decided && may_wait()) return;
      take_nearest(time_us);
    }
  }

  void take_nearest(int64_t time_us) {
    const auto gap_us = [&](size_t i) { return std::abs(colors_[i].first - time_us); };
    const size_t nearest = colors_.size() > 1 && gap_us(1) < gap_us(0) ? 1 : 0;
    if (!colors_.empty() && gap_us(nearest) <= rules_.max_gap_us) {
      pairs_.push_back(
          {time_us, std::move(depths_.front().second), colors_[nearest].first, colors_[nearest].second});
    } else {
      ++unpaired_;
    }
    depths_.pop_front();
  }

  PairingRules rules_;
  std::deque<std::pair<int64_t, Depth>> depths_;
  std::deque<std::pair<int64_t, Color>> colors_;
  std::deque<Pair> pairs_;
  Time latest_depth_us_, latest_color_us_;
  bool finished_ = false;
  int unpaired_ = 0;
  int went_back_ = 0;
};

}  // namespace glovebench
