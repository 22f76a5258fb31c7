#include <fmt/format.h>

#include <algorithm>

#include "reports/page/section.h"
#include "reports/summary.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// An error in the paper's Figures 4 to 6.
struct CurveError {
  std::string_view name;  ///< in names of charts
  std::string_view metric;
  std::string_view label;
  double PaperErrors::*paper;
};
constexpr std::array<CurveError, 3> kCurveErrors = {
    {{"position", "position_error_mm", "Position error (mm)", &PaperErrors::position_mm},
     {"posture", "posture_rms_deg", "Posture error (deg)", &PaperErrors::posture_deg},
     {"rotation", "rotation_error_deg", "Rotation error (deg)", &PaperErrors::rotation_deg}}};

std::string headline_html(const RunResult& result) {
  return "<p>" + escape_html(headline_explanation()) + "</p>\n" + to_html(headline_table(result));
}

Section figure4_section(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  std::string html =
      "<p>Mean errors with their 95% intervals. Diamonds are the means that the paper prints; it shows "
      "its other bars without numbers.</p>\n";
  for (const CurveError& error : kCurveErrors)
    html += chart_place(fmt::format("figure4-{}", error.name), fmt::format("{} as bars", error.label));
  html += data_note("figure4");
  html += "<p>" + escape_html(fmt::format("{} Noise: {} x {}.", summary_explanation(), noise.model, noise.factor)) +
          "</p>\n" + to_html(figure4_summary(result, paper, noise)) + headline_html(result);
  return {"figure4", "Figure 4: mean errors", html};
}

Section errors_section(const RunResult& result) {
  std::string html = "<p>Mean errors with their 95% intervals.</p>\n";
  for (const CurveError& error : kCurveErrors)
    html += chart_place(fmt::format("errors-{}", error.name), fmt::format("{} as bars", error.label));
  html += data_note("errors") + headline_html(result);
  return {"errors", "Mean errors", html};
}

std::string largest(const std::vector<double>& values) {
  return values.empty() ? "-" : fixed(*std::ranges::max_element(values), 2);
}

/// Means and largest values of the curves, beside the paper's.
Table curve_summary(const ExperimentResult& experiment, const PaperCurve& paper) {
  Table table = table_of({"", "mean", "paper's mean", "largest", "paper's largest"});
  for (const CurveError& error : kCurveErrors) {
    std::vector<double> ours, theirs;
    for (const FrameRecord& frame : experiment.runs.front().frames)
      if (const auto& value = frame[error.metric]) ours.push_back(*value);
    for (const PaperErrors& errors : paper.frames) theirs.push_back(errors.*error.paper);
    table.rows.push_back({std::string(error.label), fixed(mean(ours), 2), fixed(paper.mean.*error.paper, 2),
                          largest(ours), largest(theirs)});
  }
  return table;
}

void add_curve_section(std::vector<Section>& sections, const std::string& figure, const std::string& title,
                       const ExperimentResult* experiment, const PaperCurve& paper,
                       const std::vector<FrameSheet>& sheets) {
  if (!experiment || experiment->runs.empty()) return;
  const auto sheet = std::ranges::find(sheets, figure, &FrameSheet::figure);
  std::string html = fmt::format(
      "<p class=\"legend\"><span class=\"key series-0\"></span>glovebench, noise seed {}; gaps are lost frames "
      "<span class=\"key series-1\"></span>the paper's own movement, for the shape and size of its errors: frames "
      "of "
      "the same number have nothing in common</p>\n",
      experiment->runs.front().seed);
  html += fmt::format("<div class=\"curves\" data-figure=\"{}\">\n<div class=\"panels\">\n", figure);
  for (const CurveError& error : kCurveErrors)
    html += chart_place(fmt::format("{}-{}", figure, error.name), fmt::format("{}, frame by frame", error.label));
  html += "</div>\n" + (sheet == sheets.end() ? "" : frame_viewer_html(*sheet)) + "</div>\n";
  if (sheet != sheets.end()) html += keyframes_html(*sheet);
  html += data_note(figure) + to_html(curve_summary(*experiment, paper));
  sections.push_back(
      {figure, fmt::format("{}: {} with {}, recorded truth", title, paper.trajectory, paper.database), html});
}

}  // namespace

std::vector<Section> experiment_sections(const RunResult& result, const PaperNumbers& paper,
                                         const std::vector<FrameSheet>& sheets) {
  if (result.experiments.empty()) return {};
  const NoiseSetting noise = headline_noise(result);
  std::vector<Section> sections = {is_figure4(result) ? figure4_section(result, paper, noise)
                                                      : errors_section(result)};
  const auto add = [&](const std::string& figure, const std::string& title, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    add_curve_section(sections, figure, title, find_experiment(result, key), curve, sheets);
  };
  add("figure5", "Figure 5", paper.figure_5);
  add("figure6", "Figure 6", paper.figure_6);
  return sections;
}

}  // namespace glovebench::reports
