#include "trajectories/unit_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

// A hand that moves reaches the first in radians; no joint exceeds the second, but one finger that bends does in
// degrees.
constexpr double kLeastOfMovement = 0.5, kMostRadians = 3.2;

bool are_most_inside(const std::vector<double>& z, double factor, const WorkingVolume& volume) {
  const auto inside = std::ranges::count_if(
      z, [&](double each) { return factor * each >= volume.z_min && factor * each <= volume.z_max; });
  return 2 * inside >= std::ssize(z);
}

std::string likely_cause(const std::vector<double>& z, const WorkingVolume& volume) {
  for (const auto& [factor, unit] : {std::pair{1000.0, "meters"}, std::pair{10.0, "centimeters"}})
    if (are_most_inside(z, factor, volume))
      return fmt::format("the positions look like {}, position_mm is in millimeters", unit);
  if (are_most_inside(z, -1, volume)) return "the positions look like those of a camera that looks along -z";
  return "position_mm is the hand's place in the camera's frame, z forward";
}

}  // namespace

std::string angle_doubt(std::span<const Posture> postures) {
  double largest = 0;
  for (const Posture& posture : postures)
    largest = std::max(largest, degrees_from_radians(posture.cwiseAbs().maxCoeff()));
  if (largest < kLeastOfMovement || largest > kMostRadians) return "";
  return fmt::format("no angle exceeds {:.2f} degrees: the angles look like radians, angles_deg is in degrees",
                     largest);
}

std::vector<std::string> unit_doubts(const Trajectory& trajectory, const WorkingVolume& volume) {
  std::vector<std::string> doubts;
  std::vector<double> z;
  std::vector<Posture> postures;
  for (const HandFrame& frame : trajectory.frames) {
    z.push_back(frame.T_camera_hand.translation().z());
    postures.push_back(frame.posture);
  }
  if (!are_most_inside(z, 1, volume)) {
    const auto [nearest, farthest] = std::ranges::minmax(z);
    doubts.push_back(fmt::format(
        "most frames lie outside of the working volume, {:g} to {:g} mm from the camera (z of the hand: "
        "{:g} to {:g} mm): {}",
        1000 * volume.z_min, 1000 * volume.z_max, 1000 * nearest, 1000 * farthest, likely_cause(z, volume)));
  }
  if (const std::string doubt = angle_doubt(postures); !doubt.empty()) doubts.push_back(doubt);
  return doubts;
}

}  // namespace glovebench::trajectories
