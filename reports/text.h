#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace glovebench::reports {

std::string escape_html(const std::string& text);  ///< also SVG
/// XML 1.0. Invalid characters become U+FFFD.
std::string escape_xml(const std::string& text);
/// One cell or line. Escapes brackets only where they form links.
std::string escape_markdown(const std::string& text);
std::string escape_latex(const std::string& text);
std::string latex_comment(const std::string& text);
std::string shell_quoted(const std::string& text);

/// "-" without value.
std::string fixed(const std::optional<double>& value, int digits);

inline constexpr size_t kTerminalColumns = 120;
/// UTF-8 characters, one column each.
size_t text_width(std::string_view text);
/// Cuts the middle.
std::string shortened(const std::string& text, size_t columns);
/// "1 seed", "2 seeds".
std::string counted(size_t count, std::string_view noun);

/// Breaks lines between words. Later lines begin with `indent` spaces; the first leaves room for them.
std::string wrapped(const std::string& text, size_t columns = kTerminalColumns, size_t indent = 0);

/// One line per member; arrays of plain values in one line. Equal values give equal bytes. Numbers must be finite.
std::string format_json(const nlohmann::ordered_json& json);

/// Rounds to 1e-6, without minus zero.
/// Throws: std::logic_error unless finite.
double rounded(double value);
nlohmann::ordered_json rounded_or_null(const std::optional<double>& value);

template <typename Items, typename ToJson>
nlohmann::ordered_json array_of(const Items& items, const ToJson& to_json) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const auto& item : items) array.push_back(to_json(item));
  return array;
}

/// Replaces bytes that are not UTF-8 by U+FFFD.
std::string valid_utf8(const std::string& text);

}  // namespace glovebench::reports
