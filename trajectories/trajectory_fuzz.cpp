#include "core/base/fuzz_target.h"
#include "trajectories/trajectory.h"

namespace glovebench {

void trajectory_fuzz(std::string_view bytes) {
  const std::string text = canonical_text(trajectories::parse_trajectory(bytes, "trajectory.json"));
  check(canonical_text(trajectories::parse_trajectory(text, "again")) == text, "a trajectory returns");
}

}  // namespace glovebench
