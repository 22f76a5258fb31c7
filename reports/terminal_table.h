#pragma once

#include <string>
#include <vector>

#include "reports/table.h"

namespace glovebench::reports {

/// Removes naming columns in which all rows agree, but keeps one. Returns "heading name" of each.
std::vector<std::string> remove_common_names(Table& table);

/// A table that is too wide loses the ends of its intervals and the names that all rows share, and stands in
/// parts.
std::string to_terminal(Table table, size_t columns);

}  // namespace glovebench::reports
