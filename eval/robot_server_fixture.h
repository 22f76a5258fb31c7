#pragma once

// The servers of hand and arm as processes on a bus of their own, and what every log of theirs must keep to.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/angles.h"
#include "core/base/file.h"
#include "core/robot/arm_follower.h"
#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "eval/dds_test_bus.h"

namespace glovebench::eval {

class RobotServer : public DdsBus {
 protected:
  using json = nlohmann::json;
  StartedProgram serve(const std::string& side, const std::string& log, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {GLOVEBENCH_PROGRAM, "robot-server", side, "--robot",
                                        "dds:" + domain_,   "--log",        log};
    command.insert(command.end(), more.begin(), more.end());
    return start(command);
  }
  /// A server that has begun, as its log shows.
  StartedProgram serve_until_ready(const std::string& side, const std::string& log,
                                   const std::vector<std::string>& more = {}) {
    const size_t before = std::filesystem::exists(log) ? std::filesystem::file_size(log) : 0;
    const StartedProgram server = serve(side, log, more);
    EXPECT_TRUE(
        comes_true([&] { return std::filesystem::exists(log) && std::filesystem::file_size(log) > before; }));
    return server;
  }

  static std::string joints(const std::vector<std::string>& names, double angle_deg) {
    std::string text;
    for (const std::string& name : names) text += fmt::format(" {}={}", name, radians_from_degrees(angle_deg));
    return text + "\n";
  }
  static std::string fingers(double angle_deg, int sec, int points = 1) {
    return fmt::format("hand {} 0 {}", sec, points) + joints(hand_trajectory_names(), angle_deg);
  }
  static std::string wrist(double angle_deg, int sec) {
    return fmt::format("wrist {} 0 1", sec) + joints(wrist_trajectory_names(), angle_deg);
  }

  static std::vector<json> lines(const std::string& log, const std::string& event) {
    std::vector<json> found;
    std::istringstream all(read_file(log));
    for (std::string line; std::getline(all, line);) {
      json parsed = json::parse(line, nullptr, false);  // a kill may have cut one
      if (!parsed.is_discarded() && parsed.at("event") == event) found.push_back(std::move(parsed));
    }
    return found;
  }
  static int64_t received(const std::string& log, const std::string& topic, const std::string& receipt) {
    const std::vector<json> all = lines(log, "received");
    return std::ranges::count_if(
        all, [&](const json& line) { return line.at("topic") == topic && line.at("receipt") == receipt; });
  }
  static double last_angle(const std::string& log, const std::string& joint) {
    return lines(log, "state").back().at("position_deg").at(joint).get<double>();
  }
  /// rad/s: what the guard grants a joint of the hand, or the arm's own.
  static double speed(const std::string& joint) {
    for (const ArmJointInfo& info : arm_joint_infos())
      if (info.name == joint) return radians_from_degrees(info.max_speed_deg_s);
    return CommandLimits().hand_joint_speed;
  }
  /// From one state to the next no joint moves farther than its speed allows, also not across a restart.
  static void expect_safe(const std::string& log) {
    constexpr double kRounded = 3e-6;      // degrees: two angles of a log
    constexpr double kLongestStepS = 0.1;  // what the guard takes as the time of one step, at most
    const std::vector<json> states = lines(log, "state");
    ASSERT_GE(states.size(), 2U);
    for (size_t i = 1; i < states.size(); ++i) {
      const auto clock_us = [&](size_t at) { return states[at].at("clock_us").get<int64_t>(); };
      ASSERT_GT(clock_us(i), clock_us(i - 1));
      const double seconds = std::min(1e-6 * static_cast<double>(clock_us(i) - clock_us(i - 1)), kLongestStepS);
      for (const auto& [name, angle] : states[i].at("position_deg").items()) {
        const double way_deg =
            std::abs(angle.get<double>() - states[i - 1].at("position_deg").at(name).get<double>());
        ASSERT_LE(way_deg, degrees_from_radians(speed(name) * seconds) + kRounded) << name << " in state " << i;
      }
    }
  }
};

class RobotServerLong : public RobotServer {};

}  // namespace glovebench::eval
