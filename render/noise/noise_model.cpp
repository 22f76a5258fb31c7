#include "render/noise/noise_model.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/registry.h"

namespace glovebench::render {

std::vector<std::string> NoiseConfig::problems() const {
  std::vector<std::string> found;
  const auto require = [&found](bool fine, const char* problem) {
    if (!fine) found.emplace_back(problem);
  };
  const std::vector<std::string> names = names_in(depth_noises());
  if (std::ranges::find(names, depth) == names.end())
    found.push_back(fmt::format("depth must be one of {}", fmt::join(names, ", ")));
  require(gain_factor >= 0, "gain_factor must be >= 0");
  require(color_sigma_gray >= 0, "color_sigma_gray must be >= 0");
  require(kinect.lateral_sigma_px >= 0, "lateral_sigma_px must be >= 0");
  require(kinect.disparity_sigma_steps >= 0, "disparity_sigma_steps must be >= 0");
  require(kinect.grazing_from_deg >= 0 && kinect.grazing_from_deg < kinect.grazing_to_deg &&
              kinect.grazing_to_deg <= 90,
          "0 <= grazing_from_deg < grazing_to_deg <= 90 must hold");
  require(kinect.min_depth >= 0, "min_depth must be >= 0");
  require(kinect.projector_baseline >= 0, "projector_baseline must be >= 0");
  return found;
}

const DepthNoise& find_depth_noise(std::string_view name) {
  return find_in(depth_noises(), name, "noise", "depth");
}

DepthImage add_depth_noise(const DepthImage& depth, const PinholeCamera& camera, const NoiseConfig& config,
                           const FrameKey& key) {
  return find_depth_noise(config.depth).add(depth, camera, config, key);
}

}  // namespace glovebench::render
