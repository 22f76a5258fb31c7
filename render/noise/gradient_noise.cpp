#include "render/noise/depth_gradient.h"
#include "render/noise/noise_model.h"

namespace glovebench::render {
namespace {

DepthImage add_gradient_noise(const DepthImage& depth, const PinholeCamera&, const NoiseConfig& config,
                              const FrameKey& key) {
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

}  // namespace

DepthNoise gradient_noise() {
  return {"gradient", "section IV: Gaussian, with a variance that follows the depth gradient", add_gradient_noise};
}

}  // namespace glovebench::render
