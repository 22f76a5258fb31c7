#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "core/database/tiny_image.h"

namespace glovebench {

/// A square of an image in continuous coordinates: a pixel reaches half a pixel to each side of its center.
struct ImageSquare {
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  double side_px = 0;
};
ImageSquare image_square(const Square& square);
/// The square around the bounding box of projected points, centered on it. Nothing if there are none or one is not
/// in front of the camera.
std::optional<ImageSquare> projected_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Isometry3d& T_camera_hand, const PinholeCamera& camera);

struct BoxPlacement {
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  int iterations = 0;
  bool converged = false;  ///< the square is the observed one within 0.01 px
};
/// The position at which points of a known rotation project into an observed square: the size of the square tells
/// the depth, its middle the rest. Fixed-point iteration, 20 at most. Nothing if the square is empty or so large
/// that the points would come behind the camera.
std::optional<BoxPlacement> place_in_square(std::span<const Eigen::Vector3f> points_hand,
                                            const Eigen::Matrix3d& R_camera_hand, const ImageSquare& observed,
                                            const PinholeCamera& camera);

}  // namespace glovebench
