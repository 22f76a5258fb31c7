#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/database/database.h"
#include "core/database/look_up.h"

namespace glovebench {

/// The look-up's answer: theta and R-hat-prime of section III-B and C.
struct CoarseEstimate {
  Posture posture = Posture::Zero();  ///< rad
  Eigen::Matrix3d R_camera_hand = Eigen::Matrix3d::Identity();
  bool ambiguous = false;  ///< two of the rotations differ by more than 60 degrees
};

/// Weighted mean of the matches: weights 1 / (E + epsilon), so that a larger matching error weighs less; rotations
/// by Markley's quaternion mean. A view's rotation is relative to the ray through the middle of the hand's square,
/// not to the optical axis: it is turned from the entry's ray to `query_ray` (unit, camera frame). `matches` is not
/// empty.
CoarseEstimate interpolate(const Database& database, std::span<const Match> matches,
                           const Eigen::Vector3d& query_ray, double epsilon);

/// Markley et al. 2007: the largest eigenvector of the weighted sum of q q^T.
Eigen::Quaterniond mean_rotation(std::span<const Eigen::Quaterniond> rotations, std::span<const double> weights);

}  // namespace glovebench
