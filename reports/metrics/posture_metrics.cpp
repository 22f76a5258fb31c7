#include "core/base/math.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

using Chosen = std::array<bool, kAngleCount>;

/// The mean over the chosen angles. Empty if none is chosen.
std::optional<double> mean_of(const Posture& values, const Chosen& chosen) {
  double sum = 0;
  int count = 0;
  for (int a = 0; a < kAngleCount; ++a) {
    if (!chosen[a]) continue;
    sum += values[a];
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> rms_deg(const Posture& difference, const Chosen& chosen) {
  const std::optional<double> square = mean_of(difference.cwiseAbs2(), chosen);
  return square ? std::optional(degrees_from_radians(std::sqrt(*square))) : std::nullopt;
}

std::optional<double> mean_abs_deg(const Posture& difference, const Chosen& chosen) {
  const std::optional<double> mean = mean_of(difference.cwiseAbs(), chosen);
  return mean ? std::optional(degrees_from_radians(*mean)) : std::nullopt;
}

Chosen all_angles() {
  Chosen chosen;
  chosen.fill(true);
  return chosen;
}

Chosen without_wrist() {
  Chosen chosen = all_angles();
  chosen[kWristFlexion] = chosen[kWristAbduction] = false;
  return chosen;
}

Chosen observed_angles(const std::array<int, kPatchCount>& visible_pixels) {
  Chosen observed;
  for (int a = 0; a < kAngleCount; ++a) {
    int pixels = 0;
    for (int p = 0; p < kPatchCount; ++p)
      if (patches_moved()[a] >> p & 1) pixels += visible_pixels[p];
    observed[a] = pixels >= kObservedPixels;
  }
  return observed;
}

Chosen hidden_angles(const std::array<int, kPatchCount>& visible_pixels) {
  Chosen hidden = observed_angles(visible_pixels);
  for (bool& chosen : hidden) chosen = !chosen;
  return hidden;
}

Posture difference(const MeasuredFrame& frame) { return frame.estimate.posture - frame.truth.posture; }

}  // namespace

std::vector<Metric> posture_metrics() {
  using Frame = const MeasuredFrame&;
  return {
      {.key = "posture_rms_deg",
       .unit = "deg",
       .description = "root mean square over the 22 angles: the headline posture error",
       .formula = "sqrt(sum over i of (a'_i - a_i)^2 / 22)",
       .place = 30,
       .gate = Metric::Gate{0.5, 0.01},
       .of_tracked = [](Frame f) { return rms_deg(difference(f), all_angles()); },
       .needs = Needs::posture},
      {.key = "posture_mean_abs_deg",
       .unit = "deg",
       .description = "mean absolute difference over the 22 angles",
       .formula = "sum over i of |a'_i - a_i| / 22",
       .place = 40,
       .of_tracked = [](Frame f) { return mean_abs_deg(difference(f), all_angles()); },
       .needs = Needs::posture},
      {.key = "posture_rms_without_wrist_deg",
       .unit = "deg",
       .description = "root mean square over the 20 angles of the fingers",
       .formula = "sqrt(sum over i of (a'_i - a_i)^2 / 20)",
       .place = 50,
       .of_tracked = [](Frame f) { return rms_deg(difference(f), without_wrist()); },
       .needs = Needs::posture},
      {.key = "posture_mean_abs_without_wrist_deg",
       .unit = "deg",
       .description = "mean absolute difference over the 20 angles of the fingers",
       .formula = "sum over i of |a'_i - a_i| / 20",
       .place = 60,
       .of_tracked = [](Frame f) { return mean_abs_deg(difference(f), without_wrist()); },
       .needs = Needs::posture},
      {.key = "posture_rms_observed_deg",
       .unit = "deg",
       .description = "root mean square over the angles that move at least 30 visible pixels",
       .formula = "sqrt(sum over the n observed i of (a'_i - a_i)^2 / n)",
       .place = 70,
       .of_tracked = [](Frame f) { return rms_deg(difference(f), observed_angles(f.truth.visible_pixels)); },
       .needs = Needs::posture,
       .is_partial = true},
      {.key = "posture_rms_hidden_deg",
       .unit = "deg",
       .description = "root mean square over the other angles",
       .formula = "sqrt(sum over the n hidden i of (a'_i - a_i)^2 / n)",
       .place = 80,
       .of_tracked = [](Frame f) { return rms_deg(difference(f), hidden_angles(f.truth.visible_pixels)); },
       .needs = Needs::posture,
       .is_partial = true},
      {.key = "posture_rms_unfiltered_deg",
       .unit = "deg",
       .description = "root mean square over the 22 angles, before the smoothing",
       .formula = "sqrt(sum over i of (b'_i - a_i)^2 / 22), b' the look-up's angles",
       .place = 90,
       .gate = Metric::Gate{0.5, 0.01},
       .of_tracked = [](Frame f) { return rms_deg(f.estimate.posture_unfiltered - f.truth.posture, all_angles()); },
       .needs = Needs::internals},
  };
}

}  // namespace glovebench::reports
