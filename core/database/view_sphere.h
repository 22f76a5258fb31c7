#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "core/hand/hand_model.h"

namespace glovebench {

inline constexpr int kCameraPositions = 42;   ///< once subdivided icosahedron (section III)
inline constexpr int kInPlaneRotations = 18;  ///< 20 degrees apart
inline constexpr int kViewCount = kCameraPositions * kInPlaneRotations;

/// Unit vectors to corners and edge midpoints of an icosahedron.
std::vector<Eigen::Vector3d> camera_directions();

/// R_view_hand of cameras that look at the hand's origin. View = position * 18 + rotation.
const std::vector<Eigen::Matrix3d>& view_rotations();

/// 0 off the hand.
struct HandImages {
  LabelImage label;      ///< 1..kColorCount
  Image<uint8_t> patch;  ///< patch + 1
  DepthImage depth;      ///< z, m
};

/// For one thread.
class ViewRenderer {
 public:
  virtual ~ViewRenderer() = default;
  /// Labels of the nearest surfaces.
  virtual LabelImage render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                                   const Eigen::Isometry3d& T_camera_hand) = 0;
  virtual HandImages render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                                const Eigen::Isometry3d& T_camera_hand) = 0;
};

using ViewRendererFactory = std::function<std::unique_ptr<ViewRenderer>()>;

}  // namespace glovebench
