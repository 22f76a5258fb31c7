#pragma once

#include <set>
#include <vector>

#include "core/robot/command_guard.h"
#include "core/robot/server/message_age.h"
#include "core/robot/server/stream_gate.h"

namespace glovebench {

/// Which messages a server follows, and until when: those that are good in themselves, of one owner (StreamGate),
/// fresh (MessageAges), in time order. Reads no clock.
class CommandStream {
 public:
  /// `topics`: how many there are, numbered from 0.
  CommandStream(const CommandLimits& limits, int topics);

  /// Whether a message of that sender is foreign, whatever is in it; then it is counted and need not be read.
  bool ignores(uint64_t sender, int64_t now_us);
  /// What becomes of a message of which `found` is what its content is worth. Counts it.
  Receipt receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found);
  /// For every tick. After a gap nobody owns the stream, and nothing that came before is followed.
  void tick(int64_t now_us, int64_t system_us);
  /// Whether the last message that was accepted on a topic, or on any, may still move something: it is no older
  /// than `silence_s`, and since then there was neither a gap nor another owner.
  bool is_current(int topic, int64_t now_us) const;
  bool is_current(int64_t now_us) const;
  /// The senders that are there: an owner that is not among them is gone.
  void keep_only(const std::set<uint64_t>& present) { gate_.keep_only(present); }

  /// How often the stream got an owner.
  int64_t owners() const { return gate_.owners(); }
  int64_t gaps() const { return gaps_; }
  const ReceiptCounts& receipts() const { return receipts_; }

 private:
  Receipt judge(const Arrival& arrival, int topic, const ros::Time& stamp);
  void drop_all();
  void begin_anew();

  int64_t silence_us_;
  StreamGate gate_;
  MessageAges ages_;
  ReceiptCounts receipts_{};
  std::vector<std::optional<int64_t>> until_us_;  ///< of each topic: how long its last message is followed
  int64_t gaps_ = 0;
};

}  // namespace glovebench
