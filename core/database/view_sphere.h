#pragma once

#include <Eigen/Core>
#include <vector>

namespace glovebench {

inline constexpr int kCameraPositions = 42;   ///< an icosahedron subdivided once (section III)
inline constexpr int kInPlaneRotations = 18;  ///< 20 degrees apart
inline constexpr int kViewCount = kCameraPositions * kInPlaneRotations;  ///< 756

/// Unit vectors to the camera positions: corners and edge midpoints of an icosahedron.
std::vector<Eigen::Vector3d> camera_directions();

/// R_view_hand of the 756 views: cameras (x right, y down, z forward) that look at the hand origin.
/// View = position * 18 + rotation.
const std::vector<Eigen::Matrix3d>& view_rotations();

}  // namespace glovebench
