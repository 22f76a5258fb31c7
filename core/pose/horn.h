#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace glovebench {

/// T_to_from that takes `from` to `to` with the least mean squared distance: Horn 1987, by the largest eigenvector
/// of a 4x4 matrix (reference 23 of the paper). Nothing if there are fewer than three points or they lie on one
/// line.
std::optional<Eigen::Isometry3d> align_points(std::span<const Eigen::Vector3f> from,
                                              std::span<const Eigen::Vector3f> to);

/// Unit eigenvector of the largest eigenvalue of the symmetric `matrix`: the rotation as a quaternion that Horn's
/// and Markley's sums ask for. Its sign is free.
Eigen::Vector4d largest_eigenvector(const Eigen::Matrix4d& matrix);

}  // namespace glovebench
