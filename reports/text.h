#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace glovebench::reports {

// Texts for the formats of reports. What comes from outside, e.g. a name, means nothing in any of them once it is
// escaped.

std::string escape_html(const std::string& text);  ///< and for SVG
/// For XML 1.0: characters that it cannot hold, not even escaped, become U+FFFD.
std::string escape_xml(const std::string& text);
/// For a cell or a line of Markdown. Brackets stay, but where they would make a link.
std::string escape_markdown(const std::string& text);
std::string escape_latex(const std::string& text);

/// A value with a fixed number of digits; "-" for none.
std::string fixed(const std::optional<double>& value, int digits);

inline constexpr size_t kTerminalColumns = 120;
/// Number of UTF-8 characters, all one column wide here.
size_t text_width(std::string_view text);
/// At most that wide, cut in the middle: names differ at their ends.
std::string shortened(const std::string& text, size_t columns);
/// Lines of at most kTerminalColumns, broken at spaces.
std::string wrapped(const std::string& text);

}  // namespace glovebench::reports
