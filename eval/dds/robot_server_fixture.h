#pragma once

// Runs robot servers as processes and checks their logs.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "ci/build_paths.h"
#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/dds_entity.h"
#include "core/adapters/system_time.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/robot/arm.h"
#include "core/robot/command_limits.h"
#include "eval/dds/test_programs.h"

namespace glovebench::eval {

/// A robot whose joints follow the server at once.
class SimulatedRobot {
 public:
  explicit SimulatedRobot(int domain)
      : participant_(domain),
        told_(DdsReader<ros::JointState>::of_others(participant_, topics::kOwn.joint_states)),
        measured_(participant_, topics::kMeasuredJointStates),
        thread_([this] { run(); }) {}
  ~SimulatedRobot() {
    ending_ = true;
    thread_.join();
  }
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

 private:
  void run() {
    std::map<std::string, double> positions;
    while (!ending_) {
      while (const auto received = told_.take([](uint64_t) { return true; }))
        for (size_t j = 0; received->message && j < received->message->name.size(); ++j)
          positions[received->message->name[j]] = received->message->position.at(j);
      const int64_t now_us = system_us();
      ros::JointState state{ros_time(now_us), {}, {}, {}};
      for (const auto& [name, position] : positions) {
        state.name.push_back(name);
        state.position.push_back(position);
      }
      if (!positions.empty()) measured_.write(state, now_us * 1000);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  DdsParticipant participant_;
  DdsReader<ros::JointState> told_;
  DdsWriter<ros::JointState> measured_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

class RobotServer : public DdsBus {
 protected:
  using json = nlohmann::json;
  /// `sides`: "hand", "arm" or "hand and arm".
  StartedProgram serve(const std::string& sides, const std::string& log, const std::vector<std::string>& more = {},
                       const ProgramSetting& setting = {}) {
    std::vector<std::string> command = {
        build_paths::program("glovebench"), "robot-server", "run", "--robot", "dds:" + domain_, "--log", log};
    for (const std::string side : {"hand", "arm"})
      if (sides.find(side) != std::string::npos) command.push_back("--" + side);
    command.insert(command.end(), more.begin(), more.end());
    return start(command, setting);
  }
  StartedProgram serve_until_ready(const std::string& sides, const std::string& log,
                                   const std::vector<std::string>& more = {}, const ProgramSetting& setting = {}) {
    const size_t before = std::filesystem::exists(log) ? std::filesystem::file_size(log) : 0;
    const StartedProgram server = serve(sides, log, more, setting);
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
      json parsed = json::parse(line, nullptr, false);  // a kill may have cut it
      if (!parsed.is_discarded() && parsed.at("event") == event) found.push_back(std::move(parsed));
    }
    return found;
  }
  /// Null if there is none.
  static json last_line(const std::string& log, const std::string& event) {
    const std::vector<json> found = lines(log, event);
    return found.empty() ? json() : found.back();
  }
  static int64_t received(const std::string& log, const std::string& topic, const std::string& receipt) {
    const std::vector<json> all = lines(log, "received");
    return std::ranges::count_if(
        all, [&](const json& line) { return line.at("topic") == topic && line.at("receipt") == receipt; });
  }
  /// Valid messages: followed, at a start, or late.
  static int64_t good(const std::string& log, const std::string& topic) {
    return received(log, topic, "accepted") + received(log, topic, "starting") + received(log, topic, "stale");
  }
  static bool had_gaps(const ProgramRun& run) { return run.out.find("; gaps: ") != std::string::npos; }
  /// NaN before the first state.
  static double last_angle(const std::string& log, const std::string& joint) {
    const json state = last_line(log, "state");
    return state.is_null() ? std::nan("") : state.at("position_deg").at(joint).get<double>();
  }
  /// The guard's for hand joints, else the arm's.
  /// Units: rad/s.
  static double speed(const std::string& joint) {
    for (const ArmJointInfo& info : arm_joint_infos())
      if (info.name == joint) return radians_from_degrees(info.max_speed_deg_s);
    return CommandLimits().hand_joint_speed;
  }
  /// Checks that joints keep their speeds and the last logged interval, also across a restart.
  static void expect_safe(const std::string& log) {
    constexpr double kRounded = 3e-6;      // degrees, two logged angles
    constexpr double kLongestStepS = 0.1;  // that the guard assumes
    json last, interval;
    bool started = false;
    int states = 0;
    std::istringstream all(read_file(log));
    for (std::string line; std::getline(all, line);) {
      const json event = json::parse(line, nullptr, false);
      if (event.is_discarded()) continue;
      if (event.at("event") == "interval") interval = event;
      if (event.at("event") == "start") started = true;
      if (event.at("event") != "state") continue;
      const double seconds =
          last.is_null() ? 0 : 1e-6 * (event.at("clock_us").get<double>() - last.at("clock_us").get<double>());
      ASSERT_TRUE(last.is_null() || seconds > 0) << "in state " << states;
      for (const auto& [name, angle] : event.at("position_deg").items()) {
        const double angle_deg = angle.get<double>();
        if (!interval.is_null()) {
          ASSERT_GE(angle_deg, interval.at("min_deg").at(name).get<double>() - kRounded) << name << states;
          ASSERT_LE(angle_deg, interval.at("max_deg").at(name).get<double>() + kRounded) << name << states;
        }
        if (last.is_null() || started) continue;  // a kill loses the last lines
        const double way_deg = std::abs(angle_deg - last.at("position_deg").at(name).get<double>());
        ASSERT_LE(way_deg, degrees_from_radians(speed(name) * std::min(seconds, kLongestStepS)) + kRounded)
            << name << " in state " << states;
      }
      last = event;
      started = false;
      ++states;
    }
    ASSERT_GE(states, 2);
  }
};

}  // namespace glovebench::eval
