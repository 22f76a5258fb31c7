#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/adapters/dds/server/log_writer.h"
#include "core/adapters/dds/server/server_log.h"
#include "core/adapters/dds/server/stated_interval.h"

namespace glovebench {

struct LoggedStart {
  std::vector<double> joints;  ///< rad
  std::string source;
  std::string from;   ///< `rest` or `log`
  std::string doubt;  ///< why the joints must be measured; empty: the log suffices
  std::string age;    ///< of the last state; empty at rest
};

/// A server's log (core/adapters/dds/README.md, "The log"). Never delays the server.
class MotionLog {
 public:
  /// `path`: empty for no file.
  /// Throws: Error if it cannot be opened or another server has it.
  MotionLog(const std::string& path, std::vector<std::string> names, std::vector<JointMotion> joints);

  /// The joints in the log's last state, else `rest`. `period_s`: time between ticks.
  /// Throws: Error if the log has other joints, is too old or lacks its end.
  LoggedStart start(const std::vector<double>& rest, int64_t now_us, double max_age_s, double period_s) const;

  /// `time_us`: system time.
  void started(int64_t time_us, std::string_view from);
  void received(const ReceivedLine& line);
  /// `at_rest`: no joint moves until a new start.
  void ticked(const RobotState& its, int64_t time_us, bool at_rest);
  /// Records that the joints stay in place.
  void finish(const RobotState& its, int64_t time_us);

  /// True if the joints may move freely for `seconds`.
  bool may_move(const std::vector<double>& positions, double seconds);
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
  std::unique_ptr<LogWriter> writer_;  ///< empty without a file
  int64_t accepted_left_, refused_left_;
  int64_t heartbeat_us_ = 0;
  RobotState last_;
};

}  // namespace glovebench
