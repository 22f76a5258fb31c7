#pragma once

#include <memory>
#include <string>

#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_model.h"
#include "core/segmentation/color_calibration.h"
#include "render/lighting.h"

namespace glovebench::eval {

/// The lightings under which the color table is calibrated: strength 0.7 to 1.4, 3500 to 5500 K, three directions.
/// The tests use others, from half to double strength and from 3000 to 6500 K.
std::vector<render::Lighting> calibration_lightings();

/// From what a color table is calibrated, and over which space.
struct ColorTableConfig {
  ColorSpace space = ColorSpace::yuv;
  std::vector<render::Lighting> lightings = calibration_lightings();
  ColorModel model;
};
/// Calibrated under one lighting (strength 1, 4500 K) without relighting: such a table shows how much light of
/// another kind moves the colors of a space.
ColorTableConfig one_lighting(ColorSpace space);

/// Calibrates the color table from rendered, labeled views of the gloved hand in its scene (section III-A).
ColorTable calibrate_colors(std::shared_ptr<const HandModel> model, const RgbdCalibration& calibration,
                            const std::vector<Posture>& postures, const ColorTableConfig& config = {});

/// Hash of the sources that decide which table calibrate_colors makes of its inputs (ci/source_hash.cmake).
std::string color_table_source_hash();

/// The table with all lightings, kept in `folder` under a name that holds the hash of all inputs and of the
/// sources. A damaged file, or one of an older version, is calibrated anew.
ColorTable cached_color_table(const std::string& folder, std::shared_ptr<const HandModel> model,
                              const RgbdCalibration& calibration, const std::vector<Posture>& postures,
                              ColorSpace space = ColorSpace::yuv);

}  // namespace glovebench::eval
