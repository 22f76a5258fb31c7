#include "reports/csv.h"

namespace glovebench::reports {
namespace {

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
    if (!cell.is_null()) line += cell.is_string() ? quoted(cell.get<std::string>()) : cell.dump();
  }
  return line + "\n";
}

}  // namespace glovebench::reports
