#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/adapters/dds/server/command_messages.h"
#include "core/robot/command_guard.h"

namespace glovebench {

/// A moment by the server's clocks, us.
struct ServerTime {
  int64_t clock_us = 0;   ///< monotonic
  int64_t system_us = 0;  ///< since 1970; may jump
};

struct Arrival {
  uint64_t sender = 0;  ///< identifies a process
  int64_t source_ns = 0;
  int64_t now_us = 0;  ///< reception, monotonic
};

/// Decides which messages a server follows: good, fresh ones of one owner, in time order.
/// core/adapters/dds/README.md ("The server") has the rules. Reads no clock.
/// A gap of ticks, or a jump of the owner's clock, releases the owner and ends its goals.
class CommandStream {
 public:
  /// `topics`: how many.
  CommandStream(const CommandLimits& limits, int topics);

  /// Returns true for, and counts, a message of a sender that is not the owner.
  bool ignores(uint64_t sender, int64_t now_us);
  /// Judges and counts a message. `found`: the outcome for its content.
  Receipt receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found);
  void tick(const ServerTime& now);
  /// Returns true if the last accepted message, of a topic or of any, still counts: at most `silence_s` old, with
  /// no gap or new owner since.
  bool is_current(int topic, int64_t now_us) const;
  bool is_current(int64_t now_us) const;
  /// Releases an owner that is gone.
  void keep_only(const std::set<uint64_t>& present);

  /// Number of changes of the owner.
  int64_t owners() const { return owners_; }
  int64_t gaps() const { return gaps_; }
  /// How many times as fast as its frames were taken the owner's stream came, in the fastest half second of a
  /// topic; 0 before a whole one with stamps.
  double pace() const { return pace_; }
  int64_t count(Receipt receipt) const { return receipts_[static_cast<size_t>(receipt)]; }

 private:
  /// On one topic of one sender.
  struct Delays {
    std::deque<std::pair<int64_t, int64_t>> smallest;  ///< of each second: start, smallest delay, us
    std::optional<std::pair<int64_t, int64_t>> start;  ///< first message: server time, source time, us
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
  std::optional<int64_t> seen_us_, apart_us_;  ///< last tick: time, difference of the clocks
  std::optional<int64_t> settled_us_;          ///< messages before it are stale
  int64_t gaps_ = 0;
  std::optional<uint64_t> owner_;
  int64_t owners_ = 0;
  int64_t good_us_ = 0;                                       ///< owner's last good message
  std::vector<std::optional<int64_t>> stamps_ns_, until_us_;  ///< by topic: last stamp; end of its effect
  /// By topic: reception and stamp from which the pace is measured.
  std::vector<std::optional<std::pair<int64_t, int64_t>>> paced_from_;
  double pace_ = 0;
};

}  // namespace glovebench
