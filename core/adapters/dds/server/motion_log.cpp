#include "core/adapters/dds/server/motion_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/math.h"

namespace glovebench {
namespace {

constexpr int64_t kHeartbeatUs = 1'000'000;  // a state in the log even if nothing moves
constexpr int64_t kLinesPerSecond = 500;     // of messages, accepted and refused each: a flood fills no disk
constexpr uint64_t kTailBytes = 1 << 20;     // seconds of the fullest log

double widest_deg(const JointInterval& interval) {
  double widest = 0;
  for (size_t j = 0; j < interval.min.size(); ++j) widest = std::max(widest, interval.max[j] - interval.min[j]);
  return degrees_from_radians(widest);
}

/// Intervals are rounded outwards, so a state inside is still inside.
bool holds(const JointInterval& interval, const std::vector<double>& positions) {
  for (size_t j = 0; j < positions.size(); ++j)
    if (!(positions[j] >= interval.min[j] && positions[j] <= interval.max[j])) return false;
  return true;
}

}  // namespace

MotionLog::MotionLog(const std::string& path, std::vector<std::string> names, std::vector<JointMotion> joints)
    : path_(path),
      names_(std::move(names)),
      joints_(joints),
      stated_(std::move(joints)),
      writer_(path.empty() ? nullptr : std::make_unique<LogWriter>(path)),
      accepted_left_(kLinesPerSecond),
      refused_left_(kLinesPerSecond) {}

LoggedStart MotionLog::start(const std::vector<double>& rest, int64_t now_us, double max_age_s,
                             double period_s) const {
  LoggedStart start{rest, "posture at rest", "rest", "", ""};
  if (!writer_) return start;
  const std::string tail = read_tail(path_, kTailBytes);
  const std::optional<LoggedState> last = last_state(tail, names_, path_);
  const std::optional<JointInterval> interval = last_interval(tail, names_, path_);
  // Joints move only after a state and an interval are written, so no server with this log has moved any.
  if (!last && !interval && tail.size() < kTailBytes) return start;
  start.source = path_;
  start.from = "log";
  if (!last || !interval)
    start.doubt = "the log does not say within which limits the joints were";
  else if (!is_one_step(*interval, joints_, period_s))
    start.doubt = fmt::format("the log says only within {:.1f} degrees where a joint was", widest_deg(*interval));
  else if (!holds(*interval, last->positions))
    start.doubt = "the log's last state is outside of its last interval";
  if (!last) return start;
  if (start.doubt.empty()) {  // else the joints are measured, and the log's state does not matter
    check_age(*last, now_us, max_age_s, path_);
    check_whole(*last, changed_us(path_), path_);
  }
  start.age = age_text(*last, now_us);
  start.joints = last->positions;
  return start;
}

void MotionLog::started(int64_t time_us, std::string_view from) {
  if (writer_) writer_->push(start_line(time_us, from));
}

void MotionLog::received(const ReceivedLine& line) {
  int64_t& left = line.receipt == Receipt::accepted ? accepted_left_ : refused_left_;
  if (writer_ && left-- > 0) writer_->push(received_line(line));
}

void MotionLog::state(const RobotState& state, int64_t time_us) {
  writer_->push(state_line(state, time_us, names_));
  last_ = state;
}

void MotionLog::interval(const std::vector<double>& positions, bool at_rest, int64_t clock_us, int64_t time_us) {
  std::optional<JointInterval> next = stated_.next(positions, at_rest, clock_us);
  if (!next) return;
  const uint64_t line = writer_->push(interval_line(*next, time_us, names_), true);
  stated_.stated(std::move(*next), line, clock_us);
}

void MotionLog::update() {
  const LogWriter::Progress progress = writer_->progress();
  stated_.update(progress.done, progress.durable, progress.failed);
}

void MotionLog::ticked(const RobotState& its, int64_t time_us, bool at_rest) {
  if (!writer_) return;
  const bool heartbeat = its.clock_us - heartbeat_us_ >= kHeartbeatUs;
  if (heartbeat) {
    accepted_left_ = refused_left_ = kLinesPerSecond;
    heartbeat_us_ = its.clock_us;
  }
  if (heartbeat || its.position != last_.position || its.state != last_.state) state(its, time_us);
  update();
  interval(its.position, at_rest, its.clock_us, time_us);
}

void MotionLog::finish(const RobotState& its, int64_t time_us) {
  if (!writer_) return;
  if (its.clock_us != last_.clock_us) state(its, time_us);
  writer_->push(interval_line({its.position, its.position}, time_us, names_), true);
  writer_->finish();
}

bool MotionLog::may_move(const std::vector<double>& positions, double seconds) {
  if (!writer_) return true;
  update();
  return !writer_->progress().misplaced && stated_.allows(positions, seconds);
}

}  // namespace glovebench
