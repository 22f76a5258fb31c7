#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"

namespace glovebench {

/// The 22 joint angles, rad (degrees in files).
/// Paper: section III.
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

/// Names in files; limits of a human hand. core/README.md defines zero and signs.
struct AngleInfo {
  std::string_view name;
  double min_deg;
  double max_deg;
};
const std::array<AngleInfo, kAngleCount>& angle_infos();

Posture posture_from_degrees(const std::array<double, kAngleCount>& degrees);
Posture clamp_to_limits(const Posture& posture);
/// RMS over the angles, rad.
double posture_distance(const Posture& a, const Posture& b);

enum class Side { right, left };
constexpr auto names_of(Side) { return std::to_array<std::string_view>({"right", "left"}); }

struct HandFrame {
  int64_t timestamp_us = 0;
  Posture posture = Posture::Zero();                                ///< rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< m; IR camera
};

enum class Appearance { glove, skin };
constexpr auto names_of(Appearance) { return std::to_array<std::string_view>({"glove", "skin"}); }

struct PostureSet {
  std::string name;
  std::vector<std::string> posture_names;
  std::vector<Posture> postures;
};

}  // namespace glovebench
