#include "core/base/excerpt.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace glovebench {
namespace {

constexpr size_t kLongest = 60;

}  // namespace

std::string printable(std::string_view text) {
  std::string line(text.substr(0, kLongest));
  std::ranges::replace_if(
      line, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (text.size() > kLongest) line += "...";
  return line;
}

std::string quoted_excerpt(std::string_view text) {
  // Replacing instead of throwing: the text may be no UTF-8, and is not once it is cut within a character.
  std::string quoted =
      nlohmann::json(text.substr(0, kLongest)).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > kLongest) quoted += "...";
  return quoted;
}

std::string excerpt(const nlohmann::json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  if (value.is_string()) return quoted_excerpt(value.get_ref<const std::string&>());
  return value.dump();
}

}  // namespace glovebench
