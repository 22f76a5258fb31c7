#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "core/database/tiny_image.h"

namespace glovebench {

/// Continuous image coordinates: a pixel extends 0.5 px from its center.
struct ImageSquare {
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  double side_px = 0;
};
ImageSquare image_square(const Square& square);
/// Around projected points. Empty without points or if one is behind the camera.
std::optional<ImageSquare> projected_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Isometry3d& T_camera_hand, const PinholeCamera& camera);

struct BoxPlacement {
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  int iterations = 0;
  bool converged = false;  ///< to 0.01 px
};
/// The position where projected points fill `observed`. Empty if `observed` is empty, or so large that points fall
/// behind the camera.
std::optional<BoxPlacement> place_in_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Matrix3d& R_camera_hand, const ImageSquare& observed,
                                            const PinholeCamera& camera);

}  // namespace glovebench
