#include "eval/frame_formats/color_view.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/kinect/disparity.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

using nlohmann::ordered_json;
using reports::rounded;

/// m in front of a joint, at most: an open hand has 18 mm over fingers' joints and 30 mm over the palm's.
double flesh_over(int joint) {
  const bool in_palm = joint == kWristJoint || joint == 1 || joint % 5 == 0;  // the wrist, metacarpals' bases
  return in_palm ? 0.035 : 0.020;
}

ordered_json list_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

template <typename Joints>
void add_joints(ordered_json& json, const std::string& name, std::span<const JointLabel> labels,
                const Joints& joints) {
  ordered_json positions = ordered_json::array(), visible = ordered_json::array();
  for (const int joint : joints) {
    positions.push_back(list_of(1000 * labels[joint].p_camera));
    visible.push_back(labels[joint].is_visible ? 1 : 0);
  }
  json[name + "_mm"] = positions;
  json[name + "_visible"] = visible;
}

std::string hand_json(const DatasetFrame& frame, Side side, const Eigen::Isometry3d& T_rgb_hand,
                      std::span<const JointLabel> labels) {
  ordered_json json = {{"version", 1},
                       {"frame", frame.number},
                       {"timestamp_us", frame.truth.timestamp_us},
                       {"side", to_string(side)}};
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = T_rgb_hand.linear();
  json["pose"] = {{"rotation", list_of(R.reshaped<Eigen::RowMajor>())},
                  {"translation_mm", list_of(1000 * T_rgb_hand.translation())}};
  for (int a = 0; a < kAngleCount; ++a)
    json["angles_deg"][std::string(angle_infos()[a].name)] = rounded(degrees_from_radians(frame.truth.posture[a]));
  add_joints(json, "joints_21", labels, landmark_joints());
  std::array<int, kForearmJoint> all{};
  for (int j = 0; j < kForearmJoint; ++j) all[j] = j;
  add_joints(json, "joints_25", labels, all);
  return reports::format_json(json);
}

}  // namespace

const std::array<int, 21>& landmark_joints() {
  static constexpr std::array<int, 21> joints = {0,  1,  2,  3,  4,  6,  7,  8,  9,  11, 12,
                                                 13, 14, 16, 17, 18, 19, 21, 22, 23, 24};
  return joints;
}

std::array<JointLabel, kForearmJoint> label_joints(const JointPoses& T_hand_joint,
                                                   const Eigen::Isometry3d& T_camera_hand,
                                                   const DepthImage& true_depth, const PinholeCamera& camera) {
  std::array<JointLabel, kForearmJoint> labels;
  for (int j = 0; j < kForearmJoint; ++j) {
    const Eigen::Vector3d p_camera = T_camera_hand * T_hand_joint[j].translation();
    labels[j].p_camera = p_camera;
    if (p_camera.z() <= 0) continue;
    const Eigen::Vector2d uv_px = camera.project(p_camera);
    // Compared before the conversion, which no large number survives.
    if (!(uv_px.minCoeff() >= -0.5 && uv_px.x() < camera.width - 0.5 && uv_px.y() < camera.height - 0.5)) continue;
    const int u = static_cast<int>(std::lround(uv_px.x())), v = static_cast<int>(std::lround(uv_px.y()));
    labels[j].is_visible = true_depth.contains(u, v) && p_camera.z() - true_depth(u, v) <= flesh_over(j);
  }
  return labels;
}

ColorView view_from_color(const DatasetFrame& frame, Side side) {
  const RgbdCalibration& calibration = frame.kinect.calibration();
  const DepthImage measured = depth_from_disparity(frame.images.raw_disparity, calibration.disparity);
  ColorView view{register_depth(measured, calibration),
                 frame.kinect.color_truth(),
                 calibration.T_rgb_ir * frame.truth.T_camera_hand,
                 {}};
  const auto labels =
      label_joints(frame.kinect.true_hand().T_hand_joint, view.T_rgb_hand, view.truth.depth, calibration.rgb);
  view.hand_json = hand_json(frame, side, view.T_rgb_hand, labels);
  return view;
}

DepthImage register_depth(const DepthImage& depth, const RgbdCalibration& calibration) {
  DepthImage registered(calibration.rgb.width, calibration.rgb.height);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (!(depth(u, v) > 0)) continue;
      const Eigen::Vector3d p_rgb = calibration.T_rgb_ir * calibration.ir.back_project(u, v, double{depth(u, v)});
      if (p_rgb.z() <= 0) continue;
      const Eigen::Vector2d uv_px = calibration.rgb.project(p_rgb);
      if (!(uv_px.minCoeff() >= -0.5 && uv_px.x() < registered.width() && uv_px.y() < registered.height()))
        continue;
      const int u_rgb = static_cast<int>(std::lround(uv_px.x())), v_rgb = static_cast<int>(std::lround(uv_px.y()));
      if (!registered.contains(u_rgb, v_rgb)) continue;
      float& z = registered(u_rgb, v_rgb);
      if (z == 0 || p_rgb.z() < double{z}) z = static_cast<float>(p_rgb.z());
    }
  }
  return registered;
}

Image<uint16_t> depth_in_steps(const DepthImage& depth, double steps_per_m) {
  Image<uint16_t> steps(depth.width(), depth.height());
  std::ranges::transform(depth, steps.begin(), [&](float z) {
    const double step = std::round(double{z} * steps_per_m);
    return step > 0 && step <= 65535 ? static_cast<uint16_t>(step) : uint16_t{0};
  });
  return steps;
}

Image<uint8_t> mask_of(const LabelImage& labels) {
  Image<uint8_t> mask(labels.width(), labels.height());
  std::ranges::transform(labels, mask.begin(),
                         [](uint8_t label) { return label != 0 ? uint8_t{255} : uint8_t{0}; });
  return mask;
}

}  // namespace glovebench::eval
