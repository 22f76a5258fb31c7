#include "core/robot/dds/measured_joints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/robot/server/command_messages.h"

namespace glovebench {
namespace {

constexpr int kDepth = 100;               // messages that wait: those of other joints push none out for long
constexpr int64_t kTellerUs = 1'000'000;  // a process that was silent for longer tells no more
constexpr size_t kMostTellers = 16;       // two are too many already

std::string seconds(int64_t us) {
  return fmt::format("{:.2f} s", static_cast<double>(us) * 1e-6);
}

/// Empty if a time is at most kMeasuredAgeUs from now.
std::string age_fault(const char* what, int64_t then_us, int64_t now_us) {
  if (now_us - then_us > kMeasuredAgeUs)
    return fmt::format("a state that is {} old by {}", seconds(now_us - then_us), what);
  if (then_us - now_us > kMeasuredAgeUs)
    return fmt::format("a state that is {} in the future by {}", seconds(then_us - now_us), what);
  return "";
}

}  // namespace

MeasuredJoints::MeasuredJoints(const DdsParticipant& participant, const std::string& topic,
                               std::vector<std::string> names)
    : topic_(topic),
      names_(std::move(names)),
      reader_(DdsReader<ros::JointState>::of_others(participant, topic, kDepth)) {}

MeasuredJoints::State MeasuredJoints::read(const ros::JointState& message) const {
  State state;
  if (message.stamp.sec != 0 || message.stamp.nanosec != 0) state.stamp_us = nanoseconds(message.stamp) / 1000;
  if (message.position.size() != message.name.size()) {
    state.fault = fmt::format("{} positions of {} joints", message.position.size(), message.name.size());
    return state;
  }
  std::vector<std::string> missing;
  for (const std::string& name : names_) {
    const auto found = std::ranges::find(message.name, name);
    if (found == message.name.end()) {
      missing.push_back(name);
      continue;
    }
    const double position = message.position[static_cast<size_t>(found - message.name.begin())];
    if (std::find(found + 1, message.name.end(), name) != message.name.end()) {
      state.fault = fmt::format("{} twice", name);
    } else if (!std::isfinite(position)) {
      state.fault = fmt::format("{} at {}", name, position);
    }
    state.positions.push_back(position);
  }
  if (!missing.empty()) state.fault = fmt::format("a state without {}", fmt::join(missing, ", "));
  return state;
}

void MeasuredJoints::take_all(int64_t steady_us) {
  std::erase_if(tellers_, [&](const auto& teller) { return steady_us - teller.second > kTellerUs; });
  for (int i = 0; i < kDepth; ++i) {
    const auto received = reader_.take([](uint64_t) { return true; });
    if (!received) return;
    if (!received->message) continue;
    const ros::JointState& message = *received->message;
    if (std::ranges::find_first_of(message.name, names_) == message.name.end()) continue;
    if (tellers_.contains(received->sender) || tellers_.size() < kMostTellers)
      tellers_[received->sender] = steady_us;
    state_ = read(message);
    state_->source_us = received->source_ns / 1000;
    state_->taken_us = steady_us;
  }
}

std::string MeasuredJoints::find_doubt(int64_t system_us, int64_t steady_us) const {
  if (!state_) return "nothing of them";
  if (tellers_.size() > 1) return fmt::format("{} processes that tell of them", tellers_.size());
  if (!state_->fault.empty()) return state_->fault;
  if (steady_us - state_->taken_us > kMeasuredAgeUs)
    return fmt::format("nothing new for {}", seconds(steady_us - state_->taken_us));
  std::string fault = age_fault("its source time", state_->source_us, system_us);
  if (fault.empty() && state_->stamp_us) fault = age_fault("its stamp", *state_->stamp_us, system_us);
  return fault;
}

std::optional<std::vector<double>> MeasuredJoints::latest(int64_t system_us, int64_t steady_us) {
  take_all(steady_us);
  doubt_ = find_doubt(system_us, steady_us);
  if (!doubt_.empty()) return std::nullopt;
  return state_->positions;
}

}  // namespace glovebench
