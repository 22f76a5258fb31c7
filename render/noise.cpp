#include "render/noise.h"

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/random.h"

namespace glovebench::render {
namespace {

/// Disparity in steps of 1/8 px is kStepsMetre / z up to an offset (see core/kinect/disparity.h).
constexpr double kStepsMetre = 345.489;
/// Values that differ by more than this lie on different surfaces and are not interpolated, m.
constexpr float kSurfaceStep = 0.02f;

/// Standard normal quantiles at the centers of 65,536 equal shares of probability. Looking a number up is ten times
/// as fast as Box-Muller; the tails end at 4.3 sigma.
std::vector<float> make_normal_quantiles() {
  constexpr int kCount = 1 << 16;
  std::vector<float> quantiles(kCount);
  double x = 0;
  for (int i = kCount / 2; i < kCount; ++i) {
    const double upper_tail = 1.0 - (i + 0.5) / kCount;
    // Newton's method from the neighbor's quantile; the tail is convex there, so that it converges from below.
    for (int step = 0; step < 20; ++step) {
      const double tail = 0.5 * std::erfc(x / std::sqrt(2.0));
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      const double change = (tail - upper_tail) / density;
      x += change;
      if (std::abs(change) < 1e-12) break;
    }
    quantiles[i] = static_cast<float>(x);
    quantiles[kCount - 1 - i] = -quantiles[i];
  }
  return quantiles;
}

/// Random numbers of one image row (SplitMix64), so that rows can be made in any order.
class RowRandom {
 public:
  explicit RowRandom(uint64_t state) : state_(state) {}

  float normal() {
    static const std::vector<float> quantiles = make_normal_quantiles();
    return quantiles[next16()];
  }
  float uniform() { return static_cast<float>(next16()) * 0x1p-16f; }

 private:
  uint16_t next16() {
    if (left_ == 0) {
      state_ += 0x9e3779b97f4a7c15u;
      word_ = state_;
      word_ = (word_ ^ (word_ >> 30)) * 0xbf58476d1ce4e5b9u;
      word_ = (word_ ^ (word_ >> 27)) * 0x94d049bb133111ebu;
      word_ ^= word_ >> 31;
      left_ = 4;
    }
    const auto value = static_cast<uint16_t>(word_);
    word_ >>= 16;
    --left_;
    return value;
  }

  uint64_t state_;
  uint64_t word_ = 0;
  int left_ = 0;
};

std::vector<uint64_t> row_seeds(const FrameKey& key, std::string_view purpose, int rows) {
  RandomStream stream(key.seed, key.sequence, key.frame, purpose);
  std::vector<uint64_t> seeds(rows);
  for (uint64_t& seed : seeds) seed = stream.bits();
  return seeds;
}

float central_difference(float before, float here, float after) {
  if (before > 0 && after > 0) return (after - before) / 2;
  if (after > 0) return after - here;
  if (before > 0) return here - before;
  return 0;
}

/// The one-sided difference of smaller magnitude: the slope of the surface itself, not of the step at its border.
float surface_difference(float before, float here, float after) {
  if (before > 0 && after > 0) {
    return std::abs(after - here) < std::abs(here - before) ? after - here : here - before;
  }
  return central_difference(before, here, after);
}

struct Gradient {
  float du, dv;
};

template <typename Difference>
Gradient gradient(const DepthImage& depth, int u, int v, Difference difference) {
  const float z = depth(u, v);
  const float left = u > 0 ? depth(u - 1, v) : 0;
  const float right = u + 1 < depth.width() ? depth(u + 1, v) : 0;
  const float above = v > 0 ? depth(u, v - 1) : 0;
  const float below = v + 1 < depth.height() ? depth(u, v + 1) : 0;
  return {difference(left, z, right), difference(above, z, below)};
}

DepthImage add_gradient_noise(const DepthImage& depth, const NoiseConfig& config, const FrameKey& key) {
  const Image<float> gradients = gradient_magnitude(depth);
  const std::vector<uint64_t> seeds = row_seeds(key, "depth noise", depth.height());
  const auto gain = static_cast<float>(config.gain_factor * kGradientGain);
  DepthImage noisy = depth;
  for (int v = 0; v < depth.height(); ++v) {
    RowRandom random(seeds[v]);
    for (int u = 0; u < depth.width(); ++u) {
      const float noise = random.normal() * std::sqrt(gain * gradients(u, v));
      if (depth(u, v) > 0) noisy(u, v) = std::max(0.0f, depth(u, v) + noise);
    }
  }
  return noisy;
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
  const Image<uint8_t> shadow = projector_shadow(depth, camera, config.projector_baseline);
  const std::vector<uint64_t> seeds = row_seeds(key, "depth noise", depth.height());
  const auto lateral_px = static_cast<float>(config.lateral_sigma_px);
  const auto from = static_cast<float>(radians_from_degrees(config.grazing_from_deg));
  const auto to = static_cast<float>(radians_from_degrees(config.grazing_to_deg));
  const float cosine_from = std::cos(from);
  DepthImage noisy(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    RowRandom random(seeds[v]);
    for (int u = 0; u < depth.width(); ++u) {
      // All numbers are drawn for every pixel, so that a change in one place leaves the noise elsewhere as it was.
      const float shift_u = lateral_px * random.normal();
      const float shift_v = lateral_px * random.normal();
      const double disparity_noise = config.disparity_sigma_steps * random.normal();
      const float chance = random.uniform();
      if (depth(u, v) <= 0 || shadow(u, v)) continue;
      const float cosine = incidence_cosine(depth, u, v, camera);
      if (cosine < cosine_from && chance < (std::acos(cosine) - from) / (to - from)) continue;
      const float z = sample(depth, static_cast<float>(u) + shift_u, static_cast<float>(v) + shift_v);
      if (z < config.min_depth || z <= 0) continue;
      const double disparity = kStepsMetre / z + disparity_noise;
      if (disparity > 0) noisy(u, v) = static_cast<float>(kStepsMetre / disparity);
    }
  }
  return noisy;
}

}  // namespace

DepthNoise depth_noise_from_string(std::string_view name) {
  const auto noise = from_name<DepthNoise>(name);
  if (!noise) throw Error("noise", "depth", "\"" + std::string(name) + "\"", known_names<DepthNoise>());
  return *noise;
}

std::vector<std::string> NoiseConfig::problems() const {
  std::vector<std::string> found;
  const auto require = [&found](bool fine, const char* problem) {
    if (!fine) found.emplace_back(problem);
  };
  require(gain_factor >= 0, "gain_factor must be >= 0");
  require(color_sigma_gray >= 0, "color_sigma_gray must be >= 0");
  require(lateral_sigma_px >= 0, "lateral_sigma_px must be >= 0");
  require(disparity_sigma_steps >= 0, "disparity_sigma_steps must be >= 0");
  require(grazing_from_deg >= 0 && grazing_from_deg < grazing_to_deg && grazing_to_deg <= 90,
          "0 <= grazing_from_deg < grazing_to_deg <= 90 must hold");
  require(min_depth >= 0, "min_depth must be >= 0");
  require(projector_baseline >= 0, "projector_baseline must be >= 0");
  return found;
}

Image<float> gradient_magnitude(const DepthImage& depth) {
  Image<float> magnitude(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (depth(u, v) <= 0) continue;
      const Gradient slope = gradient(depth, u, v, central_difference);
      magnitude(u, v) = std::sqrt(slope.du * slope.du + slope.dv * slope.dv);
    }
  }
  return magnitude;
}

DepthImage add_depth_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                           const FrameKey& key) {
  switch (config.depth) {
    case DepthNoise::none:
      return depth;
    case DepthNoise::gradient:
      return add_gradient_noise(depth, config, key);
    case DepthNoise::kinect:
      return add_kinect_noise(depth, camera, config, key);
  }
  return depth;
}

ColorImage add_color_noise(const ColorImage& color, const NoiseConfig& config, const FrameKey& key) {
  const std::vector<uint64_t> seeds = row_seeds(key, "color noise", color.height());
  const auto sigma_gray = static_cast<float>(config.color_sigma_gray);
  ColorImage noisy = color;
  for (int v = 0; v < color.height(); ++v) {
    RowRandom random(seeds[v]);
    for (int u = 0; u < color.width(); ++u) {
      for (uint8_t& channel : noisy(u, v)) {
        const float value = static_cast<float>(channel) + sigma_gray * random.normal();
        channel = static_cast<uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
      }
    }
  }
  return noisy;
}

}  // namespace glovebench::render
