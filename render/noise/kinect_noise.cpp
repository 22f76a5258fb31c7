#include "core/base/math.h"
#include "render/noise/depth_gradient.h"
#include "render/noise/noise_model.h"

namespace glovebench::render {
namespace {

/// Disparity in steps of 1/8 px is kStepsMetre / z up to an offset (see core/kinect/disparity.h).
constexpr double kStepsMetre = 345.489;
/// Values that differ by more than this lie on different surfaces and are not interpolated, m.
constexpr float kSurfaceStep = 0.02f;

/// The one-sided difference of smaller magnitude: the slope of the surface itself, not of the step at its border.
float surface_difference(float before, float here, float after) {
  if (before > 0 && after > 0)
    return std::abs(after - here) < std::abs(here - before) ? after - here : here - before;
  return central_difference(before, here, after);
}

/// Cosine of the angle between the viewing ray and the surface normal.
float incidence_cosine(const DepthImage& depth, int u, int v, const PinholeCamera& camera) {
  const Gradient slope = gradient(depth, u, v, surface_difference);
  const float z = depth(u, v);
  const Eigen::Vector3f ray = camera.back_project(u, v, 1.0).cast<float>();
  const Eigen::Vector3f along_u = ray * slope.du + Eigen::Vector3f(z / static_cast<float>(camera.fx), 0, 0);
  const Eigen::Vector3f along_v = ray * slope.dv + Eigen::Vector3f(0, z / static_cast<float>(camera.fy), 0);
  const Eigen::Vector3f normal = along_u.cross(along_v);
  return std::abs(normal.dot(ray)) / std::sqrt(normal.squaredNorm() * ray.squaredNorm());
}

/// 1 where the projector's light is blocked. The projector stands to the right of the camera, so a point at u is
/// lit in the projector's column u - f b / z; on a row these columns rise with u unless something nearer, further
/// right, stands in the way.
Image<uint8_t> projector_shadow(const DepthImage& depth, const PinholeCamera& camera, double baseline) {
  Image<uint8_t> shadow(depth.width(), depth.height());
  const auto parallax = static_cast<float>(camera.fx * baseline);
  for (int v = 0; v < depth.height(); ++v) {
    float leftmost_column = std::numeric_limits<float>::max();
    for (int u = depth.width() - 1; u >= 0; --u) {
      if (depth(u, v) <= 0) continue;
      const float column = static_cast<float>(u) - parallax / depth(u, v);
      shadow(u, v) = column > leftmost_column;
      leftmost_column = std::min(leftmost_column, column);
    }
  }
  return shadow;
}

/// z at a position between pixels: bilinear on one surface, the nearest pixel's at a step.
float sample(const DepthImage& depth, float u_px, float v_px) {
  const float u_clamped = std::clamp(u_px, 0.0f, static_cast<float>(depth.width() - 1));
  const float v_clamped = std::clamp(v_px, 0.0f, static_cast<float>(depth.height() - 1));
  const int u = std::min(static_cast<int>(u_clamped), std::max(0, depth.width() - 2));
  const int v = std::min(static_cast<int>(v_clamped), std::max(0, depth.height() - 2));
  const int u_next = std::min(u + 1, depth.width() - 1);
  const int v_next = std::min(v + 1, depth.height() - 1);
  const float a = u_clamped - static_cast<float>(u);
  const float b = v_clamped - static_cast<float>(v);
  const std::array<float, 4> z = {depth(u, v), depth(u_next, v), depth(u, v_next), depth(u_next, v_next)};
  const auto [nearest, farthest] = std::minmax_element(z.begin(), z.end());
  if (*farthest - *nearest > kSurfaceStep) return z[(a >= 0.5f ? 1 : 0) + (b >= 0.5f ? 2 : 0)];
  return (1 - b) * ((1 - a) * z[0] + a * z[1]) + b * ((1 - a) * z[2] + a * z[3]);
}

DepthImage add_kinect_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                            const FrameKey& key) {
  const Image<uint8_t> shadow = projector_shadow(depth, camera, config.kinect.projector_baseline);
  const std::vector<uint64_t> seeds = row_seeds(key, "depth noise", depth.height());
  const auto lateral_px = static_cast<float>(config.kinect.lateral_sigma_px);
  const auto from = static_cast<float>(radians_from_degrees(config.kinect.grazing_from_deg));
  const auto to = static_cast<float>(radians_from_degrees(config.kinect.grazing_to_deg));
  const float cosine_from = std::cos(from);
  DepthImage noisy(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    const RowRandom random(seeds[v]);
    for (int u = 0; u < depth.width(); ++u) {
      // Each pixel has its own numbers, so that a change in one place leaves the noise elsewhere as it was.
      const float shift_u = lateral_px * random.normal(4 * u);
      const float shift_v = lateral_px * random.normal(4 * u + 1);
      const double disparity_noise = config.kinect.disparity_sigma_steps * random.normal(4 * u + 2);
      const float chance = random.uniform(4 * u + 3);
      if (depth(u, v) <= 0 || shadow(u, v)) continue;
      const float cosine = incidence_cosine(depth, u, v, camera);
      if (cosine < cosine_from && chance < (std::acos(cosine) - from) / (to - from)) continue;
      const float z = sample(depth, static_cast<float>(u) + shift_u, static_cast<float>(v) + shift_v);
      if (z < config.kinect.min_depth || z <= 0) continue;
      const double disparity = kStepsMetre / z + disparity_noise;
      if (disparity > 0) noisy(u, v) = static_cast<float>(kStepsMetre / disparity);
    }
  }
  return noisy;
}

}  // namespace

DepthNoise kinect_noise() {
  return {"kinect", "in the disparity domain: lateral shift, disparity noise, dropouts, projector shadow",
          add_kinect_noise};
}

}  // namespace glovebench::render
