#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/angles.h"
#include "core/robot/server/hand_server.h"
#include "core/robot/test_fingertips.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

namespace {

/// Values from the input; zeros when it has ended.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : data_(data), left_(size) {}
  bool empty() const { return left_ == 0; }
  template <typename Value>
  Value get() {
    Value value{};
    const size_t size = std::min(sizeof value, left_);
    std::memcpy(&value, data_, size);
    data_ += size;
    left_ -= size;
    return value;
  }

 private:
  const uint8_t* data_;
  size_t left_;
};

/// A message that is right but for what the input changes.
ros::JointTrajectory message_from(Input& input, const std::vector<std::string>& names) {
  ros::JointTrajectory message;
  message.stamp = {input.get<int32_t>(), input.get<uint32_t>()};
  message.joint_names = names;
  message.points.push_back({std::vector<double>(names.size(), input.get<double>()), {0, input.get<uint32_t>()}});
  const uint8_t change = input.get<uint8_t>();
  const size_t at = input.get<uint8_t>() % names.size();
  if (change & 1) message.joint_names[at] = names[input.get<uint8_t>() % names.size()];
  if (change & 2) message.points[0].positions[at] = input.get<double>();
  if (change & 4) message.points[0].positions.resize(input.get<uint8_t>());
  if (change & 8) message.joint_names.resize(input.get<uint8_t>());
  if (change & 16) message.points.resize(input.get<uint8_t>() % 4, message.points[0]);
  return message;
}

}  // namespace

/// A hand's server with any messages at any times: it never moves faster or farther than its limits, nor J1 without
/// J2.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const CommandLimits limits;
  std::vector<double> last(kShadowJointCount, 0.0);
  HandServer server(limits, last);
  Input input(data, size);
  int64_t now_us = 0;
  while (!input.empty()) {
    const uint8_t action = input.get<uint8_t>();
    if (action % 3 != 0) {
      const bool wrist = action % 3 == 2;
      server.receive(action / 3 % 4, wrist ? HandTopic::wrist : HandTopic::fingers,
                     message_from(input, wrist ? wrist_trajectory_names() : hand_trajectory_names()), now_us);
      continue;
    }
    const int64_t elapsed_us = 1 + input.get<uint16_t>() * (action & 128 ? 100 : 1);
    now_us += elapsed_us;
    const RobotState state = server.tick(now_us);
    const double seconds = std::min(static_cast<double>(elapsed_us) * 1e-6, limits.longest_step_s);
    for (size_t j = 0; j < last.size(); ++j) {
      const ShadowJointInfo& info = shadow_joint_infos()[j];
      const double position = state.position[j];
      check(position >= radians_from_degrees(info.min_deg) && position <= radians_from_degrees(info.max_deg),
            "a joint keeps its limits");
      check(std::abs(position - last[j]) <= limits.hand_joint_speed * seconds + 1e-12, "a joint keeps its speed");
    }
    std::array<double, kShadowJointCount> before, after;
    std::ranges::copy(last, before.begin());
    std::ranges::copy(state.position, after.begin());
    const TestFingertips::Tips way = TestFingertips(after).in_forearm() - TestFingertips(before).in_forearm();
    check(way.colwise().norm().maxCoeff() <= limits.fingertip_speed * seconds * (1 + 1e-9) + 1e-9,
          "a fingertip keeps its speed");
    for (const int j1 : {kFFJ1, kMFJ1, kRFJ1, kLFJ1})
      check(std::abs(after[j1] - std::max(0.0, after[j1] + after[j1 + 1] - radians_from_degrees(90))) < 1e-12,
            "J1 and J2 are as their motor moves them");
    last = state.position;
  }
  return 0;
}
