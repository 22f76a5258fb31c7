#include <Eigen/Geometry>

#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// The same points twice, in the camera's frame, m.
struct PointPairs {
  Matrix3Xd estimated, truth;
};

Matrix3Xd vertices_in_camera(const Eigen::Isometry3d& T_camera_hand, const PosedHand& hand) {
  Matrix3Xd vertices(3, hand.vertices.size());
  for (size_t v = 0; v < hand.vertices.size(); ++v)
    vertices.col(static_cast<Eigen::Index>(v)) = T_camera_hand * hand.vertices[v].cast<double>();
  return vertices;
}

/// The joints that are estimated.
PointPairs joint_pairs(const MeasuredFrame& frame) {
  PointPairs pairs{Matrix3Xd(3, kForearmJoint), Matrix3Xd(3, kForearmJoint)};
  Eigen::Index count = 0;
  for (size_t j = 0; j < frame.joints.size(); ++j) {
    if (!frame.joints[j]) continue;
    pairs.estimated.col(count) = *frame.joints[j];
    pairs.truth.col(count++) = frame.true_joints[j];
  }
  pairs.estimated.conservativeResize(3, count);
  pairs.truth.conservativeResize(3, count);
  return pairs;
}

PointPairs vertex_pairs(const MeasuredFrame& frame) {
  return {vertices_in_camera(frame.estimate.T_camera_hand, frame.estimated_hand),
          vertices_in_camera(frame.truth.T_camera_hand, frame.true_hand)};
}

double mean_distance_mm(const Matrix3Xd& a, const Matrix3Xd& b) { return 1000 * (a - b).colwise().norm().mean(); }

/// After the estimate is scaled about its root and moved to the true root.
double error_at_root_mm(const PointPairs& pairs, const Vector3d& root, const Vector3d& true_root, double scale) {
  return mean_distance_mm((scale * (pairs.estimated.colwise() - root)).colwise() + true_root, pairs.truth);
}

constexpr double kNoLength = 1e-9;  ///< m

/// After the similarity transform with the least squared distances (Umeyama 1991); it does not mirror. Points that
/// are all one come to the middle of the true ones.
double error_after_procrustes_mm(const PointPairs& pairs) {
  const Vector3d middle = pairs.estimated.rowwise().mean(), true_middle = pairs.truth.rowwise().mean();
  if ((pairs.estimated.colwise() - middle).norm() < kNoLength)
    return 1000 * (pairs.truth.colwise() - true_middle).colwise().norm().mean();
  const Eigen::Matrix4d T = Eigen::umeyama(pairs.estimated, pairs.truth, true);
  return mean_distance_mm((T.topLeftCorner<3, 3>() * pairs.estimated).colwise() + T.col(3).head<3>(), pairs.truth);
}

std::optional<double> mpjpe_root_mm(const MeasuredFrame& frame) {
  const std::optional<Vector3d>& wrist = frame.joints[kWristJoint];
  if (!wrist) return {};
  return error_at_root_mm(joint_pairs(frame), *wrist, frame.true_joints[kWristJoint], 1);
}

std::optional<double> mpjpe_scaled_mm(const MeasuredFrame& frame) {
  const auto &wrist = frame.joints[kWristJoint], &knuckle = frame.joints[kMiddleMcpJoint];
  if (!wrist || !knuckle) return {};
  const Vector3d& true_wrist = frame.true_joints[kWristJoint];
  const double length = (*knuckle - *wrist).norm();
  const double scale = length < kNoLength ? 1 : (frame.true_joints[kMiddleMcpJoint] - true_wrist).norm() / length;
  return error_at_root_mm(joint_pairs(frame), *wrist, true_wrist, scale);
}

/// Both poses are of the tracker's hand, whose palm is rigid, so scaling by a bone of the palm would change
/// nothing.
std::optional<double> mpvpe_root_mm(const MeasuredFrame& frame) {
  const auto wrist = [](const Eigen::Isometry3d& T_camera_hand, const PosedHand& hand) -> Vector3d {
    return T_camera_hand * hand.T_hand_joint[kWristJoint].translation();
  };
  return error_at_root_mm(vertex_pairs(frame), wrist(frame.estimate.T_camera_hand, frame.estimated_hand),
                          wrist(frame.truth.T_camera_hand, frame.true_hand), 1);
}

}  // namespace

std::vector<Metric> aligned_metrics() {
  return {{.key = "mpjpe_root_mm",
           .unit = "mm",
           .description = "MPJPE, root-relative: joint_error_mm after the wrist is moved to the true wrist",
           .formula = "sum over the joints of |(j'_i - w') - (j_i - w)| / 25, w the wrist",
           .heading = "MPJPE root mm",
           .place = 1030,
           .of_tracked = mpjpe_root_mm,
           .needs = Needs::joints_to_scale},
          {.key = "mpjpe_scaled_mm",
           .unit = "mm",
           .description = "MPJPE, scaled: also after the bone from wrist to middle MCP has its true length",
           .formula = "as root-relative, with j'_i - w' times |m - w| / |m' - w'|, m the middle MCP",
           .heading = "MPJPE scaled mm",
           .place = 1040,
           .of_tracked = mpjpe_scaled_mm,
           .needs = Needs::joints},
          {.key = "mpjpe_procrustes_mm",
           .unit = "mm",
           .description = "MPJPE, Procrustes: joint_error_mm after the best rotation, translation and scale",
           .formula = "sum over the joints of |s R j'_i + t - j_i| / 25 at its least squares",
           .heading = "MPJPE Procrustes mm",
           .place = 1050,
           .of_tracked = [](const MeasuredFrame& frame) -> std::optional<double> {
             return error_after_procrustes_mm(joint_pairs(frame));
           },
           .needs = Needs::joints},
          {.key = "mpvpe_root_mm",
           .unit = "mm",
           .description = "MPVPE, root-relative: vertex_error_mm after the wrist is moved to the true wrist",
           .formula = "sum over the n vertices of |(v'_i - w') - (v_i - w)| / n, w the wrist",
           .heading = "MPVPE root mm",
           .place = 1060,
           .of_tracked = mpvpe_root_mm},
          {.key = "mpvpe_procrustes_mm",
           .unit = "mm",
           .description = "MPVPE, Procrustes: vertex_error_mm after the best rotation, translation and scale",
           .formula = "sum over the n vertices of |s R v'_i + t - v_i| / n at its least squares",
           .heading = "MPVPE Procrustes mm",
           .place = 1070,
           .of_tracked = [](const MeasuredFrame& frame) -> std::optional<double> {
             return error_after_procrustes_mm(vertex_pairs(frame));
           }}};
}

}  // namespace glovebench::reports
