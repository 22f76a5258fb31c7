#include "reports/csv.h"

#include <charconv>
#include <cmath>
#include <string_view>

namespace glovebench::reports {
namespace {

/// A spreadsheet takes a text for a formula that begins like one. An apostrophe, which it does not show, makes it a
/// text again. A number stays a number.
std::string without_formula(const std::string& text) {
  const bool looks_like_one = !text.empty() && std::string_view("=+-@\t\r\n").find(text[0]) != std::string::npos;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  return looks_like_one && !is_number ? "'" + text : text;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

std::string csv_line(const nlohmann::ordered_json& cells) {
  std::string line;
  for (const auto& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    if (!cell.is_null()) line += cell.is_string() ? quoted(without_formula(cell.get<std::string>())) : cell.dump();
  }
  return line + "\n";
}

}  // namespace glovebench::reports
