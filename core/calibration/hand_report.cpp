#include "core/calibration/hand_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace glovebench::calibration {
namespace {

constexpr std::array<std::string_view, 5> kFingerNames = {"thumb", "index", "middle", "ring", "little"};

double to_digits(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

std::vector<std::string> unseen_sizes(const HandFit& fit) {
  std::vector<std::string> names;
  for (int i = 0; i < kSizeCount; ++i)
    if (!fit.seen[i]) names.push_back(hand_size_names()[i]);
  return names;
}

/// Points of a patch that a view shows on average.
double points_a_view(const HandFit& fit, int patch) {
  return static_cast<double>(fit.patches[patch].points) / static_cast<double>(fit.poses.size());
}

struct HeightRange {
  double least = 0, most = 0, rms = 0;  ///< m
};
HeightRange range_of_heights(const HandShape& shape) {
  if (shape.heights.empty()) return {};
  const auto [least, most] = std::ranges::minmax(shape.heights);
  double squares = 0;
  for (const double height : shape.heights) squares += height * height;
  return {least, most, std::sqrt(squares / static_cast<double>(shape.heights.size()))};
}

std::string percent_text(double factor) { return fmt::format("{:+.1f}", 100 * (factor - 1)); }

}  // namespace

MeasuredHand measured_hand(const HandFit& fit, Side side) {
  return {.side = side,
          .shape = fit.shape,
          .deviation = fit.deviation,
          .seen = fit.seen,
          .views = static_cast<int>(fit.poses.size()),
          .residual_before = fit.residual_before,
          .residual = fit.residual};
}

std::vector<std::string> hand_warnings(const HandFit& fit, const ShownMotion& motion) {
  constexpr double kStiff_deg = 40;  // of a finger
  constexpr double kFewPoints = 10;  // of a patch in a view, on average
  constexpr double kMuch = 2;        // times the mean distance of all points
  std::vector<std::string> warnings;
  if (const auto unseen = unseen_sizes(fit); !unseen.empty())
    warnings.push_back(fmt::format("the recording does not tell these sizes, which stay near those of the mesh: {}",
                                   fmt::join(unseen, ", ")));
  if (fit.shape.heights.empty())
    warnings.push_back("the recording shows one side of the hand: sizes and patches are fitted, heights are not");
  for (size_t finger = 0; finger < motion.bend_deg.size(); ++finger)
    if (motion.bend_deg[finger] < kStiff_deg)
      warnings.push_back(
          fmt::format("the {} bends by {:.0f} degrees alone", kFingerNames[finger], motion.bend_deg[finger]));
  for (int patch = 0; patch < kPatchCount; ++patch) {
    if (points_a_view(fit, patch) < kFewPoints)
      warnings.push_back(fmt::format("patch {} is hardly seen: turn the hand further", patch_names()[patch]));
    else if (fit.patches[patch].residual > kMuch * fit.residual)
      warnings.push_back(fmt::format("patch {} lies {:.1f} mm off the fitted hand, all points {:.1f} mm",
                                     patch_names()[patch], 1000 * fit.patches[patch].residual,
                                     1000 * fit.residual));
  }
  return warnings;
}

nlohmann::ordered_json hand_report_json(const HandFit& fit, const ShownMotion& motion,
                                        const std::string& recording) {
  nlohmann::ordered_json sizes = nlohmann::ordered_json::array(), patches = nlohmann::ordered_json::array();
  for (int i = 0; i < kSizeCount; ++i)
    sizes.push_back({{"size", hand_size_names()[i]},
                     {"factor", to_digits(fit.shape.sizes[i], 1e6)},
                     {"deviation", to_digits(fit.deviation[i], 1e6)},
                     {"seen", fit.seen[i]}});
  for (int p = 0; p < kPatchCount; ++p)
    patches.push_back({{"patch", patch_names()[p]},
                       {"points_per_frame", to_digits(points_a_view(fit, p), 1e3)},
                       {"residual_mm", to_digits(1000 * fit.patches[p].residual, 1e6)}});
  const HeightRange heights = range_of_heights(fit.shape);
  nlohmann::ordered_json bends;
  for (size_t finger = 0; finger < motion.bend_deg.size(); ++finger)
    bends[std::string(kFingerNames[finger])] = to_digits(motion.bend_deg[finger], 1e3);
  return {{"format", "glovebench-hand-report"},
          {"version", 2},
          {"recording", recording},
          {"frames", motion.views},
          {"duration_s", to_digits(motion.seconds, 1e3)},
          {"turn_deg", to_digits(motion.turn_deg, 1e3)},
          {"bend_deg", bends},
          {"residual_before_mm", to_digits(1000 * fit.residual_before, 1e6)},
          {"residual_mm", to_digits(1000 * fit.residual, 1e6)},
          {"height_mm",
           {{"least", to_digits(1000 * heights.least, 1e6)},
            {"most", to_digits(1000 * heights.most, 1e6)},
            {"rms", to_digits(1000 * heights.rms, 1e6)}}},
          {"sizes", sizes},
          {"patches", patches},
          {"warnings", hand_warnings(fit, motion)}};
}

std::string hand_report_markdown(const HandFit& fit, const ShownMotion& motion) {
  const HeightRange heights = range_of_heights(fit.shape);
  std::string text = fmt::format(
      "{} frames over {:.1f} s; the hand turns by {:.0f} degrees, its fingers bend by {:.0f}, {:.0f}, {:.0f}, "
      "{:.0f} "
      "and {:.0f} degrees (thumb to little)\n"
      "mean distance of the points from the surface: {:.2f} mm as the mesh is, {:.2f} mm as fitted\n"
      "surface {:.1f} to {:.1f} mm above the stretched mesh\n\n"
      "| size | against the mesh, % | standard deviation, % |\n| --- | ---: | ---: |\n",
      motion.views, motion.seconds, motion.turn_deg, motion.bend_deg[0], motion.bend_deg[1], motion.bend_deg[2],
      motion.bend_deg[3], motion.bend_deg[4], 1000 * fit.residual_before, 1000 * fit.residual, 1000 * heights.least,
      1000 * heights.most);
  for (int i = 0; i < kSizeCount; ++i)
    text += fmt::format("| {} | {} | {:.1f}{} |\n", hand_size_names()[i], percent_text(fit.shape.sizes[i]),
                        100 * fit.deviation[i], fit.seen[i] ? "" : ", not seen");
  const std::vector<std::string> warnings = hand_warnings(fit, motion);
  if (!warnings.empty()) text += fmt::format("\nWarnings:\n\n- {}\n", fmt::join(warnings, "\n- "));
  return text;
}

}  // namespace glovebench::calibration
