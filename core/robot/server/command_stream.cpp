#include "core/robot/server/command_stream.h"

#include <cmath>

namespace glovebench {

CommandStream::CommandStream(const CommandLimits& limits, int topics)
    : silence_us_(std::llround(limits.silence_s * 1e6)),
      gate_(limits.stop_after_s),
      ages_(limits.silence_s),
      until_us_(static_cast<size_t>(topics)) {}

bool CommandStream::ignores(uint64_t sender, int64_t now_us) {
  if (ages_.watch(now_us)) begin_anew();
  const bool foreign = gate_.is_foreign(sender, now_us);
  receipts_[static_cast<size_t>(Receipt::foreign)] += foreign;
  return foreign;
}

Receipt CommandStream::receive(const Arrival& arrival, int topic, const ros::Time& stamp, Receipt found) {
  const Receipt receipt = found == Receipt::accepted ? judge(arrival, topic, stamp) : found;
  ++receipts_[static_cast<size_t>(receipt)];
  return receipt;
}

Receipt CommandStream::judge(const Arrival& arrival, int topic, const ros::Time& stamp) {
  const MessageAge age = ages_.judge(arrival, topic);
  if (age.jumped && gate_.owner() == arrival.sender) begin_anew();
  if (age.receipt != Receipt::accepted) return age.receipt;
  const int64_t owners = gate_.owners();
  const Receipt receipt = gate_.admit(arrival.sender, topic, stamp, arrival.now_us);
  if (gate_.owners() != owners) drop_all();  // what the owner before wanted is wanted no more
  if (receipt == Receipt::accepted)
    until_us_.at(static_cast<size_t>(topic)) = arrival.now_us - age.age_us + silence_us_;
  return receipt;
}

void CommandStream::tick(int64_t now_us, int64_t system_us) {
  if (ages_.tick(now_us, system_us)) begin_anew();
}

bool CommandStream::is_current(int topic, int64_t now_us) const {
  const std::optional<int64_t>& until_us = until_us_.at(static_cast<size_t>(topic));
  return until_us && now_us <= *until_us;
}

bool CommandStream::is_current(int64_t now_us) const {
  for (size_t topic = 0; topic < until_us_.size(); ++topic)
    if (is_current(static_cast<int>(topic), now_us)) return true;
  return false;
}

void CommandStream::drop_all() {
  until_us_.assign(until_us_.size(), std::nullopt);
}

void CommandStream::begin_anew() {
  ++gaps_;
  gate_.release();
  drop_all();
}

}  // namespace glovebench
