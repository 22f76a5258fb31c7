#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/robot/json_lines_sink.h"

namespace glovebench::eval {

/// The domain of "dds" (0) or "dds:DOMAIN". Throws Error naming `option` for anything else, or if the program was
/// built without Cyclone DDS.
int dds_domain(const std::string& middleware, const std::string& option);

/// Where the robot commands of a run go: to a file, over a middleware, both, or nowhere.
class RobotOutputs {
 public:
  /// Either may be empty. Throws Error: an unknown middleware, one that the build lacks, no network.
  RobotOutputs(const std::string& file, const std::string& middleware);
  ~RobotOutputs();

  bool any() const { return file_ || stream_; }
  /// `arrived_us`: when the frame was there, microseconds since 1970. Throws Error.
  void send(const RobotCommand& command, int64_t arrived_us);
  /// No more commands follow. The file gets its name if the session is `whole`; else its lines stay where `kept`
  /// says, and an older file stays. Throws Error.
  void finish(bool whole = true);
  /// Lines that are not under the file's own name, and where they are; empty if there are none.
  std::string kept() const { return file_ ? file_->kept() : ""; }

 private:
  class Stream;
  std::unique_ptr<JsonLinesSink> file_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace glovebench::eval
