#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/adapters/dds/robot_bus.h"
#include "core/robot/command_guard.h"
#include "core/robot/robot_command.h"
#include "eval/commands/options.h"

namespace glovebench::eval {

struct BusFlags {
  std::string middleware;  ///< "dds" (domain 0), "dds:DOMAIN" or "" (none)
  std::string interface;   ///< empty: that of CYCLONEDDS_URI, else loopback
  std::string security;    ///< folder of keys; empty: none

  void add(Command command, const std::string& what);
  /// Throws: Error if `--robot` names no domain.
  int domain() const;
  DdsAccess access(const std::string& role) const { return {interface, security, role}; }
};

class RobotOutputs {
 public:
  /// `file`: JSON Lines; empty: none.
  /// Throws: Error.
  RobotOutputs(const std::string& file, const std::optional<RobotBusOptions>& bus);

  bool any() const { return file_ || bus_; }
  /// Empty without a controller.
  std::optional<ArmJoints> arm_start() const { return bus_ ? bus_->arm_start() : std::nullopt; }
  /// Guards and sends a command. On a bus, time is the first frame's stamp plus wall time. With a controller,
  /// motion starts at the measured joints, also after a lost hand. `arrived_us`: when the frame arrived, since
  /// 1970.
  /// Throws: Error, also without measured joints.
  void send(CommandGuard& guard, const RobotCommand& command, int64_t arrived_us);
  /// `whole`: renames the file to its final name. Otherwise lines stay at `kept()`, and an older file remains.
  /// Throws: Error.
  void finish(bool whole = true);
  /// Path of unfinished lines, if any.
  std::string kept() const { return file_ ? file_->kept() : ""; }

 private:
  std::unique_ptr<JsonLinesSink> file_;
  std::unique_ptr<RobotBus> bus_;
};

}  // namespace glovebench::eval
