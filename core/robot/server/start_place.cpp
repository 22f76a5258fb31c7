#include "core/robot/server/start_place.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/angles.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr double kWorkspaceRounding = 1e-4;  // m: 1e-7 of the arm's angles in a log, 1e-5 of their solver

std::string text(const Eigen::Vector3d& p) {
  return fmt::format("({:.6g} {:.6g} {:.6g})", p.x(), p.y(), p.z());
}

}  // namespace

double start_angle(double angle, double min_deg, double max_deg, const StartPlace& start, std::string_view joint) {
  const double angle_deg = degrees_from_radians(angle), tolerance_deg = degrees_from_radians(start.tolerance);
  if (!(angle_deg >= min_deg - tolerance_deg && angle_deg <= max_deg + tolerance_deg))
    throw Error(start.source, std::string(joint), fmt::format("{} degrees", angle_deg),
                fmt::format("{} to {}", min_deg, max_deg));
  return std::clamp(angle, radians_from_degrees(min_deg), radians_from_degrees(max_deg));
}

double start_distal(double distal, double proximal, const StartPlace& start, std::string_view joint) {
  if (!(distal <= proximal + start.tolerance))
    throw Error(start.source, std::string(joint), fmt::format("{} degrees", degrees_from_radians(distal)),
                fmt::format("at most the {} of the joint before it", degrees_from_radians(proximal)));
  return std::min(distal, proximal);
}

Eigen::Vector3d start_in_workspace(const Eigen::Vector3d& p_base, const CommandLimits& limits,
                                   const std::string& source) {
  const Eigen::Vector3d inside = p_base.cwiseMax(limits.workspace_min).cwiseMin(limits.workspace_max);
  if (!((inside - p_base).norm() <= kWorkspaceRounding))
    throw Error(source, "wrist of the arm", text(p_base) + " m",
                fmt::format("a place in the workspace, with room for the fingertips: {} to {}",
                            text(limits.workspace_min), text(limits.workspace_max)));
  return inside;
}

}  // namespace glovebench
