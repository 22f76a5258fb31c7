#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace glovebench {

/// What a joint can do.
struct JointMotion {
  double min = 0, max = 0;  ///< rad
  double speed = 0;         ///< rad/s
};

/// Where each joint may be, rad.
struct JointInterval {
  std::vector<double> min, max;

  bool operator==(const JointInterval&) const = default;
};

/// Whether an interval is no wider than the way of one step of that time, for each joint; 1e-5 degrees more are
/// what a log's rounding adds.
bool is_one_step(const JointInterval& interval, const std::vector<JointMotion>& joints, double seconds);

/// What a log states in advance about the joints, and what they may do by that. A statement holds until a later one
/// is on the disk. Whatever may be the last statement on the disk after a crash, the joints are inside it: inside
/// the last one that is surely there, the one that is being written, and those of which writing failed.
/// Reads no clock and writes nothing.
class StatedInterval {
 public:
  explicit StatedInterval(std::vector<JointMotion> joints) : joints_(std::move(joints)) {}

  /// What to state now, if anything: where the joints can be within 0.5 s; at rest, where they are. Asked all the
  /// time, it restates once a second, and while they move before half of the 0.5 s is over.
  std::optional<JointInterval> next(const std::vector<double>& positions, bool at_rest, int64_t now_us);
  /// It was given to be written, as that line; 0: it was not taken.
  void stated(JointInterval interval, uint64_t line, int64_t now_us);
  /// What became of the lines: LogWriter::Progress.
  void update(uint64_t done, uint64_t durable, uint64_t failed);
  /// Whether the joints may do whatever they can in that time.
  bool allows(const std::vector<double>& positions, double seconds) const;

 private:
  JointInterval reach(const std::vector<double>& positions, double seconds) const;
  bool covers(const JointInterval& reached) const;

  struct Pending {
    JointInterval interval;
    uint64_t line = 0;
  };
  std::vector<JointMotion> joints_;
  std::optional<JointInterval> durable_, doubtful_;
  std::optional<Pending> pending_;
  std::optional<int64_t> stated_us_;
};

}  // namespace glovebench
