#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/comparison/comparison_text.h"
#include "reports/comparison/settings_table.h"
#include "reports/page/page_frame.h"
#include "reports/text.h"

namespace glovebench::reports {

std::string settings_text(const SettingsTable& settings, size_t columns) {
  std::string text = to_text(settings.table, true, columns) + "\n";
  if (!settings.changes.rows.empty()) text += to_text(settings.changes, true, columns) + "\n";
  if (!settings.enough.empty())
    text += "Not enough data. Enough would be, if further movements vary as these do:\n";
  for (const std::string& line : settings.enough) text += "  " + wrapped(line, columns, 2);
  if (!settings.enough.empty()) text += "\n";
  return text + wrapped(settings.recommendation, columns) + "\n" + wrapped(settings.explanation, columns);
}

std::string settings_markdown(const SettingsTable& settings) {
  std::string text = escape_markdown(settings.recommendation) + "\n\n" + to_markdown(settings.table);
  if (!settings.changes.rows.empty()) text += "\n" + to_markdown(settings.changes);
  if (!settings.enough.empty()) text += "\nEnough data would be, if further movements vary as these do:\n\n";
  for (const std::string& line : settings.enough) text += "- " + escape_markdown(line) + "\n";
  return text + "\n" + escape_markdown(settings.explanation) + "\n";
}

std::string settings_html(const SettingsTable& settings, const std::vector<std::string>& scripts) {
  std::string body =
      "<p>" + escape_html(settings.recommendation) + "</p>\n<h2>Errors and times</h2>\n" + to_html(settings.table);
  if (!settings.changes.rows.empty())
    body += "<h2>Differences from the reference</h2>\n" + to_html(settings.changes);
  if (!settings.enough.empty())
    body += "<p>Enough data would be, if further movements vary as these do:</p>\n<ul>\n";
  for (const std::string& line : settings.enough) body += "<li>" + escape_html(line) + "</li>\n";
  if (!settings.enough.empty()) body += "</ul>\n";
  body += "<p>" + escape_html(settings.explanation) + "</p>\n";
  std::string end;
  if (settings.has_times) {
    body += "<h2>Errors against time</h2>\n" +
            chart_place("settings", "Each error of each setting against the time of a frame");
    end = chart_scripts({{"settings", settings_csv(settings)}}, scripts);
  }
  return html_document("glovebench settings", body, "", end);
}

std::string settings_csv(const SettingsTable& settings) {
  Table table = settings.table;
  const int setting = column_index(table, "setting");
  table.columns.insert(table.columns.begin() + setting + 1, {"run", "run"});
  ++table.name_columns;
  for (const char* key : {"confidence_percent", "preselected_metrics"}) table.columns.push_back({key, key});
  for (Row& row : table.rows) {
    row.insert(row.begin() + setting + 1, settings.runs.at(std::get<std::string>(row[setting])));
    row.emplace_back(settings.config.confidence_percent());
    row.emplace_back(fmt::format("{}", fmt::join(settings.preselected, " ")));
  }
  return to_csv(table, {{"experiments", settings.experiments}});
}

std::string settings_latex(const SettingsTable& settings) {
  std::string names = latex_comment(settings.experiments);
  for (const auto& [setting, run] : settings.runs) names += latex_comment(fmt::format("{}: run {}", setting, run));
  return names + latex_comment(method_sentence(settings.config, settings.preselected)) +
         latex_comment(settings.recommendation) + to_latex(settings.table);
}

}  // namespace glovebench::reports
