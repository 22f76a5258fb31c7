#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace glovebench {

struct JointMotion {
  double min = 0, max = 0;  ///< rad
  double speed = 0;         ///< rad/s
};

/// Units: rad.
struct JointInterval {
  std::vector<double> min, max;

  bool operator==(const JointInterval&) const = default;
};

/// True if each joint can cross its interval in `seconds`, up to 1e-5 degrees.
bool is_one_step(const JointInterval& interval, const std::vector<JointMotion>& joints, double seconds);

/// Decides which intervals of the joints a log states in advance. After a crash the log may end with the durable
/// interval, a pending one or one whose writing failed. The joints stay inside all of them.
class StatedInterval {
 public:
  explicit StatedInterval(std::vector<JointMotion> joints) : joints_(std::move(joints)) {}

  /// The interval to state now, if any: what the joints reach in 0.5 s, or at rest their positions. Due every
  /// second, and in motion when less than 0.25 s of it remains.
  std::optional<JointInterval> next(const std::vector<double>& positions, bool at_rest, int64_t now_us);
  /// `line`: number in the log; 0 if lost.
  void stated(JointInterval interval, uint64_t line, int64_t now_us);
  /// As in LogWriter::Progress.
  void update(uint64_t done, uint64_t durable, uint64_t failed);
  /// True if the joints may move freely for `seconds`.
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
