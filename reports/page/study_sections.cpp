#include <fmt/format.h>

#include <algorithm>

#include "reports/page/section.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

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
         to_html(table) + "</details>\n";
}

}  // namespace

std::vector<Section> study_sections(const RunResult& result) {
  std::vector<Section> sections;
  for (const StudyResult& study : result.studies) {
    std::string html;
    for (const Table& table : study.tables) html += table_html(table, study.tables.size() == 1);
    if (!html.empty()) sections.push_back({study.name, study.title, html});
  }
  return sections;
}

}  // namespace glovebench::reports
