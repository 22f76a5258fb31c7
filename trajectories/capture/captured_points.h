#pragma once

#include "core/base/fuzz_target.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench {

/// Runs a reader of a capture: every frame has a point for each name, times increase, and every point lies in reach
/// or is a gap.
template <typename Reader>
void expect_points_or_error(const Reader& reader) {
  expect_value_or_error([&] {
    const trajectories::MarkerSequence sequence = reader();
    int64_t before_us = -1;
    for (const trajectories::MarkerFrame& frame : sequence.frames) {
      check(frame.timestamp_us > before_us, "times increase");
      before_us = frame.timestamp_us;
      check(frame.points.size() == sequence.names.size(), "a point for each name");
      for (const Eigen::Vector3d& p : frame.points) {
        const bool in_reach = p.cwiseAbs().maxCoeff() <= trajectories::kMaxCoordinate * (1 + 1e-12);
        check(trajectories::is_seen(p) ? in_reach : p.array().isNaN().all(), "a point in reach or a gap");
      }
    }
  });
}

}  // namespace glovebench
