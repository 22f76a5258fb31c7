#include "core/hand/posture.h"

#include <cmath>

#include "core/base/math.h"

namespace glovebench {

// Limits: active ranges of motion of a human hand, a little wider than the textbook ones so that captured
// postures (hyperextended fingers, a crossed little finger) stay inside.
const std::array<AngleInfo, kAngleCount>& angle_infos() {
  static constexpr std::array<AngleInfo, kAngleCount> infos = {{
      {"wrist_flexion", -75, 80},        {"wrist_abduction", -35, 30},      {"thumb_cmc_abduction", -25, 65},
      {"thumb_cmc_flexion", -35, 60},    {"thumb_mcp_flexion", -25, 75},    {"thumb_ip_flexion", -35, 90},
      {"index_mcp_abduction", -35, 35},  {"index_mcp_flexion", -45, 100},   {"index_pip_flexion", -15, 120},
      {"index_dip_flexion", -20, 95},    {"middle_mcp_abduction", -35, 35}, {"middle_mcp_flexion", -45, 100},
      {"middle_pip_flexion", -15, 120},  {"middle_dip_flexion", -20, 95},   {"ring_mcp_abduction", -35, 35},
      {"ring_mcp_flexion", -45, 100},    {"ring_pip_flexion", -15, 120},    {"ring_dip_flexion", -20, 95},
      {"little_mcp_abduction", -45, 35}, {"little_mcp_flexion", -45, 100},  {"little_pip_flexion", -15, 120},
      {"little_dip_flexion", -20, 95},
  }};
  return infos;
}

Posture posture_from_degrees(const std::array<double, kAngleCount>& degrees) {
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) posture[a] = radians_from_degrees(degrees[a]);
  return posture;
}

Posture clamp_to_limits(const Posture& posture) {
  Posture clamped;
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[a];
    clamped[a] = std::clamp(posture[a], radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg));
  }
  return clamped;
}

double posture_distance(const Posture& a, const Posture& b) {
  return std::sqrt((a - b).squaredNorm() / kAngleCount);
}

}  // namespace glovebench
