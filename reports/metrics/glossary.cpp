#include "reports/metrics/glossary.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "reports/text.h"

namespace glovebench::reports {
namespace {

/// Columns of studies that have other keys than their metric.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kOtherKeys = {
    {{"posture_error_deg", "posture_rms_deg"},
     {"position_change_mm", "position_error_mm"},
     {"posture_change_deg", "posture_rms_deg"},
     {"rotation_change_deg", "rotation_error_deg"}}};

std::string anchor_of(const Metric& metric) { return fmt::format("metric-{}", metric.key); }

std::string link_of(const Column& column) {
  const Metric* metric = metric_in(column);
  return metric ? fmt::format("#{}", anchor_of(*metric)) : "";
}

std::string title_of(const Metric& metric) {
  return fmt::format("{}{}", metric.key, metric.gate ? ", compared" : "");
}

}  // namespace

const Metric* metric_in(const Column& column) {
  std::string_view key = column.key;
  for (const std::string_view part : {"_low", "_high"})
    if (key.ends_with(part)) key.remove_suffix(part.size());
  for (const auto& [other, metric] : kOtherKeys)
    if (key == other) key = metric;
  return find_metric(key);
}

std::string glossary_text(size_t columns) {
  constexpr size_t kIndent = 4;
  std::string text;
  const auto add = [&](std::string_view line) {
    text += std::string(kIndent, ' ') + wrapped(std::string(line), columns, kIndent);
  };
  for (const Metric& metric : metrics()) {
    text += title_of(metric) + "\n";
    add(metric.description);
    add(metric.formula);
    add(metric.averaged_over());
  }
  return text;
}

std::string glossary_html() {
  std::string html = "<dl class=\"glossary\">\n";
  for (const Metric& metric : metrics()) {
    html += fmt::format("<dt id=\"{}\">{}</dt>\n<dd>{}<br/>{}<br/>{}</dd>\n", anchor_of(metric), title_of(metric),
                        escape_html(std::string(metric.description)), escape_html(std::string(metric.formula)),
                        escape_html(std::string(metric.averaged_over())));
  }
  return html + "</dl>\n";
}

std::string to_html_with_links(const Table& table, const std::vector<std::string>& plots) {
  return to_html(table, plots, link_of);
}

}  // namespace glovebench::reports
