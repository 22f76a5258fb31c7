#include "reports/metrics/measure_frame.h"
#include "reports/statistics.h"

namespace glovebench::reports {
namespace {

/// Poses the tracker's mesh twice, so it measures posture and pose, not the size of the hand. It says nothing
/// about the surface of a subject with another mesh.
std::optional<double> vertex_error_mm(const MeasuredFrame& frame) {
  const auto &estimated = frame.estimated_hand.vertices, &truth = frame.true_hand.vertices;
  double sum = 0;
  for (size_t v = 0; v < estimated.size(); ++v) {
    sum += (frame.estimate.T_camera_hand * estimated[v].cast<double>() -
            frame.truth.T_camera_hand * truth[v].cast<double>())
               .norm();
  }
  return 1000 * sum / static_cast<double>(estimated.size());
}

std::optional<double> fingertip_error_mm(const MeasuredFrame& frame) {
  return mean_error_mm(frame, fingertip_joints());
}

std::optional<double> joint_error_mm(const MeasuredFrame& frame) {
  std::vector<double> errors;
  for (const std::optional<double>& error : frame.joint_errors_mm)
    if (error) errors.push_back(*error);
  return mean(errors);
}

}  // namespace

std::vector<Metric> mesh_metrics() {
  return {
      {.key = "vertex_error_mm",
       .unit = "mm",
       .description = "MPVPE, raw: mean distance of the vertices of the tracker's mesh in both postures and poses",
       .formula = "sum over the n vertices of |T' v'_i - T v_i| / n",
       .heading = "vertices mm",
       .place = 100,
       .gate = Metric::Gate{0.2, 0.01},
       .of_tracked = vertex_error_mm},
      {.key = "fingertip_error_mm",
       .unit = "mm",
       .description = "mean distance of the five fingertips",
       .formula = "sum over the tips of |t'_i - t_i| / 5",
       .heading = "fingertips mm",
       .place = 110,
       .gate = Metric::Gate{0.2, 0.01},
       .of_tracked = fingertip_error_mm,
       .needs = Needs::joints_in_camera},
      {.key = "joint_error_mm",
       .unit = "mm",
       .description = "MPJPE, raw: mean distance of the 25 joints",
       .formula = "sum over the joints of |j'_i - j_i| / 25",
       .heading = "joints mm",
       .place = 120,
       .of_tracked = joint_error_mm,
       .needs = Needs::joints_in_camera}};
}

}  // namespace glovebench::reports
