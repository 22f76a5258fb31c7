#include "core/adapters/dds/dds_sink.h"

#include <algorithm>
#include <utility>

#include "core/adapters/dds/command_messages.h"

namespace glovebench {
namespace {

constexpr double kFarewell = 1;  // s

std::optional<DdsOtherWriters> watch_others(const DdsParticipant& participant, const DdsSinkOptions& options) {
  if (!options.alone) return std::nullopt;
  std::vector<std::string> topics = {options.topics.hand, options.topics.wrist};
  if (options.arm) topics.emplace_back(options.topics.arm);
  return DdsOtherWriters(participant, topics);
}

}  // namespace

DdsSink::DdsSink(int domain, const DdsSinkOptions& options)
    : participant_(domain, options.access),
      others_(watch_others(participant_, options)),
      hand_(participant_, options.topics.hand),
      wrist_(participant_, options.topics.wrist),
      time_to_targets_us_(time_to_targets_us(options.longest_step_s)) {
  if (options.arm) arm_.emplace(participant_, options.topics.arm);
}

void DdsSink::send(const RobotCommand& command) {
  const int64_t source_ns = std::exchange(arrived_ns_, std::nullopt).value_or(dds_time());
  // A lost frame sends nothing: at silence a server holds and then stops.
  if (command.hold || !command.targets) return;
  if (others_) others_->refuse();
  hand_.write(hand_message(command, time_to_targets_us_), source_ns);
  wrist_.write(wrist_message(command, time_to_targets_us_), source_ns);
  if (arm_) arm_->write(pose_message(command), source_ns);
  ++sent_;
}

void DdsSink::finish() {
  const int64_t end_ns = dds_time() + static_cast<int64_t>(kFarewell * 1e9);
  const auto left_s = [&] { return std::max(0.0, static_cast<double>(end_ns - dds_time()) * 1e-9); };
  hand_.wait_for_listeners(left_s());
  wrist_.wait_for_listeners(left_s());
  if (arm_) arm_->wait_for_listeners(left_s());
}

int DdsSink::listeners() const {
  const int of_hand = std::min(hand_.listeners(), wrist_.listeners());
  return arm_ ? std::min(of_hand, arm_->listeners()) : of_hand;
}

}  // namespace glovebench
