#include "core/camera/registration.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/base/recycled_vector.h"

namespace glovebench {
namespace {

constexpr float kInfinitelyFar = std::numeric_limits<float>::infinity();

Eigen::Matrix3d intrinsic_matrix(const PinholeCamera& camera) {
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return K;
}

/// A half-open range of columns.
struct Span {
  int left, right;
};

/// Where a depth image has values: its columns in each row, and the depths.
struct Extent {
  RecycledVector<Span> rows;
  int left, right, top, bottom;
  float least, largest;
};

/// Rows without values have empty ranges.
Extent extent_of(const DepthImage& depth) {
  Extent extent{RecycledVector<Span>(depth.height()), depth.width(), 0, depth.height(), 0, kInfinitelyFar, 0};
  // Positive floats sort like their bit patterns, so integer comparison vectorizes.
  int32_t largest = 0;
  uint32_t least = std::bit_cast<uint32_t>(kInfinitelyFar);
  for (int v = 0; v < depth.height(); ++v) {
    const float* const row = &depth(0, v);
    int32_t row_largest = 0;
    for (int u = 0; u < depth.width(); ++u) {
      const auto of_value = std::bit_cast<int32_t>(row[u]);
      const int32_t bits = of_value <= std::bit_cast<int32_t>(kInfinitelyFar) ? of_value : 0;  // 0 for NaN
      row_largest = std::max(row_largest, bits);
      least = std::min(least, static_cast<uint32_t>(bits) - 1);  // zero and negative values become large
    }
    if (row_largest == 0) continue;
    largest = std::max(largest, row_largest);
    const auto has_depth = [](float z) { return z > 0; };
    Span& span = extent.rows[v];
    span.left = static_cast<int>(std::find_if(row, row + depth.width(), has_depth) - row);
    span.right = depth.width();
    while (span.right > span.left && !(row[span.right - 1] > 0)) --span.right;
    extent.left = std::min(extent.left, span.left);
    extent.right = std::max(extent.right, span.right);
    extent.top = std::min(extent.top, v);
    extent.bottom = v + 1;
  }
  extent.least = std::bit_cast<float>(least + 1);
  extent.largest = std::bit_cast<float>(largest);
  return extent;
}

/// The pixels of one depth row in the RGB camera; z is 0 or negative where there is nothing to see.
struct ProjectedRow {
  const float *u_px, *v_px, *z;
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
    u_px_ = v_px_ = z_ = RecycledVector<float>(width);
  }

  /// Valid until the next call.
  ProjectedRow project(const DepthImage& depth, int v, const Span& span) {
    const Eigen::Vector3f start = M_.col(1) * static_cast<float>(v) + M_.col(2);
    const Eigen::Vector3f step = M_.col(0);
    const Eigen::Vector3f b = b_;
    const float* d = &depth(0, v);
    float* const u_out = u_px_.data();
    float* const v_out = v_px_.data();
    float* const z_out = z_.data();
    for (int u = span.left; u < span.right; ++u) {
      const float fu = static_cast<float>(u);
      const float z = d[u] * (start.z() + step.z() * fu) + b.z();
      const float x = d[u] * (start.x() + step.x() * fu) + b.x();
      const float y = d[u] * (start.y() + step.y() * fu) + b.y();
      const float inverse = 1.0f / z;
      u_out[u] = x * inverse;
      v_out[u] = y * inverse;
      z_out[u] = d[u] > 0 ? z : 0.0f;
    }
    return {u_out, v_out, z_out};
  }

  /// Pixels of the RGB camera among which all values lie, within a rounding; empty if it cannot be told.
  std::optional<Eigen::AlignedBox2f> bounds(const Extent& extent) const {
    // A perspective image of a convex body lies among those of its corners.
    Eigen::AlignedBox2f box;
    for (const int u : {extent.left, extent.right - 1}) {
      for (const int v : {extent.top, extent.bottom - 1}) {
        for (const float z : {extent.least, extent.largest}) {
          const Eigen::Vector3f pixel =
              z * (M_ * Eigen::Vector3f(static_cast<float>(u), static_cast<float>(v), 1)) + b_;
          // Beside the camera, what little is left of a difference is rounding.
          if (!(pixel.z() > 1e-3f * (z + std::abs(b_.z())) && pixel.allFinite())) return {};
          box.extend(Eigen::Vector2f(pixel.hnormalized()));
        }
      }
    }
    return box;
  }

 private:
  Eigen::Matrix3f M_;
  Eigen::Vector3f b_;
  RecycledVector<float> u_px_, v_px_, z_;
};

/// How far (px) a depth sample reaches in the RGB image, so that neighboring samples of one surface leave no gap:
/// they lie about f_rgb / f_ir apart, half as much again where the surface faces the RGB camera more.
int splat_radius(const RgbdCalibration& calibration) {
  const double magnification =
      std::max(calibration.rgb.fx / calibration.ir.fx, calibration.rgb.fy / calibration.ir.fy);
  return std::max(1, static_cast<int>(std::ceil(0.75 * magnification)));
}

/// Each pixel takes the least of itself, the one to its right and the two below: done n times, of n + 1 by n + 1.
void take_nearer_neighbors(DepthImage& image) {
  const int width = image.width(), height = image.height();
  for (int v = 0; v < height; ++v) {
    float* const row = &image(0, v);
    for (int u = 0; u + 1 < width; ++u) row[u] = std::min(row[u], row[u + 1]);
    if (v == 0) continue;
    float* const above = row - width;
    for (int u = 0; u < width; ++u) above[u] = std::min(above[u], row[u]);
  }
}

/// Half-open ranges of cells.
struct Cells {
  int left, top, right, bottom;
};

/// The nearest surface that the RGB camera sees at its pixels, from the depth samples within the splat radius;
/// infinite where there is none.
class NearestSurface {
 public:
  NearestSurface(const DepthImage& depth, const Extent& extent, const RgbdCalibration& calibration,
                 RowProjector& projector)
      : radius_(splat_radius(calibration)),
        cells_of_(cells_of(extent, calibration, projector)),
        nearest_(cells_of_.right - cells_of_.left, cells_of_.bottom - cells_of_.top, kInfinitelyFar) {
    // Cell (i, j) collects the samples with floor(u) = i - radius, floor(v) = j - radius, so that the minimum over
    // the cells i .. i + 2 radius - 1 is the one over u in [i - radius, i + radius).
    const float width = static_cast<float>(calibration.rgb.width + 2 * radius_ - 1),
                height = static_cast<float>(calibration.rgb.height + 2 * radius_ - 1),
                offset = static_cast<float>(radius_);
    for (int v = extent.top; v < extent.bottom; ++v) {
      const Span span = extent.rows[v];
      const ProjectedRow row = projector.project(depth, v, span);
      for (int u = span.left; u < span.right; ++u) {
        const float i = row.u_px[u] + offset, j = row.v_px[u] + offset;
        if (!(row.z[u] > 0 && i >= 0 && j >= 0 && i < width && j < height)) continue;
        float& cell = nearest_(static_cast<int>(i) - cells_of_.left, static_cast<int>(j) - cells_of_.top);
        cell = std::min(cell, row.z[u]);
      }
    }
    for (int step = 1; step < 2 * radius_; ++step) take_nearer_neighbors(nearest_);
  }

  /// Of a pixel on which a sample lies.
  float operator()(int u, int v) const { return nearest_(u - cells_of_.left, v - cells_of_.top); }

 private:
  /// The cells that a sample or a pixel on which one lies can have.
  Cells cells_of(const Extent& extent, const RgbdCalibration& calibration, const RowProjector& projector) const {
    const Eigen::Array2i all(calibration.rgb.width + 2 * radius_ - 1, calibration.rgb.height + 2 * radius_ - 1);
    const auto bounds = projector.bounds(extent);
    if (!bounds) return {0, 0, all.x(), all.y()};
    // A pixel more on each side for rounding; clamped while these are numbers of any size.
    const Eigen::Array2f limit = all.cast<float>();
    const Eigen::Array2i low = (bounds->min().array() - 2).max(0).min(limit - 1).cast<int>();
    const Eigen::Array2i high =
        (bounds->max().array() + static_cast<float>(2 * radius_ + 2)).max(1).min(limit).cast<int>();
    return {low.x(), low.y(), high.x(), high.y()};
  }

  int radius_;
  Cells cells_of_;
  DepthImage nearest_;
};

}  // namespace

RegisteredImage register_color(const DepthImage& depth, const ColorImage& color, const RgbdCalibration& calibration,
                               const RegistrationConfig& config) {
  check(depth.width() == calibration.ir.width && depth.height() == calibration.ir.height,
        "the depth image has the size of the calibrated IR camera");
  check(color.width() == calibration.rgb.width && color.height() == calibration.rgb.height,
        "the color image has the size of the calibrated RGB camera");
  check(!calibration.has_lens(), "images are rectified before they are registered");

  RowProjector projector(calibration);
  const Extent extent = extent_of(depth);
  RegisteredImage mapped{ColorImage(depth.width(), depth.height()), Image<uint8_t>(depth.width(), depth.height())};
  if (extent.top >= extent.bottom) return mapped;
  const NearestSurface nearest(depth, extent, calibration, projector);
  const float tolerance = static_cast<float>(config.occlusion_tolerance);
  const float width = static_cast<float>(color.width()), height = static_cast<float>(color.height());

  for (int v = extent.top; v < extent.bottom; ++v) {
    const Span span = extent.rows[v];
    const ProjectedRow row = projector.project(depth, v, span);
    Rgb* const mapped_color = mapped.color.row(v);
    uint8_t* const has_color = mapped.has_color.row(v);
    for (int u = span.left; u < span.right; ++u) {
      const float i = row.u_px[u] + 0.5f, j = row.v_px[u] + 0.5f;  // truncated: the nearest pixel
      if (!(row.z[u] > 0 && i >= 0 && j >= 0 && i < width && j < height)) continue;
      const int u_rgb = static_cast<int>(i), v_rgb = static_cast<int>(j);
      if (row.z[u] > nearest(u_rgb, v_rgb) + tolerance) continue;
      mapped_color[u] = color.data()[static_cast<size_t>(v_rgb) * color.width() + u_rgb];
      has_color[u] = 1;
    }
  }
  return mapped;
}

}  // namespace glovebench
