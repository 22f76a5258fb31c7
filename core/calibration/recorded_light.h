#pragma once

#include <span>

#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"

namespace glovebench::calibration {

/// The change from the seeds' light and camera to the recording's.
struct RecordedLight {
  Eigen::Array3d gain = Eigen::Array3d::Ones();  ///< on linear R, G, B; G = 1
  /// Factor on the chroma: > 1 in weak light, < 1 with haze or reflections.
  double saturation = 1;
};

ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light);

/// Maximizes the sum over the ten colors of the log sample density at the relit seed. Hence neither a missing color
/// nor a large patch dominates. Without samples the light is unchanged.
RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma);

}  // namespace glovebench::calibration
