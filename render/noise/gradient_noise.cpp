#include "render/noise/depth_gradient.h"
#include "render/noise/noise_model.h"

namespace glovebench::render {
namespace {

DepthImage add_gradient_noise(const DepthImage& depth, const PinholeCamera&, const NoiseConfig& config,
                              const FrameKey& key) {
  const std::vector<uint64_t> seeds = row_seeds(key, "depth noise", depth.height());
  const auto gain = static_cast<float>(config.gain_factor * kGradientGain);
  DepthImage noisy = depth;
  for (int v = 0; v < depth.height(); ++v) {
    const RowRandom random(seeds[v]);
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v), gradient = z > 0 ? gradient_magnitude(depth, u, v) : 0;
      if (gradient > 0) noisy(u, v) = std::max(0.0f, z + random.normal(u) * std::sqrt(gain * gradient));
    }
  }
  return noisy;
}

}  // namespace

DepthNoise gradient_noise() {
  return {"gradient", "section IV: Gaussian, with a variance that follows the depth gradient", add_gradient_noise};
}

}  // namespace glovebench::render
