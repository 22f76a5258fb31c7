#pragma once

#include <string>
#include <vector>

#include "core/calibration/color_samples.h"
#include "eval/label_errors.h"
#include "eval/studies/study.h"

namespace glovebench::eval {

/// One place on a curve: a light, and a white balance that has drifted.
struct LightPoint {
  double value = 0;  ///< of what varies
  render::Lighting lighting;
  Eigen::Vector3d white_balance = Eigen::Vector3d::Ones();  ///< gains on linear R, G, B
};
/// What varies while the rest stays as the tracker's default has it.
struct LightAxis {
  std::string table;    ///< "light_strength"
  std::string title;    ///< to read
  std::string column;   ///< "strength", "temperature_k"
  std::string heading;  ///< of the column, to read
  std::vector<LightPoint> points;
};
/// Strengths of an eighth to four times the default's, 2000 to 10000 K, and gains of green against red and blue of
/// 0.6 to 1.67, which no temperature makes. `quick`: two of each.
std::vector<LightAxis> light_axes(bool quick);

/// What a user would record under that light to calibrate from: movements on which no curve is measured (Tr2, Tr3,
/// Tr5), without their truth.
calibration::ColorSamples record_under(Workbench& workbench, int subject, const LightPoint& point, int frames);

/// What a way to label came to; nothing where no table could be calibrated.
struct LightWay {
  std::string name;
  std::optional<LabelErrors> errors;
};
/// Over eight hands of Tr1 and Tr4: the tracker's own table, and the one that `calibrate colors` makes of a
/// recording under that light, each as in the paper and with filters; at last the table that labels most of these
/// very pixels right, which no table over such cells can surpass.
std::vector<LightWay> measure_light_point(Workbench& workbench, int subject, const LightPoint& point);

/// A table for each of the axes, and the measures light_curves.*: the mean share of the glove's pixels that are
/// right from half to double strength and 3000 to 6500 K.
reports::StudyResult run_light_curves(const StudyContext& context);

}  // namespace glovebench::eval
