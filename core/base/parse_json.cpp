#include "core/base/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/base/error.h"
#include "core/base/excerpt.h"

namespace glovebench {
namespace {

using nlohmann::json;

/// Where byte number `byte`, counted from 1, lies; in a text of one line that needs no number.
std::string place_of(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const std::string column = fmt::format("column {}", before.size() - line_begin + 1);
  if (text.find('\n') == std::string_view::npos) return column;
  return fmt::format("line {}, {}", std::ranges::count(before, '\n') + 1, column);
}

void check_nesting(std::string_view text, const std::string& where) {
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text && c == '\\') ++i;
    if (c == '"') in_text = !in_text;
    if (in_text) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepestNesting)
      throw Error(where, place_of(text, i + 1), "deeper nesting", fmt::format("{} levels", kDeepestNesting));
  }
}

}  // namespace

json parse_json(std::string_view text, const std::string& where) {
  check_nesting(text, where);
  // The library keeps the last of two equal keys; who wrote the file by hand deserves to hear of it.
  std::vector<std::set<std::string>> keys;
  const auto notice_keys = [&](int /*depth*/, json::parse_event_t event, const json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw Error(where, printable(parsed.get<std::string>()), "the key twice", "each key once");
    return true;
  };
  try {
    return json::parse(text, notice_keys);
  } catch (const json::parse_error& error) {
    throw Error(where, place_of(text, error.byte), error.byte > text.size() ? "the end" : "something else", "JSON");
  } catch (const json::exception&) {
    throw Error(where, "number", "one that no double can hold", "a finite number");
  }
}

}  // namespace glovebench
