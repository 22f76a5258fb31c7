#include "reports/page/section.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/metrics/glossary.h"
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

constexpr const char* kBarHint = "<p>A click on a bar shows its frames.</p>\n";

std::string headline_html(const RunResult& result) {
  return "<p>" + escape_html(headline_explanation()) + "</p>\n" + to_html_with_links(headline_table(result));
}

Section figure4_section(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise) {
  std::string html =
      "<p>Mean errors with their 95% intervals. Diamonds are the means that the paper prints; it shows "
      "its other bars without numbers.</p>\n";
  html += kBarHint;
  for (const CurveError& error : kCurveErrors)
    html += chart_place(fmt::format("figure4-{}", error.name), fmt::format("{} as bars", error.label));
  html += data_note("figure4");
  html += "<p>" + escape_html(fmt::format("{} Noise: {} x {}.", summary_explanation(), noise.model, noise.factor)) +
          "</p>\n" + to_html(figure4_summary(result, paper, noise)) + headline_html(result);
  return {"figure4", "Figure 4: mean errors", html};
}

Section errors_section(const RunResult& result) {
  std::string html = std::string("<p>Mean errors with their 95% intervals.</p>\n") + kBarHint;
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

/// `note`: plain text above the curves; may be empty.
void add_curve_section(std::vector<Section>& sections, const std::string& figure, const std::string& title,
                       const ExperimentResult* experiment, const PaperCurve& paper, const std::string& note,
                       const std::vector<FrameSheet>& sheets) {
  if (!experiment || experiment->runs.empty()) return;
  const auto sheet = std::ranges::find(sheets, figure, &FrameSheet::figure);
  std::string html = note.empty() ? "" : "<p>" + escape_html(note) + "</p>\n";
  html += fmt::format(
      "<p class=\"legend\"><span class=\"key series-0\"></span>glovebench, noise seed {}; gaps are lost frames "
      "<span class=\"key series-1\"></span>the paper's own movement, for the shape and size of its errors: frames "
      "of the same number have nothing in common</p>\n",
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

/// A chart of a study's table.
struct StudyChart {
  std::string_view table;
  std::string_view chart;
  std::string_view label;
};
constexpr std::array<StudyChart, 12> kCharts = {{
    {"figure7", "figure7-time", "Time of a distance against the size of the tiny image"},
    {"figure7", "figure7-rank", "Mean rank of the true neighbor against the size of the tiny image"},
    {"figure8", "figure8", "Posture error against time for each cascade"},
    {"figure9", "figure9-position", "Position error against the factor of the sub-sampling"},
    {"figure9", "figure9-rotation", "Rotation error against the factor of the sub-sampling"},
    {"figure9_times", "figure9-time", "Time of a frame against the factor of the sub-sampling"},
    {"ablations", "ablations-position", "Change of the position error with each setting"},
    {"ablations", "ablations-posture", "Change of the posture error with each setting"},
    {"ablations", "ablations-rotation", "Change of the rotation error with each setting"},
    {"light_strength", "light-strength", "Glove pixels without their label against the strength of the light"},
    {"light_temperature", "light-temperature", "Glove pixels without their label against the color temperature"},
    {"light_white_balance", "light-white-balance", "Glove pixels without their label against the white balance"},
}};

/// `is_only`: the only table, so the section's heading names it.
std::string table_html(const Table& table, bool is_only) {
  std::string charts;
  for (const StudyChart& chart : kCharts)
    if (chart.table == table.name) charts += chart_place(std::string(chart.chart), std::string(chart.label));
  constexpr size_t kLong = 24;  // rows; a longer table is folded
  return (is_only ? "" : "<h3>" + escape_html(table.title) + "</h3>\n") + "<p>" + escape_html(table.explanation) +
         "</p>\n" + (charts.empty() ? "" : "<div class=\"row\">\n" + charts + "</div>\n") + data_note(table.name) +
         fmt::format("<details{}><summary>Table</summary>\n", table.rows.size() > kLong ? "" : " open=\"\"") +
         to_html_with_links(table) + "</details>\n";
}

constexpr int kKeyframes = 6;  // about as many as the paper shows

/// A window on one tile of a sheet: row 0 of a frame is the truth, row 1 the difference. Positions are shares, so
/// only the style sheet sets the size of a tile.
std::string tile(const FrameSheet& sheet, int frame, int row, const std::string& what) {
  const int columns = sheet.columns, rows = 2 * ((sheet.frames + columns - 1) / columns);
  const auto share = [](int place, int count) { return count < 2 ? 0 : 100.0 * place / (count - 1); };
  return fmt::format(
      "<span class=\"frame-tile sheet-{} row-{}\" role=\"img\" aria-label=\"{}\" "
      "style=\"background-position:{:.4f}% {:.4f}%\"></span>",
      sheet.figure, row, what, share(frame % columns, columns), share(2 * (frame / columns) + row, rows));
}

std::string two_tiles(const FrameSheet& sheet, int frame) {
  return tile(sheet, frame, 0, "the true hand") + tile(sheet, frame, 1, "difference of the depth images");
}

std::string color_legend() {
  return fmt::format(
      "<p class=\"depth-legend\">The true hand, and below it the depth of the estimated hand minus that of the "
      "true one: <span class=\"nowrap\">\u2212{0:.0f} mm (nearer) <span class=\"ramp\"></span> +{0:.0f} mm "
      "(farther)</span> <span class=\"nowrap\"><span class=\"swatch\"></span>only one of the two is "
      "there</span></p>\n",
      kSheetDifferenceMm);
}

}  // namespace

std::vector<Section> experiment_sections(const RunResult& result, const PaperNumbers& paper,
                                         const std::vector<FrameSheet>& sheets) {
  if (result.experiments.empty()) return {};
  const NoiseSetting noise = headline_noise(result);
  std::vector<Section> sections = {is_figure4(result) ? figure4_section(result, paper, noise)
                                                      : errors_section(result)};
  const auto add = [&](const std::string& figure, const std::string& title, const PaperCurve& curve,
                       const std::string& note) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    add_curve_section(sections, figure, title, find_experiment(result, key), curve, note, sheets);
  };
  add("figure5", "Figure 5", paper.figure_5, figure5_note(result, paper));
  add("figure6", "Figure 6", paper.figure_6, "");
  return sections;
}

std::vector<Section> study_sections(const RunResult& result) {
  std::vector<Section> sections;
  for (const StudyResult& study : result.studies) {
    std::string html;
    for (const Table& table : study.tables) html += table_html(table, study.tables.size() == 1);
    if (!html.empty()) sections.push_back({study.name, study.title, html});
  }
  return sections;
}

std::string keyframes_html(const FrameSheet& sheet) {
  std::string html = fmt::format("<div class=\"keyframes\" data-figure=\"{}\">\n", sheet.figure);
  const int count = std::min(kKeyframes, sheet.frames);
  for (int i = 0; i < count; ++i) {
    const int frame = count < 2 ? 0 : i * (sheet.frames - 1) / (count - 1);
    html += fmt::format("<button type=\"button\" data-frame=\"{0}\">{1}frame {2}</button>\n", frame,
                        two_tiles(sheet, frame), sheet.first_frame + frame);
  }
  return html + "</div>\n" + color_legend();
}

std::string frame_viewer_html(const FrameSheet& sheet) {
  return fmt::format(
      "<div class=\"frame-viewer\" data-figure=\"{0}\" data-columns=\"{1}\" data-frames=\"{2}\" "
      "data-first-frame=\"{3}\" hidden=\"\">\n{4}\n<label>Frame <output class=\"frame-number\">{3}</output>"
      "<input type=\"range\" min=\"0\" max=\"{5}\" value=\"0\"/></label>\n"
      "<table class=\"frame-numbers\"><thead><tr><th></th><th>glovebench</th><th>paper</th></tr></thead><tbody>"
      "<tr><th>position</th><td></td><td></td></tr><tr><th>posture</th><td></td><td></td></tr>"
      "<tr><th>rotation</th><td></td><td></td></tr></tbody></table>\n</div>\n",
      sheet.figure, sheet.columns, sheet.frames, sheet.first_frame, two_tiles(sheet, 0), sheet.frames - 1);
}

std::string sheet_style(const std::vector<FrameSheet>& sheets) {
  std::string css;
  for (const FrameSheet& sheet : sheets) {
    const int rows = 2 * ((sheet.frames + sheet.columns - 1) / sheet.columns);
    css += fmt::format(
        ".sheet-{} {{ aspect-ratio: {} / {}; background-size: {}% {}%; background-image: url({}); }}\n",
        sheet.figure, sheet.tile_width, sheet.tile_height, 100 * sheet.columns, 100 * rows, data_uri(sheet.image));
  }
  return css;
}

}  // namespace glovebench::reports
