#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace glovebench {

/// T_to_from of least mean squared distance (Horn 1987). Empty below three points or on a line.
/// Paper: reference 23.
std::optional<Eigen::Isometry3d> align_points(std::span<const Eigen::Vector3f> from,
                                              std::span<const Eigen::Vector3f> to);

/// Unit eigenvector of the largest eigenvalue, either sign.
Eigen::Vector4d largest_eigenvector(const Eigen::Matrix4d& matrix);

}  // namespace glovebench
