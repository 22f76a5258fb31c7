#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/database/database.h"
#include "trajectories/capture/fit_hand.h"
#include "trajectories/formats/format.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// Reads and fits a capture of a hand of that side; a left one is mirrored and fitted as a right one. The frames of
/// several files, which must have the same points, follow each other a second apart. Throws Error.
HandFit import_capture(const std::vector<std::string>& paths, const Format& format, Side side,
                       const MarkerLayout& layout, const HandModel& right_hand);

/// Where the camera was.
struct CapturePlacement {
  Side side = Side::right;
  /// The capture's frame has any axes. Without this, the camera looks from kViewingDistance down on the back of the
  /// hand as it lies on the average, the fingers up in the image.
  std::optional<Eigen::Isometry3d> T_capture_camera;
};
inline constexpr double kViewingDistance = 0.7;  ///< m

/// The movement, every nth frame of it.
Trajectory trajectory_of(const HandFit& fit, const CapturePlacement& placement, const std::string& name, int every);

/// `count` postures of a capture by low-dispersion sampling, beginning with the first frame's; all of them if there
/// are no more. `names` (empty: their numbers) of the frames.
PostureSet postures_of(const HandFit& fit, const std::string& name, size_t count,
                       const std::vector<std::string>& names);

/// A CSV with a line for each frame: points, residuals, corrected labels, what was bridged.
std::string residual_table(const HandFit& fit);

/// Frames, residuals, gaps, labels, angles that no frame shows, in one line.
std::string summary(const HandFit& fit);

}  // namespace glovebench::trajectories
