#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/adapters/dds/command_messages.h"
#include "core/robot/command_guard.h"

namespace glovebench {

struct ServerTime {
  int64_t clock_us = 0;   ///< monotonic
  int64_t system_us = 0;  ///< since 1970; may jump
};

struct Arrival {
  uint64_t sender = 0;  ///< one per process
  int64_t source_ns = 0;
  int64_t now_us = 0;  ///< reception, monotonic
};

/// Selects the messages that a server follows (core/adapters/dds/README.md, "The server"): valid, fresh, in time
/// order, from one owner. Reads no clock.
///
/// | state | messages are | until |
/// | --- | --- | --- |
/// | settling, after a gap or a jump of `system_us` | `stale` | 0.1 s passed |
/// | starting, of a sender's topic | `starting` | 0.2 s passed by both clocks |
/// | started, no owner | `accepted` if valid; the sender becomes owner | that |
/// | owned, from the owner | `accepted` if valid | a gap, a jump of its clock, or its absence |
/// | owned, from another | `foreign` | no message was accepted for `stop_after_s` |
class CommandStream {
 public:
  /// `topics`: number of topics.
  CommandStream(const CommandLimits& limits, int topics);

  /// True if another sender owns the topics. The message is then counted.
  bool ignores(uint64_t sender, int64_t now_us);
  /// Judges and counts a message. `found`: outcome of the content checks.
  Receipt receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found);
  void tick(const ServerTime& now);
  /// True if the last accepted message of a topic (or of any) is valid: at most `silence_s` old, without a gap or a
  /// new owner since.
  bool is_current(int topic, int64_t now_us) const;
  bool is_current(int64_t now_us) const;
  /// Releases an absent owner.
  void keep_only(const std::set<uint64_t>& present);

  /// How many times a sender became owner.
  int64_t owners() const { return owners_; }
  int64_t gaps() const { return gaps_; }
  /// The owner's fastest half second on a topic: time between stamps over time between receptions. 0 before half a
  /// second with stamps.
  double pace() const { return pace_; }
  int64_t count(Receipt receipt) const { return receipts_[static_cast<size_t>(receipt)]; }

 private:
  /// For one topic of one sender.
  struct Delays {
    std::deque<std::pair<int64_t, int64_t>> smallest;  ///< per second: start, smallest delay, us
    std::optional<std::pair<int64_t, int64_t>> start;  ///< first message: server time, source time
    bool started = false;
    int64_t heard_us = 0, source_us = 0, delay_us = 0;  ///< last message

    void forget(int64_t now_us);
    int64_t smallest_delay() const;
    bool jumps(int64_t source, int64_t delay) const;
    void add(int64_t now_us, int64_t source, int64_t delay);
  };

  Receipt judge(const Arrival& arrival, int topic, const ros::Time& stamp);
  std::pair<Receipt, int64_t> judge_age(const Arrival& arrival, int topic);
  Receipt judge_order(const Arrival& arrival, int topic, const ros::Time& stamp);
  void measure_pace(int64_t now_us, int topic, int64_t stamp_ns);
  bool is_foreign(uint64_t sender, int64_t now_us) const;
  Delays& delays(uint64_t sender, int topic);
  bool watch(int64_t now_us);
  void begin_gap(int64_t now_us);
  void lose_owner();

  int64_t silence_us_, release_us_;
  std::array<int64_t, kCountOf<Receipt>> receipts_{};
  std::map<std::pair<uint64_t, int>, Delays> delays_;
  std::optional<int64_t> seen_us_, apart_us_;  ///< last tick: time, difference of clocks
  std::optional<int64_t> settled_us_;          ///< earlier messages are stale
  int64_t gaps_ = 0;
  std::optional<uint64_t> owner_;
  int64_t owners_ = 0;
  int64_t good_us_ = 0;
  std::vector<std::optional<int64_t>> stamps_ns_, until_us_;  ///< by topic: last stamp; end of its effect
  /// By topic: reception and stamp from which the pace is measured.
  std::vector<std::optional<std::pair<int64_t, int64_t>>> paced_from_;
  double pace_ = 0;
};

}  // namespace glovebench
