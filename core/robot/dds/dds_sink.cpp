#include "core/robot/dds/dds_sink.h"

#include <algorithm>
#include <utility>

#include "core/robot/server/command_messages.h"

namespace glovebench {
namespace {

constexpr int64_t kFirstPeriodUs = 33'333;  // of a Kinect
constexpr int64_t kShortestPeriodUs = 1'000, kLongestPeriodUs = 100'000;
constexpr double kFarewell = 1;  // s

}  // namespace

DdsSink::DdsSink(int domain, const DdsSinkOptions& options)
    : participant_(domain, options.access),
      hand_(participant_, options.topics.hand),
      wrist_(participant_, options.topics.wrist),
      period_us_(kFirstPeriodUs) {
  if (options.arm) arm_.emplace(participant_, options.topics.arm);
}

void DdsSink::send(const RobotCommand& command) {
  const int64_t source_ns = std::exchange(arrived_ns_, std::nullopt).value_or(dds_time());
  const int64_t period_us = next_period(command.timestamp_us);
  // What is sent is to be followed: a lost hand is silence, at which a server holds and then stops.
  if (command.hold || !command.targets) return;
  hand_.write(hand_message(command, period_us), source_ns);
  wrist_.write(wrist_message(command, period_us), source_ns);
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

/// What lay between the last two commands, which the guard took as the time of the step: by then the targets shall
/// be reached.
int64_t DdsSink::next_period(int64_t command_us) {
  if (command_us_) period_us_ = std::clamp(command_us - *command_us_, kShortestPeriodUs, kLongestPeriodUs);
  command_us_ = command_us;
  return period_us_;
}

}  // namespace glovebench
