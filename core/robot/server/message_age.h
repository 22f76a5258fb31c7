#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "core/robot/server/receipt.h"

namespace glovebench {

/// How a message came to a server.
struct Arrival {
  uint64_t sender = 0;    ///< any number that is one process's own
  int64_t source_ns = 0;  ///< when it was sent, by its sender's clock: DDS's source time
  int64_t now_us = 0;     ///< when the server took it, by the server's own clock, which does not go back
};

/// What the clocks say about a message.
struct MessageAge {
  Receipt receipt = Receipt::accepted;  ///< or `starting`, or `stale`
  int64_t age_us = 0;                   ///< how much later it came than the fastest one of the last 10 s
  bool jumped = false;                  ///< its sender's clock jumped: what was known of it counts no more
};

/// How old messages are, although nobody knows how far a sender's clock is from the server's. The delay of a
/// message is the server's time minus its source time. Its age is its delay minus the smallest delay of the last 10
/// to 11 s on that topic of that sender.
///
/// The first message of a sender would have the age 0, however long it has waited. So a stream has to start: for
/// 0.2 s its messages show that source times advance as the server's clock does, and count as `starting`. Messages
/// that waited come faster than they were sent. If their source times gain more than 20 ms on the server's clock,
/// the start begins anew with the latest one. (A stream that is late by the same time all along cannot be told from
/// one whose clock is behind; nor can a queue that is emptied less than a tenth faster than it was filled.)
///
/// A gap makes every stream start again, and what comes in the 0.1 s after it is stale, for it waited somewhere.
/// A gap is: more than 0.1 s between two ticks; the server's two clocks further apart or nearer by more than 0.1 s
/// than at the last tick;
/// a sender whose clock jumps by more than 0.1 s in a way that lateness does not explain.
/// Reads no clock.
class MessageAges {
 public:
  /// What is older than `limit_s` is stale.
  explicit MessageAges(double limit_s);

  /// For every message. `topic`: any number.
  MessageAge judge(const Arrival& arrival, int topic);
  /// For every moment at which something is received. True: there was a gap until now.
  bool watch(int64_t now_us);
  /// For every tick. `system_us`: the time of day, since 1970, which may be set. True: there was a gap.
  bool tick(int64_t now_us, int64_t system_us);

 private:
  /// One topic of one sender.
  struct Stream {
    std::deque<std::pair<int64_t, int64_t>> smallest;  ///< delay, us, of each second: from when on, and which
    std::optional<std::pair<int64_t, int64_t>>
        start;  ///< the first message: the server's time, its source time, us
    bool started = false;
    int64_t heard_us = 0, source_us = 0, delay_us = 0;  ///< of the last message

    void add(int64_t now_us, int64_t delay);
    void forget(int64_t now_us);
    int64_t smallest_delay() const;
    bool jumps(int64_t source, int64_t delay) const;
  };
  Stream& stream(const Arrival& arrival, int topic);
  void begin_anew(int64_t now_us);

  int64_t limit_us_;
  std::map<std::pair<uint64_t, int>, Stream> streams_;
  std::optional<int64_t> seen_us_, apart_us_;  ///< of the last tick: the server's time, and its clocks' difference
  std::optional<int64_t> settled_us_;          ///< until then all is stale
};

}  // namespace glovebench
