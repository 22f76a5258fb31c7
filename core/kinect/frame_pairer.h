#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

namespace glovebench {

/// The Kinect's clock: 60 MHz, 32 bits, wraps every 71.6 s.
inline constexpr int64_t kTicksPerMicrosecond = 60;

/// Converts ticks to microseconds without wraps. Successive stamps must be under half a wrap apart.
class TickClock {
 public:
  TickClock() = default;
  /// `first_us`: the first stamp's time, wrong by less than half a wrap; magnitude below 1.5e17.
  explicit TickClock(int64_t first_us) : first_us_(first_us) {}

  int64_t microseconds(uint32_t ticks) {
    if (first_us_) ticks_ = *first_us_ * kTicksPerMicrosecond;
    if (!started_ && !first_us_) ticks_ = ticks;
    started_ = true;
    first_us_.reset();
    ticks_ += static_cast<int32_t>(ticks - static_cast<uint32_t>(ticks_));
    const bool rounds_up = ticks_ % kTicksPerMicrosecond < 0;
    return ticks_ / kTicksPerMicrosecond - rounds_up;
  }

 private:
  std::optional<int64_t> first_us_;
  bool started_ = false;
  int64_t ticks_ = 0;
};

struct PairingRules {
  int64_t max_gap_us = 50'000;                              ///< in a pair
  int64_t restart_us = 1'000'000;                           ///< a larger step back restarts the clock
  size_t max_waiting = std::numeric_limits<size_t>::max();  ///< of each kind
};

/// Pairs each depth image with a copy of the color image nearest in time (of two, the earlier). A depth image
/// waits for a color image that is not earlier, at most until depth is `max_gap_us` ahead, more than `max_waiting`
/// wait, or `finish`. Pairs come in order of time. Drops an image not later than its kind's last; if the clock
/// restarts, drops waiting images instead, and times go back.
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
  /// No push may follow.
  void finish() {
    finished_ = true;
    pair_up();
  }
  std::optional<Pair> pop() {
    if (pairs_.empty()) return std::nullopt;
    Pair pair = std::move(pairs_.front());
    pairs_.pop_front();
    return pair;
  }

  int unpaired() const { return unpaired_; }
  /// Dropped because not later.
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
      // Earlier color images are farther from this and all later depth images.
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
