#pragma once

#include <string>
#include <vector>

#include "core/calibration/color_samples.h"
#include "eval/label_errors.h"
#include "eval/studies/study.h"

namespace glovebench::eval {

struct LightPoint {
  double value = 0;
  render::Lighting lighting;
  Eigen::Vector3d white_balance = Eigen::Vector3d::Ones();  ///< gains on linear R, G, B
};
/// Light that varies in one property.
struct LightAxis {
  std::string table;  ///< "light_strength"
  std::string title;
  std::string column;  ///< "strength", "temperature_k"
  std::string heading;
  std::vector<LightPoint> points;
};
/// Strength 1/8 to 4 times the default, 2000 to 10000 K, green gain 0.6 to 1.67. `quick`: two each.
std::vector<LightAxis> light_axes(bool quick);

/// An unlabeled recording for calibration, of Tr2, Tr3 and Tr5.
calibration::ColorSamples record_under(Workbench& workbench, int subject, const LightPoint& point, int frames);

/// `errors` is empty where calibration failed.
struct LightWay {
  std::string name;
  std::optional<LabelErrors> errors;
};
/// Eight hands of Tr1 and Tr4 with the tracker's, the recalibrated (plain and filtered) and the best table.
std::vector<LightWay> measure_light_point(Workbench& workbench, int subject, const LightPoint& point);

/// One table per axis. light_curves.*: mean share of correct glove pixels at strengths 0.5 to 2 and 3000 to 6500 K.
reports::StudyResult run_light_curves(const StudyContext& context);

}  // namespace glovebench::eval
