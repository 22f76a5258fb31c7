#pragma once

#include <string>
#include <vector>

#include "reports/metrics/metric.h"
#include "reports/table.h"

namespace glovebench::reports {

/// The metric whose value, interval ("_low", "_high") or change the column shows. Null for other columns.
const Metric* metric_in(const Column& column);

// Each metric: meaning, formula, frames that count, whether it is compared.

/// A paragraph each, for a terminal.
std::string glossary_text(size_t columns);
/// A list. Headings of `to_html_with_links` lead to its entries.
std::string glossary_html();
std::string to_html_with_links(const Table& table, const std::vector<std::string>& plots = {});

}  // namespace glovebench::reports
