#pragma once

#include <string>
#include <vector>

#include "reports/table.h"

namespace glovebench::reports {

/// Removes the columns of names in which all rows agree, but keeps one. Returns what was removed: "heading name".
std::vector<std::string> remove_common_names(Table& table);

/// For a terminal. A table that is too wide loses the ends of its intervals and the names that all rows share, and
/// stands in parts, one below the other.
std::string to_terminal(Table table, size_t columns);

}  // namespace glovebench::reports
