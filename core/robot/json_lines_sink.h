#pragma once

#include <string>

#include "core/robot/robot_command.h"

namespace glovebench {

/// One command as one line of JSON, without the line end; the keys are documented in core/robot/README.md.
/// Numbers are rounded to 1e-6 of their unit, so equal commands are equal bytes. Throws Error if one is not finite.
std::string to_json_line(const RobotCommand& command);

/// Collects commands and writes them as JSON Lines. The file appears whole at `finish`, or not at all.
class JsonLinesSink : public RobotCommandSink {
 public:
  explicit JsonLinesSink(std::string path) : path_(std::move(path)) {}
  void send(const RobotCommand& command) override;
  void finish() override;

 private:
  std::string path_;
  std::string lines_;
};

}  // namespace glovebench
