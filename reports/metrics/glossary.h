#pragma once

#include <string>
#include <vector>

#include "reports/metrics/metric.h"
#include "reports/table.h"

namespace glovebench::reports {

/// The metric that a column shows, also its interval ("_low", "_high") or its change; null for other columns.
const Metric* metric_in(const Column& column);

// Each metric of the registry: what it is, its formula, over which frames it is taken, whether it is compared.

/// A paragraph each, for a terminal.
std::string glossary_text(size_t columns);
/// The same as an HTML list, whose entries the headings of `to_html_with_links` link to.
std::string glossary_html();
std::string to_html_with_links(const Table& table, const std::vector<std::string>& plots = {});

}  // namespace glovebench::reports
