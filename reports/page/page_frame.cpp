#include "reports/page/page_frame.h"

#include <fmt/format.h>

#include "reports/embedded.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// JSON for a script element: escapes "<", so that no text can end the element.
std::string for_script(const Json& json) {
  std::string text;
  const std::string dumped = json.dump(-1, ' ', false, Json::error_handler_t::replace);  // names can hold any bytes
  for (const char c : dumped) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

/// A script element whose text cannot end it early.
std::string script(const std::string& text) {
  std::string html = "<script>\n";
  for (size_t i = 0; i < text.size(); ++i) {
    html += text[i];
    if (text.compare(i, 3, "</s") == 0 || text.compare(i, 3, "</S") == 0) html += '\\';
  }
  return html + "\n</script>\n";
}

}  // namespace

std::string data_uri(const std::string& image) {
  const bool is_jpeg = image.starts_with("\xff\xd8");
  return fmt::format("data:image/{};base64,{}", is_jpeg ? "jpeg" : "png", base64(image));
}

std::string picture_section(const std::string& title, const std::vector<Picture>& pictures) {
  if (pictures.empty()) return "";
  std::string html = fmt::format("<h2>{}</h2>\n<div class=\"pictures\">\n", escape_html(title));
  for (const Picture& picture : pictures) {
    const std::string caption = escape_html(picture.caption);
    html += fmt::format("<figure><img alt=\"{}\" src=\"{}\"/><figcaption>{}</figcaption>", caption,
                        data_uri(picture.image), caption);
    if (!picture.command.empty()) html += fmt::format("<code>{}</code>", escape_html(picture.command));
    html += "</figure>\n";
  }
  return html + "</div>\n";
}

std::string chart_place(const std::string& chart, const std::string& label) {
  return fmt::format("<div class=\"chart-place\" data-chart=\"{}\" role=\"img\" aria-label=\"{}\"></div>\n", chart,
                     escape_html(label));
}

std::string chart_scripts(const Json& tables, const std::vector<std::string>& scripts) {
  if (scripts.empty()) return "";
  std::string html = "<script type=\"application/json\" id=\"tables\">" + for_script(tables) + "</script>\n";
  for (const std::string& text : scripts) html += script(text);
  return html + script(embedded_page_script());
}

std::string html_document(const std::string& title, const std::string& body, const std::string& style,
                          const std::string& end) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         // An empty icon keeps browsers from asking for /favicon.ico.
         "<link rel=\"icon\" href=\"data:,\"/>\n" +
         fmt::format("<title>{}</title>\n<style>\n", escape_html(title)) + embedded_page_style() + style +
         fmt::format("</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n", escape_html(title)) + body + "</main>\n" +
         end + "</body>\n</html>\n";
}

}  // namespace glovebench::reports
