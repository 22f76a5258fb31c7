#pragma once

#include <span>

#include "eval/label_errors.h"
#include "eval/studies/settings.h"

namespace glovebench::eval {

/// A color table of the study, and what its errors came to under each lighting.
struct LightResult {
  std::string calibration;  ///< to read
  ColorSpace space = ColorSpace::yuv;
  std::vector<LabelErrors> errors;  ///< one a lighting
};
/// By calibration (the tracker's own, then that under one lighting) and space.
std::vector<LightResult> measure_light(Workbench& workbench, std::span<const render::Lighting> lightings);

/// Tables "light" and "light_tracking", and the measure light.rgb_excess_percent. `quick`: two lightings each.
reports::StudyResult run_light(const StudyContext& context);

}  // namespace glovebench::eval
