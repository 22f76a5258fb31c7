#include "trajectories/text_cells.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench::trajectories {

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const size_t end = parts.size() < kMostCells ? text.find(separator) : std::string_view::npos;
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

Lines::Lines(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  rest_ = text;
}

std::optional<std::string_view> Lines::next() {
  if (!rest_) return std::nullopt;
  ++number_;
  const size_t end = rest_->find('\n');
  std::string_view line = rest_->substr(0, end);
  if (end == std::string_view::npos)
    rest_.reset();
  else
    rest_->remove_prefix(end + 1);
  // Tabs stay: empty cells at the end of a line lie between them.
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  return line;
}

std::optional<CellRow> next_row(Lines& lines, size_t count, const std::string& where) {
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    CellRow row{cells_of(*line, ','), fmt::format("line {}", lines.number())};
    if (row.cells.size() != count)
      throw Error(where, row.place, fmt::format("{} cells", row.cells.size()), fmt::format("{}", count));
    return row;
  }
  return std::nullopt;
}

double number_from(std::string_view cell, double min, double max, const std::string& where,
                   const std::string& field) {
  const std::optional<double> number = number_in<double>(cell);
  if (!number || !(*number >= min && *number <= max))
    throw Error(where, field, quoted_excerpt(cell), fmt::format("a number from {} to {}", min, max));
  return *number;
}

std::string fixed(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  // Adding zero turns a negative zero into a positive one.
  return fmt::format("{:.{}f}", std::round(value * scale) / scale + 0.0, decimals);
}

}  // namespace glovebench::trajectories
