#include "trajectories/angle_json.h"

#include "core/base/angles.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {

std::string in_quotes(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string joint_order_json() {
  std::string json = "[";
  constexpr int names_per_line = 4;
  for (int a = 0; a < kAngleCount; ++a) {
    json += a == 0 ? "\n    " : a % names_per_line == 0 ? ",\n    " : ", ";
    json += in_quotes(angle_infos()[a].name);
  }
  return json + "\n  ]";
}

void expect_joint_order(const JsonCursor& field) {
  const JsonItems names = field.items(kAngleCount);
  for (int a = 0; a < kAngleCount; ++a) names[a].expect_text(angle_infos()[a].name);
}

std::string angles_json(const Posture& posture) {
  std::string json = "[";
  for (int a = 0; a < kAngleCount; ++a) {
    if (a > 0) json += ", ";
    json += fixed(degrees_from_radians(posture[a]), 3);
  }
  return json + "]";
}

Posture angles_from(const JsonCursor& field) {
  const JsonItems angles = field.items(kAngleCount);
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[a];
    posture[a] = radians_from_degrees(angles[a].number(info.min_deg, info.max_deg));
  }
  return posture;
}

}  // namespace glovebench::trajectories
