#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/database/database.h"
#include "core/database/look_up.h"

namespace glovebench {

/// The look-up's theta and R-hat-prime.
/// Paper: sections III-B and III-C.
struct CoarseEstimate {
  Posture posture = Posture::Zero();  ///< rad
  Eigen::Matrix3d R_camera_hand = Eigen::Matrix3d::Identity();
  bool ambiguous = false;  ///< two rotations differ by more than 60 degrees
};

/// Mean of the matches with weights 1 / (E + epsilon); of rotations, `mean_rotation`. First turns each view's
/// rotation from the ray to its hand to `query_ray` (unit, camera frame; empty: not turned). `matches` is not
/// empty.
CoarseEstimate interpolate(const Database& database, std::span<const Match> matches,
                           const std::optional<Eigen::Vector3d>& query_ray, double epsilon);

/// Largest eigenvector of the weighted sum of q q^T (Markley et al. 2007).
Eigen::Quaterniond mean_rotation(std::span<const Eigen::Quaterniond> rotations, std::span<const double> weights);

}  // namespace glovebench
