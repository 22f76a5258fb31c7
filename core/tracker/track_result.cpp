#include "core/tracker/track_result.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"

namespace glovebench {
namespace {

double rounded(double value) { return std::round(value * 1e6) / 1e6 + 0.0; }

nlohmann::ordered_json written_mm(const Eigen::Vector3d& p) {
  return {rounded(1000 * p.x()), rounded(1000 * p.y()), rounded(1000 * p.z())};
}

}  // namespace

std::string estimate_line(int frame, const TrackResult& result) {
  nlohmann::ordered_json line = {{"frame", frame},
                                 {"timestamp_us", result.timestamp_us},
                                 {"status", to_string(result.status)},
                                 {"cloud_points", result.cloud_points}};
  if (!result.matches.empty()) line["matching_error_px"] = rounded(result.matches.front().error);
  if (result.status != TrackStatus::tracked) return line.dump();
  if (result.has.posture)
    for (const double angle : result.posture) line["angles_deg"].push_back(rounded(degrees_from_radians(angle)));
  if (result.has.pose) {
    line["position_mm"] = written_mm(result.T_camera_hand.translation());
    Eigen::Quaterniond q(result.T_camera_hand.linear());
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    line["quaternion_wxyz"] = {rounded(q.w()), rounded(q.x()), rounded(q.y()), rounded(q.z())};
  }
  for (const auto& joint : result.joints)
    line["joints_mm"].push_back(joint ? written_mm(*joint) : nlohmann::ordered_json());
  if (!result.has.internals) return line.dump();
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
