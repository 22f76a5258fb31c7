#include "core/calibration/color_report.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace glovebench::calibration {
namespace {

using Row = std::array<double, kColorCount + 1>;

/// The covariance of a color's pixels at that luma, with the camera's noise.
Eigen::Matrix2d seen_covariance(const GloveColor& color, double luma, double noise_gray) {
  const double noise = noise_gray / luma;
  return color.covariance + noise * noise * Eigen::Matrix2d::Identity();
}

double median_luma(const GloveColor& color) { return color.lumas[2]; }

Rgb rgb_of(const Chroma& chroma, double luma) {
  const Eigen::Array3d rgb = (luma * rgb_of_chroma(chroma)).round().max(0).min(255);
  return {static_cast<uint8_t>(rgb[0]), static_cast<uint8_t>(rgb[1]), static_cast<uint8_t>(rgb[2])};
}

/// The table's labels on a grid over a color's Gaussian, three deviations each way.
Row row_of_color(const GloveColor& color, double noise_gray, const ColorTable& table) {
  constexpr int kSteps = 12;  // each way
  Row row{};
  double sum = 0;
  for (const double luma : color.lumas) {
    const Eigen::Matrix2d root = seen_covariance(color, luma, noise_gray).llt().matrixL();
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        const Eigen::Vector2d place = Eigen::Vector2d(i, j) * (3.0 / kSteps);
        const double weight = std::exp(-0.5 * place.squaredNorm());
        row[table.label(rgb_of(color.center + root * place, luma))] += weight;
        sum += weight;
      }
    }
  }
  for (double& share : row) share /= sum;
  return row;
}

std::optional<Row> row_of_others(const ColorSamples& samples, const GloveColorFit& fit, const ColorTable& table) {
  Row row{};
  double sum = 0;
  for (const auto* of_place : {&samples.inside(), &samples.beyond()}) {
    for (const ColorSample& sample : *of_place) {
      if (fit.classify(sample.rgb) != kNotGlove) continue;
      ++row[table.label(sample.rgb)];
      ++sum;
    }
  }
  if (sum == 0) return {};
  for (double& share : row) share /= sum;
  return row;
}

void find_nearest(const GloveColorFit& fit, ColorSeparation& separation) {
  for (int k = 1; k <= kColorCount; ++k) {
    const GloveColor& color = fit.colors[k];
    separation.nearest_distance[k] = std::numeric_limits<double>::infinity();
    for (int other = 1; other <= kColorCount; ++other) {
      const Chroma between = fit.colors[other].center - color.center;
      if (other == k || between.norm() >= separation.nearest_distance[k]) continue;
      const Chroma along = between.normalized();
      const auto deviation = [&](const GloveColor& c) {
        return std::sqrt(along.dot(seen_covariance(c, median_luma(c), fit.noise_gray) * along));
      };
      separation.nearest[k] = other;
      separation.nearest_distance[k] = between.norm();
      separation.nearest_deviations[k] = between.norm() / (deviation(color) + deviation(fit.colors[other]));
    }
  }
}

double percent(double share) { return std::round(1e4 * share) / 100; }
double rounded(double value) { return std::round(1e4 * value) / 1e4; }
nlohmann::ordered_json json_of(const Chroma& chroma) { return {rounded(chroma[0]), rounded(chroma[1])}; }

double overexposed_share(const ColorSamples& samples) {
  const auto white = std::ranges::count_if(samples.inside(), is_overexposed, &ColorSample::rgb);
  return static_cast<double>(white) / static_cast<double>(std::max<size_t>(1, samples.inside().size()));
}

double dark_share(const ColorSamples& samples, const GloveColorFit& fit) {
  const auto dark = std::ranges::count_if(samples.inside(), [&](const ColorSample& sample) {
    return luma_of(array_of(sample.rgb)) < fit.config.min_luma;
  });
  return static_cast<double>(dark) / static_cast<double>(std::max<size_t>(1, samples.inside().size()));
}

std::string color_rows(const GloveColorFit& fit, const ColorSeparation& separation) {
  std::string text =
      "| color | pixels | frames | chroma u, v | nearest | distance | in deviations |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (int k = 1; k <= kColorCount; ++k) {
    const GloveColor& color = fit.colors[k];
    text += fmt::format("| {} | {} | {} | {:.3f}, {:.3f} | {} | {:.3f} | {:.1f} |\n", k, color.pixels, color.frames,
                        color.center[0], color.center[1], separation.nearest[k], separation.nearest_distance[k],
                        separation.nearest_deviations[k]);
  }
  return text;
}

std::string confusion_rows(const ColorSeparation& separation) {
  std::string text = "| is | none |", line = "|---:|---:|";
  for (int k = 1; k <= kColorCount; ++k) {
    text += fmt::format(" {} |", k);
    line += "---:|";
  }
  text += fmt::format("\n{}\n", line);
  for (int k = 0; k <= kColorCount; ++k) {
    if (!separation.confusion[k]) continue;
    text += k == 0 ? "| not glove |" : fmt::format("| {} |", k);
    for (const double share : *separation.confusion[k])
      text += share < 5e-4 ? "  |" : fmt::format(" {:.1f} |", 100 * share);
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json json_of(const GloveColor& color, int label, const ColorSeparation& separation) {
  return {{"label", label},
          {"chroma", json_of(color.center)},
          {"seed_chroma", json_of(color.seed)},
          {"deviation_chroma", rounded(std::sqrt(color.covariance.trace() / 2))},
          {"luma_gray", rounded(median_luma(color))},
          {"pixels", color.pixels},
          {"frames", color.frames},
          {"nearest_label", separation.nearest[label]},
          {"nearest_distance_chroma", rounded(separation.nearest_distance[label])},
          {"nearest_distance_deviations", rounded(separation.nearest_deviations[label])}};
}

}  // namespace

ColorSeparation separate_colors(const ColorSamples& samples, const GloveColorFit& fit, const ColorTable& table) {
  ColorSeparation separation;
  separation.confusion[0] = row_of_others(samples, fit, table);
  for (int k = 1; k <= kColorCount; ++k)
    separation.confusion[k] = row_of_color(fit.colors[k], fit.noise_gray, table);
  find_nearest(fit, separation);
  int64_t unlabeled = 0, mixed_unlabeled = 0;
  for (const ColorSample& sample : samples.inside()) {
    const uint8_t label = fit.classify(sample.rgb);
    unlabeled += label != kNotGlove && label != kUnsure && table.label(sample.rgb) == 0;
  }
  int64_t mixed = 0;  // with glove on one side
  for (const MixedSample& sample : samples.mixed()) {
    const uint8_t near = fit.classify(sample.near);
    if (near == kNotGlove || near == kUnsure) continue;
    ++mixed;
    mixed_unlabeled += table.label(sample.rgb) == 0;
  }
  separation.unlabeled_share = static_cast<double>(unlabeled + mixed_unlabeled) /
                               static_cast<double>(std::max<int64_t>(1, fit.glove + mixed));
  separation.mixed_unlabeled_share =
      static_cast<double>(mixed_unlabeled) / static_cast<double>(std::max<int64_t>(1, mixed));
  return separation;
}

std::vector<std::string> color_warnings(const ColorSamples& samples, const GloveColorFit& fit,
                                        const ColorSeparation& separation) {
  constexpr double kClose = 3.0;      // deviations of each bell: a pixel in 700 lies beyond
  constexpr double kAtReach = 0.95;   // of how far a color may lie from its seed
  constexpr double kClutter = 0.005;  // of the pixels beyond the volume
  constexpr double kExposure = 0.05;  // of the pixels in the volume
  constexpr double kConfused = 0.90;  // of a color's pixels
  std::vector<std::string> warnings;
  for (int k = 1; k <= kColorCount; ++k) {
    const GloveColor& color = fit.colors[k];
    if (color.pixels < fit.config.few_pixels || color.frames < fit.config.few_frames)
      warnings.push_back(
          fmt::format("color {} was seen little: {} pixels in {} frames", k, color.pixels, color.frames));
    if (separation.nearest_deviations[k] < kClose && k < separation.nearest[k])
      warnings.push_back(fmt::format("colors {} and {} lie close together: {:.1f} deviations of each", k,
                                     separation.nearest[k], separation.nearest_deviations[k]));
    if ((color.center - color.seed).norm() > kAtReach * color.reach)
      warnings.push_back(
          fmt::format("color {} lies as far from where the seeds have it as it may: is it this glove's?", k));
    if (separation.confusion[k] && (*separation.confusion[k])[k] < kConfused)
      warnings.push_back(
          fmt::format("of color {} the table labels {:.0f}% right", k, 100 * (*separation.confusion[k])[k]));
    const double like =
        static_cast<double>(fit.beyond_like[k]) / static_cast<double>(std::max<int64_t>(1, fit.beyond));
    if (like > kClutter)
      warnings.push_back(fmt::format("{:.1f}% of what lies beyond the volume looks like color {}", 100 * like, k));
  }
  const double white = overexposed_share(samples), dark = dark_share(samples, fit);
  if (white > kExposure)
    warnings.push_back(fmt::format("{:.0f}% of what is in the volume is overexposed", 100 * white));
  if (dark > kExposure)
    warnings.push_back(fmt::format("{:.0f}% of what is in the volume is too dark to tell a color", 100 * dark));
  return warnings;
}

nlohmann::ordered_json color_report_json(const ColorSamples& samples, const GloveColorFit& fit,
                                         const ColorSeparation& separation, const std::string& recording) {
  nlohmann::ordered_json colors = nlohmann::ordered_json::array();
  for (int k = 1; k <= kColorCount; ++k) colors.push_back(json_of(fit.colors[k], k, separation));
  nlohmann::ordered_json confusion = nlohmann::ordered_json::array();
  for (const std::optional<Row>& row : separation.confusion) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (size_t found = 0; row && found < row->size(); ++found) cells.push_back(percent((*row)[found]));
    confusion.push_back(row ? cells : nlohmann::ordered_json());
  }
  return {{"format", "glovebench-color-report"},
          {"version", 1},
          {"recording", recording},
          {"frames", samples.frames()},
          {"noise_gray", rounded(fit.noise_gray)},
          {"light_gain_rgb", {rounded(fit.light.gain[0]), rounded(fit.light.gain[1]), rounded(fit.light.gain[2])}},
          {"saturation_factor", rounded(fit.light.saturation)},
          {"pixels",
           {{"in_volume", samples.inside_pixels()},
            {"glove", fit.glove},
            {"mixed", samples.mixed().size()},
            {"not_glove", fit.other},
            {"unsure", fit.unsure},
            {"beyond", fit.beyond},
            {"beyond_like_glove", fit.beyond_like_glove}}},
          {"unlabeled_percent", percent(separation.unlabeled_share)},
          {"mixed_unlabeled_percent", percent(separation.mixed_unlabeled_share)},
          {"colors", colors},
          {"confusion_percent", confusion},
          {"warnings", color_warnings(samples, fit, separation)}};
}

std::string color_report_markdown(const ColorSamples& samples, const GloveColorFit& fit,
                                  const ColorSeparation& separation) {
  std::string text = fmt::format(
      "{} frames, camera noise {:.1f} gray levels\n"
      "against the seeds: light {:.2f} : 1 : {:.2f} (R, G, B), saturation {:.2f}\n"
      "{} glove pixels of one color, {} of two\n"
      "without a label: {:.2f}%, of those of two colors {:.1f}%\n\n",
      samples.frames(), fit.noise_gray, fit.light.gain[0], fit.light.gain[2], fit.light.saturation, fit.glove,
      samples.mixed().size(), 100 * separation.unlabeled_share, 100 * separation.mixed_unlabeled_share);
  text += color_rows(fit, separation);
  text += "\nWhat the table says (columns) of each color (rows), %:\n\n" + confusion_rows(separation);
  const std::vector<std::string> warnings = color_warnings(samples, fit, separation);
  if (!warnings.empty()) text += fmt::format("\nWarnings:\n\n- {}\n", fmt::join(warnings, "\n- "));
  return text;
}

}  // namespace glovebench::calibration
