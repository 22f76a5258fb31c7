#include "core/tracker/track_result.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"

namespace glovebench {
namespace {

double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

}  // namespace

std::string estimate_line(int frame, const TrackResult& result) {
  nlohmann::ordered_json line = {{"frame", frame},
                                 {"timestamp_us", result.timestamp_us},
                                 {"status", to_string(result.status)},
                                 {"cloud_points", result.cloud_points}};
  if (!result.matches.empty()) line["matching_error_px"] = rounded(result.matches.front().error);
  if (result.status != TrackStatus::tracked) return line.dump();
  std::vector<double> angles;
  for (const double angle : result.posture) angles.push_back(rounded(degrees_from_radians(angle)));
  line["angles_deg"] = angles;
  const Eigen::Vector3d p = 1000 * result.T_camera_hand.translation();
  line["position_mm"] = {rounded(p.x()), rounded(p.y()), rounded(p.z())};
  Eigen::Quaterniond q(result.T_camera_hand.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  line["quaternion_wxyz"] = {rounded(q.w()), rounded(q.x()), rounded(q.y()), rounded(q.z())};
  line["icp_iterations"] = result.icp_iterations;
  line["icp_residual_mm"] = rounded(1000 * result.icp_residual);
  line["ambiguous"] = result.ambiguous;
  line["converged"] = result.converged;
  if (result.certainty) {
    nlohmann::ordered_json deviations = nlohmann::ordered_json::array(), hidden = nlohmann::ordered_json::array();
    for (int a = 0; a < kAngleCount; ++a) {
      deviations.push_back(rounded(degrees_from_radians(result.certainty->deviation[a])));
      if (result.certainty->hidden >> a & 1) hidden.push_back(angle_infos()[a].name);
    }
    line["angle_deviations_deg"] = deviations;
    line["hidden"] = hidden;
  }
  return line.dump();
}

}  // namespace glovebench
