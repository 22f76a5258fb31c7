#include "render/noise/noise_model.h"

namespace glovebench::render {

DepthNoise none_noise() {
  return {"none", "none but the 11 bits of disparity",
          [](const DepthImage& depth, const PinholeCamera&, const NoiseConfig&, const FrameKey&) { return depth; }};
}

}  // namespace glovebench::render
