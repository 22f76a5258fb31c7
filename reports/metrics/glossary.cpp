#include "reports/metrics/glossary.h"

#include <fmt/format.h>

#include "reports/metrics/metric.h"
#include "reports/text.h"

namespace glovebench::reports {

Table glossary_table() {
  Table table = table_of({"metric", "unit", "meaning", "formula", "mean over", "compared"}, 6);
  for (const Metric& metric : metrics())
    table.rows.push_back({std::string(metric.key), std::string(metric.unit), std::string(metric.description),
                          std::string(metric.formula), std::string(metric.averaged_over()),
                          metric.gate ? "yes" : "no"});
  return table;
}

std::string glossary_text(size_t columns) {
  constexpr size_t kIndent = 4;
  std::string text;
  const auto add = [&](const std::string& line) {
    text += std::string(kIndent, ' ') + wrapped(line, columns, kIndent);
  };
  for (const Metric& metric : metrics()) {
    text += fmt::format("{}{}\n", metric.key, metric.gate ? ", compared" : "");
    add(std::string(metric.description));
    add(std::string(metric.formula));
    add(fmt::format("mean over {}", metric.averaged_over()));
  }
  return text;
}

}  // namespace glovebench::reports
