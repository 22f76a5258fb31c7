#pragma once

#include <string>

#include "core/base/line_file.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// A command as a line of JSON (core/robot/command.schema.json) without line end, rounded to 1e-6 of each unit.
/// Throws: Error if a number is not finite.
std::string to_json_line(const RobotCommand& command);

/// Writes commands to a LineFile.
/// Throws: Error, from every function, if the disk is full.
class JsonLinesSink : public RobotCommandSink {
 public:
  explicit JsonLinesSink(const std::string& path) : file_(path) {}
  void send(const RobotCommand& command) override;
  void finish() override { file_.finish(); }
  /// As LineFile::kept.
  std::string kept() const { return file_.kept(); }

 private:
  LineFile file_;
};

}  // namespace glovebench
