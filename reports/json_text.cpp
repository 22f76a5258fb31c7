#include "reports/json_text.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

void append(std::string& text, const Json& json, size_t depth) {
  const bool plain_array =
      json.is_array() && std::ranges::none_of(json, [](const Json& item) { return item.is_structured(); });
  if (!json.is_structured() || json.empty() || plain_array) {
    check(!json.is_number_float() || std::isfinite(json.get<double>()), "a report holds finite numbers only");
    text += json.dump();
    return;
  }
  text += json.is_object() ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, value] : json.items()) {
    text.append(separator).append(depth + 1, ' ');
    if (json.is_object()) text += Json(key).dump() + ": ";
    append(text, value, depth + 1);
    separator = ",\n";
  }
  text.append("\n").append(depth, ' ') += json.is_object() ? '}' : ']';
}

}  // namespace

std::string format_json(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

double rounded(double value) {
  check(std::isfinite(value), "a report holds finite numbers only");
  return std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0 turns -0 into 0
}

Json rounded_or_null(const std::optional<double>& value) {
  return value ? Json(rounded(*value)) : Json(nullptr);
}

std::string valid_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace glovebench::reports
