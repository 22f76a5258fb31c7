#include "reports/terminal_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "reports/text.h"

namespace glovebench::reports {
namespace {

void erase_interval_ends(Table& table) {
  for (size_t c = table.columns.size(); c-- > 0;)
    if (table.columns[c].key.ends_with("_low") || table.columns[c].key.ends_with("_high")) erase_column(table, c);
}

/// The names and the columns from `first` to before `end`.
Table part_of(Table table, size_t first, size_t end) {
  for (size_t c = table.columns.size(); c-- > static_cast<size_t>(table.name_columns);)
    if (c < first || c >= end) erase_column(table, c);
  return table;
}

bool fits(const Table& table, size_t columns) {
  const std::string text = to_text(table, false, std::numeric_limits<int>::max());
  return text_width(text.substr(0, text.find('\n'))) <= columns;
}

}  // namespace

std::vector<std::string> remove_common_names(Table& table) {
  std::vector<std::string> common;
  for (auto c = static_cast<size_t>(table.name_columns); c-- > 0 && table.name_columns > 1;) {
    if (table.rows.empty() ||
        std::ranges::any_of(table.rows, [&](const Row& row) { return row[c] != table.rows.front()[c]; }))
      continue;
    common.insert(common.begin(),
                  table.columns[c].heading + " " + cell_text(table.rows.front()[c], table.columns[c]));
    erase_column(table, c);
  }
  return common;
}

std::string to_terminal(Table table, size_t columns) {
  if (fits(table, columns)) return to_text(table, false, columns);
  erase_interval_ends(table);
  const std::vector<std::string> common = remove_common_names(table);
  std::string text;
  if (!common.empty()) text += wrapped(fmt::format("All: {}.", fmt::join(common, ", ")), columns) + "\n";
  auto first = static_cast<size_t>(table.name_columns);
  while (true) {  // at least once: a table may have names alone
    size_t end = table.columns.size();
    while (end > first + 1 && !fits(part_of(table, first, end), columns)) --end;
    text += to_text(part_of(table, first, end), false, columns);
    if (end == table.columns.size()) return text;
    text += "\n";
    first = end;
  }
}

}  // namespace glovebench::reports
