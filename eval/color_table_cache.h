#pragma once

#include <memory>
#include <string>

#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_model.h"
#include "core/segmentation/color_calibration.h"
#include "render/lighting.h"

namespace glovebench::eval {

/// Strength 0.7 to 1.4, 3500 to 5500 K, three directions.
std::vector<render::Lighting> calibration_lightings();

struct ColorTableConfig {
  ColorSpace space = ColorSpace::yuv;
  std::vector<render::Lighting> lightings = calibration_lightings();
  ColorModel model;
};
/// For comparison: strength 1, 4500 K, no relighting.
ColorTableConfig one_lighting(ColorSpace space);

/// Calibrates from rendered, labeled views of the gloved hand.
/// Paper: section III-A.
ColorTable calibrate_colors(const std::shared_ptr<const HandModel>& model, const RgbdCalibration& calibration,
                            const std::vector<Posture>& postures, const ColorTableConfig& config = {});

std::string color_table_source_hash();

/// Calibrates with all lightings. Caches the table in `folder` by the hash of inputs and sources.
ColorTable cached_color_table(const std::string& folder, const std::shared_ptr<const HandModel>& model,
                              const RgbdCalibration& calibration, const std::vector<Posture>& postures,
                              ColorSpace space = ColorSpace::yuv);

}  // namespace glovebench::eval
