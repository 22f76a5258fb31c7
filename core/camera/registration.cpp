#include "core/camera/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"

namespace glovebench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Eigen::Matrix3d intrinsic_matrix(const PinholeCamera& camera) {
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return K;
}

/// Half-open ranges of pixels.
struct PixelBox {
  int left, top, right, bottom;
};

/// The pixels with a depth; empty if there are none.
PixelBox box_of(const DepthImage& depth) {
  PixelBox box{depth.width(), depth.height(), 0, 0};
  for (int v = 0; v < depth.height(); ++v) {
    const float* const row = &depth(0, v);
    bool any = false;
    for (int u = 0; u < depth.width(); ++u) any |= row[u] > 0;
    if (!any) continue;
    box.top = std::min(box.top, v);
    box.bottom = v + 1;
    const auto has_depth = [](float z) { return z > 0; };
    box.left = static_cast<int>(std::find_if(row, row + box.left, has_depth) - row);
    int right = depth.width();
    while (right > box.right && !(row[right - 1] > 0)) --right;
    box.right = right;
  }
  return box;
}

/// The pixels of one depth row in the RGB camera; z is 0 or negative where there is nothing to see.
struct ProjectedRow {
  std::vector<float> u_px, v_px, z;
};

/// Projects depth rows into the RGB camera: the homogeneous pixel is z * M * (u, v, 1) + b with
/// M = K_rgb R K_ir^-1 and b = K_rgb t. Cheap enough to be done again in each pass instead of stored.
class RowProjector {
 public:
  explicit RowProjector(const RgbdCalibration& calibration) {
    const Eigen::Matrix3d K_rgb = intrinsic_matrix(calibration.rgb);
    M_ = (K_rgb * calibration.T_rgb_ir.linear() * intrinsic_matrix(calibration.ir).inverse()).cast<float>();
    b_ = (K_rgb * calibration.T_rgb_ir.translation()).cast<float>();
    const size_t width = calibration.ir.width;
    row_ = {std::vector<float>(width), std::vector<float>(width), std::vector<float>(width)};
  }

  /// The columns of `box`.
  const ProjectedRow& project(const DepthImage& depth, int v, const PixelBox& box) {
    const Eigen::Vector3f start = M_.col(1) * static_cast<float>(v) + M_.col(2);
    const Eigen::Vector3f step = M_.col(0);
    const Eigen::Vector3f b = b_;
    const float* d = &depth(0, v);
    float* const u_out = row_.u_px.data();
    float* const v_out = row_.v_px.data();
    float* const z_out = row_.z.data();
    for (int u = box.left; u < box.right; ++u) {
      const float fu = static_cast<float>(u);
      const float z = d[u] * (start.z() + step.z() * fu) + b.z();
      const float x = d[u] * (start.x() + step.x() * fu) + b.x();
      const float y = d[u] * (start.y() + step.y() * fu) + b.y();
      const float inverse = 1.0f / z;
      u_out[u] = x * inverse;
      v_out[u] = y * inverse;
      z_out[u] = d[u] > 0 ? z : 0.0f;
    }
    return row_;
  }

 private:
  Eigen::Matrix3f M_;
  Eigen::Vector3f b_;
  ProjectedRow row_;
};

/// How far (px) a depth sample reaches in the RGB image, so that neighboring samples of one surface leave no gap:
/// they lie about f_rgb / f_ir apart, half as much again where the surface faces the RGB camera more.
int splat_radius(const RgbdCalibration& calibration) {
  const double magnification =
      std::max(calibration.rgb.fx / calibration.ir.fx, calibration.rgb.fy / calibration.ir.fy);
  return std::max(1, static_cast<int>(std::ceil(0.75 * magnification)));
}

/// The nearest surface that the RGB camera sees at each of its pixels, from the depth samples within the splat
/// radius; infinite where there is none. The result is padded at the right and at the bottom.
cv::Mat nearest_surface(const DepthImage& depth, const PixelBox& box, const RgbdCalibration& calibration,
                        RowProjector& projector) {
  const int radius = splat_radius(calibration);
  // Cell (i, j) collects the samples with floor(u) = i - radius, floor(v) = j - radius, so that the minimum over
  // the cells i .. i + 2 radius - 1 is the one over u in [i - radius, i + radius).
  cv::Mat cells(calibration.rgb.height + 2 * radius - 1, calibration.rgb.width + 2 * radius - 1, CV_32F,
                cv::Scalar(kInfinity));
  const float width = static_cast<float>(cells.cols), height = static_cast<float>(cells.rows);
  const float offset = static_cast<float>(radius);
  PixelBox reached{cells.cols, cells.rows, 0, 0};  // cells with samples
  for (int v = box.top; v < box.bottom; ++v) {
    const ProjectedRow& row = projector.project(depth, v, box);
    for (int u = box.left; u < box.right; ++u) {
      const float i = row.u_px[u] + offset, j = row.v_px[u] + offset;
      if (!(row.z[u] > 0 && i >= 0 && j >= 0 && i < width && j < height)) continue;
      const int column = static_cast<int>(i), line = static_cast<int>(j);
      float& cell = cells.at<float>(line, column);
      cell = std::min(cell, row.z[u]);
      reached = {std::min(reached.left, column), std::min(reached.top, line), std::max(reached.right, column + 1),
                 std::max(reached.bottom, line + 1)};
    }
  }
  cv::Mat nearest(cells.rows, cells.cols, CV_32F, cv::Scalar(kInfinity));
  if (reached.right == 0) return nearest;
  // A sample is the nearest of cells up to its reach to the left and above.
  const cv::Rect part(cv::Point(std::max(0, reached.left - 2 * radius), std::max(0, reached.top - 2 * radius)),
                      cv::Point(reached.right, reached.bottom));
  cv::Mat target = nearest(part);
  cv::erode(cells(part), target, cv::Mat::ones(2 * radius, 2 * radius, CV_8U), cv::Point(0, 0));
  return nearest;
}

}  // namespace

RegisteredImage register_color(const DepthImage& depth, const ColorImage& color, const RgbdCalibration& calibration,
                               const RegistrationConfig& config) {
  check(depth.width() == calibration.ir.width && depth.height() == calibration.ir.height,
        "the depth image has the size of the calibrated IR camera");
  check(color.width() == calibration.rgb.width && color.height() == calibration.rgb.height,
        "the color image has the size of the calibrated RGB camera");

  RowProjector projector(calibration);
  const PixelBox box = box_of(depth);
  const cv::Mat nearest = nearest_surface(depth, box, calibration, projector);
  const float tolerance = static_cast<float>(config.occlusion_tolerance);
  const float width = static_cast<float>(color.width()), height = static_cast<float>(color.height());

  RegisteredImage mapped{ColorImage(depth.width(), depth.height()), Image<uint8_t>(depth.width(), depth.height())};
  for (int v = box.top; v < box.bottom; ++v) {
    const ProjectedRow& row = projector.project(depth, v, box);
    for (int u = box.left; u < box.right; ++u) {
      const float i = row.u_px[u] + 0.5f, j = row.v_px[u] + 0.5f;  // truncated: the nearest pixel
      if (!(row.z[u] > 0 && i >= 0 && j >= 0 && i < width && j < height)) continue;
      const int u_rgb = static_cast<int>(i), v_rgb = static_cast<int>(j);
      if (row.z[u] > nearest.at<float>(v_rgb, u_rgb) + tolerance) continue;
      mapped.color(u, v) = color(u_rgb, v_rgb);
      mapped.has_color(u, v) = 1;
    }
  }
  return mapped;
}

}  // namespace glovebench
