#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/angles.h"
#include "core/robot/command_guard.h"

namespace glovebench {

/// Twice what an angle of a log may be off.
inline constexpr double kLogRounding = radians_from_degrees(1e-6);

/// Where a server begins, and who says so.
struct StartPlace {
  std::vector<double> joints;  ///< rad
  std::string source = "start";
  double tolerance = kLogRounding;  ///< rad
};

/// Where a server begins must be a place that it could have gone to. What misses a limit by no more than the
/// tolerance is moved onto it; whatever else is outside throws Error: `source` is where it was found.

/// The angle of a joint, rad.
double start_angle(double angle, double min_deg, double max_deg, const StartPlace& start, std::string_view joint);

/// J1 of a finger, which is not above its J2, rad.
double start_distal(double distal, double proximal, const StartPlace& start, std::string_view joint);

/// Where the wrist is in the arm's base frame, m; the workspace is the wrist's (CommandGuard::limits of an arm).
/// The tolerance of inverse kinematics counts as rounding here.
Eigen::Vector3d start_in_workspace(const Eigen::Vector3d& p_base, const CommandLimits& limits,
                                   const std::string& source);

}  // namespace glovebench
