#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/database/database.h"
#include "trajectories/capture/fit_hand.h"
#include "trajectories/formats/format.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// Fits files with the same points as one capture, 1 s apart. Mirrors a left hand.
/// Throws: Error.
HandFit import_capture(const std::vector<std::string>& paths, const Format& format, Side side,
                       const MarkerLayout& layout, const HandModel& right_hand);

struct CapturePlacement {
  Side side = Side::right;
  /// empty: kViewingDistance above the average hand's back, fingers up
  std::optional<Eigen::Isometry3d> T_capture_camera;
};
inline constexpr double kViewingDistance = 0.7;  ///< m

Trajectory trajectory_of(const HandFit& fit, const CapturePlacement& placement, const std::string& name, int every);

/// Samples at most `count` postures with low dispersion, from the first frame's. `names`: by frame; empty:
/// numbers.
PostureSet postures_of(const HandFit& fit, const std::string& name, size_t count,
                       const std::vector<std::string>& names);

/// CSV, a line per frame.
std::string residual_table(const HandFit& fit);

std::string summary(const HandFit& fit);

}  // namespace glovebench::trajectories
