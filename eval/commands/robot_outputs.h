#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/adapters/dds/robot_bus.h"
#include "core/robot/command_guard.h"
#include "core/robot/json_lines_sink.h"
#include "core/robot/robot_command.h"
#include "eval/commands/options.h"

namespace glovebench::eval {

/// How a program takes part in the robot's middleware.
struct BusFlags {
  std::string middleware;  ///< "dds" (domain 0) or "dds:DOMAIN"; empty: not at all
  std::string interface;   ///< empty: loopback, or what CYCLONEDDS_URI says
  std::string security;    ///< folder of keys; empty: without

  /// `--robot`, `--robot-interface` and `--security`.
  void add(Command command, const std::string& what);
  /// Throws Error naming `--robot` unless it names a domain.
  int domain() const;
  DdsAccess access(const std::string& role) const { return {interface, security, role}; }
};

/// Sends robot commands to a file, over a middleware, both, or nowhere.
class RobotOutputs {
 public:
  /// `file`: JSON Lines; empty: none. Throws Error as `join_robot_bus` does, or if the file cannot be written.
  RobotOutputs(const std::string& file, const std::optional<RobotBusOptions>& bus);

  bool any() const { return file_ || bus_; }
  /// Where the arm stood at the start; empty unless a controller's arm is spoken to.
  std::optional<ArmJoints> arm_start() const { return bus_ ? bus_->arm_start() : std::nullopt; }
  /// Sends what the guard lets pass of a command. What goes to a robot is guarded by the clock of the wall,
  /// whatever the stamps of its frames say: its time stamp is that of the first frame plus the time since then. On
  /// a controller's topics each motion after a lost hand, the first one too, starts where the robot is measured to
  /// stand now. `arrived_us`: when the frame was there, microseconds since 1970. Throws Error, also if the robot is
  /// not measured.
  void send(CommandGuard& guard, const RobotCommand& command, int64_t arrived_us);
  /// No more commands follow. The file gets its name if the session is `whole`; else its lines stay where `kept`
  /// says, and an older file stays. Throws Error.
  void finish(bool whole = true);
  /// Lines that are not under the file's own name, and where they are; empty if there are none.
  std::string kept() const { return file_ ? file_->kept() : ""; }

 private:
  std::unique_ptr<JsonLinesSink> file_;
  std::unique_ptr<RobotBus> bus_;
};

}  // namespace glovebench::eval
