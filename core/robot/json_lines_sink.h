#pragma once

#include <string>

#include "core/base/line_file.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// One command as one line of JSON, without the line end; core/robot/command.schema.json documents the keys.
/// Numbers are rounded to 1e-6 of their unit, so equal commands are equal bytes. Throws Error if one is not finite.
std::string to_json_line(const RobotCommand& command);

/// Writes commands as JSON Lines, each as it comes, as LineFile does: `finish` gives the file its name, and without
/// it the lines stay in PATH.partial. Every function throws Error if the disk has no room.
class JsonLinesSink : public RobotCommandSink {
 public:
  explicit JsonLinesSink(const std::string& path) : file_(path) {}
  void send(const RobotCommand& command) override;
  void finish() override { file_.finish(); }
  /// Lines that are not under the file's own name, and where they are; empty if there are none.
  std::string kept() const { return file_.kept(); }

 private:
  LineFile file_;
};

}  // namespace glovebench
