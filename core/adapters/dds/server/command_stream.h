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

/// A moment by the two clocks of a server, us.
struct ServerTime {
  int64_t clock_us = 0;   ///< does not go back
  int64_t system_us = 0;  ///< since 1970; may be set
};

/// How a message came to a server.
struct Arrival {
  uint64_t sender = 0;    ///< any number that is one process's own
  int64_t source_ns = 0;  ///< when it was sent, by its sender's clock: DDS's source time
  int64_t now_us = 0;     ///< when the server took it, by the server's own clock, which does not go back
};

/// Which messages a server follows, and until when: those that are good in themselves, fresh, of one owner, in time
/// order. Reads no clock.
///
/// Fresh: nobody knows how far a sender's clock is from the server's. The delay of a message is the server's time
/// minus its source time. Its age is its delay minus the smallest delay of the last 10 to 11 s on that topic of
/// that sender. What is older than `silence_s` is stale.
///
/// The first message of a sender would have the age 0, however long it has waited. So a stream has to start: for
/// 0.2 s its messages show that source times advance as the server's clock does, and count as `starting`. Messages
/// that waited come faster than they were sent. If their source times gain more than 20 ms on the server's clock,
/// the start begins anew with the latest one. (A stream that is late by the same time all along cannot be told from
/// one whose clock is behind; nor can a queue that is emptied less than a tenth faster than it was filled.)
///
/// A gap makes every stream start again, and what comes in the 0.1 s after it is stale, for it waited somewhere.
/// A gap is: more than 0.1 s between two ticks; the server's two clocks further apart or nearer by more than 0.1 s
/// than at the last tick. A sender whose clock jumps by more than 0.1 s in a way that lateness does not explain
/// starts again alone. After a gap, or a jump of its owner, nobody owns the stream, and nothing that came before is
/// followed.
///
/// Of one owner: the first sender of a good message owns all topics; what others send meanwhile is foreign. It owns
/// them until it is gone or has sent nothing good for `stop_after_s`; then the next one does, and stamps begin
/// anew. Within a topic the owner's stamps must rise, or all be zero, which in ROS means now.
class CommandStream {
 public:
  /// `topics`: how many there are, numbered from 0.
  CommandStream(const CommandLimits& limits, int topics);

  /// Whether a message of that sender is foreign, whatever is in it; then it is counted and need not be read.
  bool ignores(uint64_t sender, int64_t now_us);
  /// What becomes of a message of which `found` is what its content is worth. Counts it.
  Receipt receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found);
  /// For every tick.
  void tick(const ServerTime& now);
  /// Whether the last message that was accepted on a topic, or on any, may still move something: it is no older
  /// than `silence_s`, and since then there was neither a gap nor another owner.
  bool is_current(int topic, int64_t now_us) const;
  bool is_current(int64_t now_us) const;
  /// The senders that are there: an owner that is not among them is gone.
  void keep_only(const std::set<uint64_t>& present);

  /// How often the stream got an owner.
  int64_t owners() const { return owners_; }
  int64_t gaps() const { return gaps_; }
  int64_t count(Receipt receipt) const { return receipts_[static_cast<size_t>(receipt)]; }

 private:
  /// What is known of the delays on one topic of one sender.
  struct Delays {
    std::deque<std::pair<int64_t, int64_t>> smallest;  ///< delay, us, of each second: from when on, and which
    std::optional<std::pair<int64_t, int64_t>>
        start;  ///< the first message: the server's time, its source time, us
    bool started = false;
    int64_t heard_us = 0, source_us = 0, delay_us = 0;  ///< of the last message

    void forget(int64_t now_us);
    int64_t smallest_delay() const;
    bool jumps(int64_t source, int64_t delay) const;
    void add(int64_t now_us, int64_t source, int64_t delay);
  };

  Receipt judge(const Arrival& arrival, int topic, const ros::Time& stamp);
  std::pair<Receipt, int64_t> judge_age(const Arrival& arrival, int topic);
  Receipt judge_order(const Arrival& arrival, int topic, const ros::Time& stamp);
  bool is_foreign(uint64_t sender, int64_t now_us) const;
  Delays& delays(uint64_t sender, int topic);
  bool watch(int64_t now_us);
  void begin_gap(int64_t now_us);
  void lose_owner();

  int64_t silence_us_, release_us_;
  std::array<int64_t, kCountOf<Receipt>> receipts_{};
  std::map<std::pair<uint64_t, int>, Delays> delays_;
  std::optional<int64_t> seen_us_, apart_us_;  ///< of the last tick: the server's time, and its clocks' difference
  std::optional<int64_t> settled_us_;          ///< until then all is stale
  int64_t gaps_ = 0;
  std::optional<uint64_t> owner_;
  int64_t owners_ = 0;
  int64_t good_us_ = 0;                                       ///< when the owner's last good message came
  std::vector<std::optional<int64_t>> stamps_ns_, until_us_;  ///< of each topic: its last stamp, how long it counts
};

}  // namespace glovebench
