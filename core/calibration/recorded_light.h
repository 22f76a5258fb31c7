#pragma once

#include <span>

#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"

namespace glovebench::calibration {

/// The change of light and camera between seeds and recording.
struct RecordedLight {
  Eigen::Array3d gain = Eigen::Array3d::Ones();  ///< on linear R, G, B; 1 for G
  /// Factor on the chroma: > 1 in weak light, < 1 with haze or reflections.
  double saturation = 1;
};

ColorSeeds relit(const ColorSeeds& seeds, const RecordedLight& light);

/// Estimates the light that places the seeds where samples are dense. Without samples it is the seeds' own.
RecordedLight estimate_light(const ColorSeeds& seeds, std::span<const ColorSample> samples, double min_luma);

}  // namespace glovebench::calibration
