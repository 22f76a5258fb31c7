#pragma once

#include <string>

#include "core/base/file.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// One command as one line of JSON, without the line end; the keys are documented in core/robot/README.md.
/// Numbers are rounded to 1e-6 of their unit, so equal commands are equal bytes. Throws Error if one is not finite.
std::string to_json_line(const RobotCommand& command);

/// Writes commands as JSON Lines, each as it comes, to a temporary file: the file itself appears whole at `finish`,
/// or not at all. Every function throws Error if the disk has no room.
class JsonLinesSink : public RobotCommandSink {
 public:
  explicit JsonLinesSink(const std::string& path) : file_(path) {}
  void send(const RobotCommand& command) override;
  void finish() override;

 private:
  WholeFile file_;
};

}  // namespace glovebench
