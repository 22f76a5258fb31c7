#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "core/base/enum_names.h"

namespace glovebench {

/// The 22 joint angles of section III: 16 flexions and 6 abductions. Radians; in files degrees.
inline constexpr int kAngleCount = 22;
using Posture = Eigen::Matrix<double, kAngleCount, 1>;

enum Angle : int {
  kWristFlexion,
  kWristAbduction,
  kThumbCmcAbduction,
  kThumbCmcFlexion,
  kThumbMcpFlexion,
  kThumbIpFlexion,
  kIndexMcpAbduction,
  kIndexMcpFlexion,
  kIndexPipFlexion,
  kIndexDipFlexion,
  kMiddleMcpAbduction,
  kMiddleMcpFlexion,
  kMiddlePipFlexion,
  kMiddleDipFlexion,
  kRingMcpAbduction,
  kRingMcpFlexion,
  kRingPipFlexion,
  kRingDipFlexion,
  kLittleMcpAbduction,
  kLittleMcpFlexion,
  kLittlePipFlexion,
  kLittleDipFlexion,
};

/// Name as it stands in files, and the limits of a human hand. Positive flexion bends to the palm, positive
/// abduction turns towards the thumb; zero is a straight finger in line with the palm.
struct AngleInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
};
const std::array<AngleInfo, kAngleCount>& angle_infos();

Posture posture_from_degrees(const std::array<double, kAngleCount>& degrees);
/// Each angle moved to the nearest limit if it lies outside.
Posture clamp_to_limits(const Posture& posture);
/// The headline posture error: root mean square over the 22 angles, radians.
double posture_distance(const Posture& a, const Posture& b);

enum class Side { right, left };
constexpr auto names_of(Side) {
  return std::to_array<std::string_view>({"right", "left"});
}

}  // namespace glovebench
