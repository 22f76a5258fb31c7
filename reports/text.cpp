#include "reports/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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

std::string escape_html(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  return escaped;
}

std::string escape_xml(const std::string& text) {
  constexpr const char* kReplacement = "\xef\xbf\xbd";
  std::string escaped;
  for (const char c : escape_html(valid_utf8(text))) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '\t' || c == '\n' || c == '\r')
      escaped += fmt::format("&#{};", code);  // an attribute would turn them into spaces
    else if (code < 0x20)
      escaped += kReplacement;
    else
      escaped += c;
    if (escaped.ends_with("\xef\xbf\xbe") || escaped.ends_with("\xef\xbf\xbf"))
      escaped.replace(escaped.size() - 3, 3, kReplacement);
  }
  return escaped;
}

std::string escape_markdown(const std::string& text) {
  std::string escaped;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
    if (c == '<')
      escaped += "&lt;";
    else if (c == '&')
      escaped += "&amp;";
    else if (c == '\n' || c == '\r')
      escaped += ' ';
    else if (std::string_view("\\|`*").find(c) != std::string_view::npos ||
             (c == ']' && std::string_view("([:").find(next) != std::string_view::npos))
      escaped.append("\\") += c;
    else
      escaped += c;
  }
  return escaped;
}

std::string escape_latex(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos)
      escaped.append("\\") += c;
    else if (std::string_view("[]*").find(c) != std::string_view::npos)
      escaped.append("{").append(1, c) += "}";  // else LaTeX takes it for an option of the \\ before it
    else if (c == '\\')
      escaped += "\\textbackslash{}";
    else if (c == '~')
      escaped += "\\textasciitilde{}";
    else if (c == '^')
      escaped += "\\textasciicircum{}";
    else if (c == '<')
      escaped += "\\textless{}";
    else if (c == '>')
      escaped += "\\textgreater{}";
    else
      escaped += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  return escaped;
}

std::string latex_comment(const std::string& text) {
  std::string line = text;
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return "% " + line + "\n";
}

std::string shell_quoted(const std::string& text) {
  const bool is_plain = std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-.+/").find(c) != std::string::npos;
  });
  if (is_plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string fixed(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

size_t text_width(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });
}

std::string shortened(const std::string& text, size_t columns) {
  if (text_width(text) <= columns) return text;
  size_t left = columns / 2, right = text.size() - (columns - 3 - left);
  while (left > 0 && (text[left] & 0xc0) == 0x80) --left;
  while (right < text.size() && (text[right] & 0xc0) == 0x80) ++right;
  return text.substr(0, left) + "..." + text.substr(right);
}

std::string counted(size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string wrapped(const std::string& text, size_t columns, size_t indent) {
  std::string lines;
  size_t column = indent;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = shortened(text.substr(begin, end - begin), columns - indent);
    if (column > indent) {
      const bool fits = column + 1 + text_width(word) <= columns;
      lines += fits ? ' ' : '\n';
      if (!fits) lines.append(indent, ' ');
      column = fits ? column + 1 : indent;
    }
    lines += word;
    column += text_width(word);
    begin = end + 1;
  }
  return lines + "\n";
}

std::string format_json(const Json& json) {
  std::string text;
  append(text, json, 0);
  return text + "\n";
}

double rounded(double value) {
  check(std::isfinite(value), "a report holds finite numbers only");
  return std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0 turns -0 into 0
}

Json rounded_or_null(const std::optional<double>& value) { return value ? Json(rounded(*value)) : Json(nullptr); }

std::string valid_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace glovebench::reports
