#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/calibration/board_views.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench::calibration {

/// Inverts LensDistortion::distort.
inline Eigen::Vector2d undistort(const LensDistortion& lens, const Eigen::Vector2d& xy) {
  Eigen::Vector2d guess = xy, error = xy;
  for (int i = 0; i < 50 && error.squaredNorm() > 1e-22; ++i) guess += error = xy - lens.distort(guess);
  return guess;
}

/// A common calibration, cameras rotated by 1.5 degrees.
inline RgbdCalibration kinect_with_lenses() {
  RgbdCalibration truth;
  truth.ir = {.width = 640, .height = 480, .fx = 594.21, .fy = 591.04, .cx = 339.31, .cy = 242.74};
  truth.rgb = {.width = 640, .height = 480, .fx = 529.22, .fy = 525.56, .cx = 328.94, .cy = 267.48};
  truth.ir_lens = {.k1 = -0.264, .k2 = 1.000, .k3 = -1.305};
  truth.rgb_lens = {.k1 = 0.265, .k2 = -0.840, .k3 = 0.912};
  truth.T_rgb_ir.linear() =
      Eigen::AngleAxisd(radians_from_degrees(1.5), Eigen::Vector3d(0.5, 0.8, -0.3).normalized()).toRotationMatrix();
  truth.T_rgb_ir.translation() = Eigen::Vector3d(0.01999, -0.00074, -0.01092);
  return truth;
}

inline Eigen::Vector2d project(const PinholeCamera& camera, const LensDistortion& lens, const Eigen::Vector3d& p) {
  const Eigen::Vector2d xy = lens.distort(p.hnormalized());
  return {camera.fx * xy.x() + camera.cx, camera.fy * xy.y() + camera.cy};
}

inline Corners true_corners(const PinholeCamera& camera, const LensDistortion& lens,
                            const Eigen::Isometry3d& T_camera_board, const Chessboard& board) {
  Corners corners;
  for (const Eigen::Vector3d& p : corners_on(board)) corners.push_back(project(camera, lens, T_camera_board * p));
  return corners;
}

inline double gray_at(const Eigen::Vector2d& p, const Chessboard& board) {
  const double column = std::floor(p.x() / board.square) + 1, row = std::floor(p.y() / board.square) + 1;
  if (column < -1 || row < -1 || column > board.columns + 1 || row > board.rows + 1) return 90;
  if (column < 0 || row < 0 || column > board.columns || row > board.rows) return 215;
  return (static_cast<int>(column) + static_cast<int>(row)) % 2 == 0 ? 35 : 215;
}

class BoardCamera {
 public:
  BoardCamera(const PinholeCamera& camera, const LensDistortion& lens) : camera_(camera) {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        for (int i = 0; i < kSide * kSide; ++i) {
          const double u_px = u + (i % kSide + 0.5) / kSide - 0.5, v_px = v + (i / kSide + 0.5) / kSide - 0.5;
          rays_.push_back(undistort(lens, {(u_px - camera.cx) / camera.fx, (v_px - camera.cy) / camera.fy}));
        }
      }
    }
  }

  Image<uint8_t> picture(const Eigen::Isometry3d& T_camera_board, const Chessboard& board,
                         RandomStream& noise) const {
    const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
    const Eigen::Vector3d origin = T_board_camera.translation(), right = T_board_camera.linear().col(0),
                          down = T_board_camera.linear().col(1), ahead = T_board_camera.linear().col(2);
    Image<uint8_t> picture(camera_.width, camera_.height);
    for (size_t pixel = 0; pixel < picture.size(); ++pixel) {
      double sum = 0;
      for (size_t i = 0; i < kRays; ++i) {
        const Eigen::Vector2d& xy = rays_[pixel * kRays + i];
        const Eigen::Vector3d ray = xy.x() * right + xy.y() * down + ahead;
        const double along = -origin.z() / ray.z();
        sum += along > 0 ? gray_at((origin + along * ray).head<2>(), board) : 90;
      }
      picture[pixel] =
          static_cast<uint8_t>(std::clamp(std::round(sum / kRays + kNoise * noise.normal()), 0.0, 255.0));
    }
    return picture;
  }

 private:
  static constexpr int kSide = 3;
  static constexpr size_t kRays = kSide * kSide;
  static constexpr double kNoise = 2;  ///< gray levels

  PinholeCamera camera_;
  std::vector<Eigen::Vector2d> rays_;
};

/// Tilted by 15 to 45 degrees, whole in both images.
inline std::vector<Eigen::Isometry3d> poses_before(const RgbdCalibration& truth, const Chessboard& board, int count,
                                                   uint64_t seed) {
  RandomStream random(seed, "board", 0, "poses");
  const auto is_whole = [&](const PinholeCamera& camera, const LensDistortion& lens, const Eigen::Isometry3d& T) {
    const double rim = 1.5 * board.square;
    const double right = board.columns * board.square, bottom = board.rows * board.square;
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(-rim, -rim, 0), Eigen::Vector3d(right + rim, -rim, 0),
          Eigen::Vector3d(-rim, bottom + rim, 0), Eigen::Vector3d(right + rim, bottom + rim, 0)}) {
      const Eigen::Vector2d uv = project(camera, lens, T * p);
      if (!(uv.x() > 0 && uv.y() > 0 && uv.x() < camera.width - 1 && uv.y() < camera.height - 1)) return false;
    }
    return true;
  };
  std::vector<Eigen::Isometry3d> poses;
  while (static_cast<int>(poses.size()) < count) {
    const double tilt = radians_from_degrees(random.uniform(15, 45)),
                 side = random.uniform(0, 2 * std::numbers::pi);
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(side), std::sin(side), 0)) *
                               Eigen::AngleAxisd(random.uniform(-3.14, 3.14), Eigen::Vector3d::UnitZ()))
                                  .toRotationMatrix();
    const double z = random.uniform(0.35, 0.8);
    Eigen::Isometry3d T_ir_board = Eigen::Isometry3d::Identity();
    T_ir_board.linear() = R;
    const Eigen::Vector3d middle((board.columns - 1) * board.square / 2, (board.rows - 1) * board.square / 2, 0);
    T_ir_board.translation() =
        Eigen::Vector3d(random.uniform(-0.4, 0.4) * z, random.uniform(-0.3, 0.3) * z, z) - R * middle;
    if (is_whole(truth.ir, truth.ir_lens, T_ir_board) &&
        is_whole(truth.rgb, truth.rgb_lens, truth.T_rgb_ir * T_ir_board))
      poses.push_back(T_ir_board);
  }
  return poses;
}

}  // namespace glovebench::calibration
