#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/adapters/dds/server/log_writer.h"
#include "core/adapters/dds/server/server_log.h"
#include "core/adapters/dds/server/stated_interval.h"

namespace glovebench {

/// Where a log says the joints are.
struct LoggedStart {
  std::vector<double> joints;  ///< rad
  std::string source;          ///< who says so
  std::string from;            ///< `rest` or `log`, as start_line has it
  std::string doubt;           ///< why only a measured state can tell where they are; empty if the log can
  std::string age;             ///< of the log's last state, for a person; empty at rest
};

/// The log of a server that runs. It never makes its server wait, no flood fills it, and with it the joints move
/// only inside of what it has stated on the disk. Without a file nothing is written and everything may move.
class MotionLog {
 public:
  /// `path`: empty for no file. Throws Error if it cannot be opened or another server has it.
  MotionLog(const std::string& path, std::vector<std::string> names, std::vector<JointMotion> joints);

  /// Where the joints shall start: where the last server left them, or at `rest` if there was none. `period_s`: of
  /// the server's steps. Throws Error if the log is none of these joints, too old or has lost its end.
  LoggedStart start(const std::vector<double>& rest, int64_t now_us, double max_age_s, double period_s) const;

  /// Of every event; `time_us`: of the system's clock.
  void started(int64_t time_us, std::string_view from);
  void received(const ReceivedLine& line);
  /// Of every tick. `at_rest`: the joints stay until a new start.
  void ticked(const RobotState& state, int64_t time_us, bool at_rest);
  /// The end: the joints stay where they are.
  void finish(const RobotState& state, int64_t time_us);

  /// Whether the joints may do whatever they can in that time.
  bool may_move(const std::vector<double>& positions, double seconds);
  /// Lines that could not be written, and why the first of them.
  int64_t lost() const { return writer_ ? writer_->progress().lost : 0; }
  std::string failure() const { return writer_ ? writer_->progress().failure : ""; }

 private:
  void state(const RobotState& state, int64_t time_us);
  void interval(const std::vector<double>& positions, bool at_rest, int64_t clock_us, int64_t time_us);
  void update();

  std::string path_;
  std::vector<std::string> names_;
  std::vector<JointMotion> joints_;
  StatedInterval stated_;
  std::unique_ptr<LogWriter> writer_;  ///< none without a file
  int64_t accepted_left_, refused_left_;
  int64_t heartbeat_us_ = 0;
  RobotState last_;
};

}  // namespace glovebench
