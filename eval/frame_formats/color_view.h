#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "core/hand/skeleton.h"
#include "eval/frame_formats/frame_format.h"

namespace glovebench::eval {

/// MediaPipe's landmarks as WebXR joints: wrist, thumb CMC to tip, other fingers MCP to tip.
const std::array<int, 21>& landmark_joints();

struct JointLabel {
  Eigen::Vector3d p_camera = Eigen::Vector3d::Zero();  ///< m
  bool is_visible = false;
};
/// WebXR's 25 joints. A joint is visible if the surface at its pixel is at most 20 mm nearer, or 35 mm at the
/// wrist and the metacarpals' bases.
std::array<JointLabel, kForearmJoint> label_joints(const JointPoses& T_hand_joint,
                                                   const Eigen::Isometry3d& T_camera_hand,
                                                   const DepthImage& true_depth, const PinholeCamera& camera);

/// A frame in pixels and axes of the color camera.
struct ColorView {
  DepthImage depth;  ///< measured, m
  render::TrueImages truth;
  Eigen::Isometry3d T_rgb_hand;
  std::string hand_json;  ///< see kHandConventions
};
ColorView view_from_color(const DatasetFrame& frame, Side side);

/// Measured depth in the RGB camera: the nearest sample of each pixel. Inputs must be rectified.
DepthImage register_depth(const DepthImage& depth, const RgbdCalibration& calibration);

/// Steps of 1 / `steps_per_m`; 0 beyond 65535 steps.
Image<uint16_t> depth_in_steps(const DepthImage& depth, double steps_per_m);
/// 255 where the image is not 0.
Image<uint8_t> mask_of(const LabelImage& labels);

/// Of README.txt.
inline constexpr std::string_view kHandConventions =
    "  pose         rotation (9, row-major) and translation_mm of the hand's frame\n"
    "  angles_deg   the 22 joint angles by name\n"
    "  joints_21    MediaPipe's order: wrist; thumb CMC, MCP, IP, tip; MCP, PIP, DIP,\n"
    "               tip of index, middle, ring and little finger\n"
    "  joints_25    WebXR's order: the metacarpals' bases, too\n"
    "  *_mm         x, y, z in the color camera's frame\n"
    "  *_visible    1, or 0 where the true surface at the joint's pixel is more than\n"
    "               20 mm nearer (35 mm at the wrist and the metacarpals' bases),\n"
    "               or outside of the image\n";

}  // namespace glovebench::eval
