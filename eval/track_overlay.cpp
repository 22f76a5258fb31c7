#include "eval/track_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "render/pictures.h"

namespace glovebench::eval {
namespace {

constexpr Rgb kOutline = {255, 255, 255}, kBones = {255, 210, 0};
constexpr double kNearest = 0.05;  // m; nearer joints have no place in the image

/// From each joint to its parent; knuckles and the thumb's base hang on the wrist.
std::vector<render::Stroke> bones_of(const PosedHand& posed, const Eigen::Isometry3d& T_rgb_hand,
                                     const PinholeCamera& camera) {
  std::vector<render::Stroke> bones;
  for (int joint = 0; joint < kJointCount; ++joint) {
    if (joint == kWristJoint || joint == kForearmJoint) continue;
    const int parent = std::max(joint_parents()[joint], kWristJoint);
    const Eigen::Vector3d from = T_rgb_hand * posed.T_hand_joint[parent].translation();
    const Eigen::Vector3d to = T_rgb_hand * posed.T_hand_joint[joint].translation();
    if (std::min(from.z(), to.z()) > kNearest) bones.push_back({camera.project(from), camera.project(to)});
  }
  return bones;
}

}  // namespace

TrackOverlay::TrackOverlay(const std::string& path, std::shared_ptr<const HandModel> hand,
                           const RgbdCalibration& calibration)
    : sink_(open_picture_sink(path, calibration.rgb.width, calibration.rgb.height)),
      hand_(std::move(hand)),
      calibration_(calibration) {}

void TrackOverlay::add(int number, const DeviceFrame& frame, const TrackResult& result) {
  const std::string caption = fmt::format("frame {}  {}", number, to_string(result.status));
  sink_->add(number, frame.depth_timestamp_us, render::overlay_text(picture(frame, result), caption));
}

ColorImage TrackOverlay::picture(const DeviceFrame& frame, const TrackResult& result) {
  if (result.status != TrackStatus::tracked) return frame.color;
  const PosedHand posed = hand_->pose(result.posture);
  const Eigen::Isometry3d T_rgb_hand = calibration_.T_rgb_ir * result.T_camera_hand;
  LabelImage silhouette = renderer_.render_labels(*hand_, posed, calibration_.rgb, T_rgb_hand);
  for (uint8_t& label : silhouette) label = label != 0;
  return render::overlay_strokes(render::overlay_outline(frame.color, silhouette, kOutline),
                                 bones_of(posed, T_rgb_hand, calibration_.rgb), kBones);
}

}  // namespace glovebench::eval
