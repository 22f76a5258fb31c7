#pragma once

#include <opencv2/calib3d.hpp>

#include "core/calibration/board_views.h"
#include "core/calibration/camera_fit.h"

namespace glovebench::calibration {

inline std::vector<cv::Point3f> board_points(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  for (const Eigen::Vector3d& p : corners_on(board)) points.emplace_back(p.x(), p.y(), p.z());
  return points;
}

inline std::vector<cv::Point2f> image_points(const Corners& corners) {
  std::vector<cv::Point2f> points;
  for (const Eigen::Vector2d& uv_px : corners) points.emplace_back(uv_px.x(), uv_px.y());
  return points;
}

inline int lens_flags(LensModel lens) {
  if (lens == LensModel::full) return 0;
  if (lens == LensModel::radial) return cv::CALIB_ZERO_TANGENT_DIST;
  return cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3;
}

inline cv::TermCriteria solver_criteria() { return {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-10}; }

inline PinholeCamera camera_of(const cv::Mat& K, cv::Size size) {
  return {.width = size.width,
          .height = size.height,
          .fx = K.at<double>(0, 0),
          .fy = K.at<double>(1, 1),
          .cx = K.at<double>(0, 2),
          .cy = K.at<double>(1, 2)};
}
inline cv::Mat matrix_of(const PinholeCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

inline LensDistortion lens_of(const cv::Mat& coefficients) {
  const auto at = [&](int i) { return coefficients.at<double>(i); };
  return {.k1 = at(0), .k2 = at(1), .p1 = at(2), .p2 = at(3), .k3 = at(4)};
}
inline cv::Mat coefficients_of(const LensDistortion& lens) {
  return (cv::Mat_<double>(1, 5) << lens.k1, lens.k2, lens.p1, lens.p2, lens.k3);
}

}  // namespace glovebench::calibration
