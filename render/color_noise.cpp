#include "render/color_noise.h"

#include <algorithm>

namespace glovebench::render {

ColorImage add_color_noise(const ColorImage& color, double sigma_gray, const FrameKey& key) {
  const std::vector<uint64_t> seeds = row_seeds(key, "color noise", color.height());
  const auto sigma = static_cast<float>(sigma_gray);
  ColorImage noisy = color;
  for (int v = 0; v < color.height(); ++v) {
    RowRandom random(seeds[v]);
    for (int u = 0; u < color.width(); ++u) {
      for (uint8_t& channel : noisy(u, v)) {
        const float value = static_cast<float>(channel) + sigma * random.normal();
        channel = static_cast<uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
      }
    }
  }
  return noisy;
}

}  // namespace glovebench::render
