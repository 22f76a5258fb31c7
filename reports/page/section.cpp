#include "reports/page/section.h"

#include <fmt/format.h>

#include "reports/text.h"

namespace glovebench::reports {

std::string to_html(const Section& section) {
  const bool has_heading = section.html.starts_with("<h2>");
  return fmt::format("<section id=\"{}\">\n{}{}</section>\n", section.id,
                     has_heading ? "" : "<h2>" + escape_html(section.title) + "</h2>\n", section.html);
}

std::string contents_list(const std::vector<Section>& sections) {
  std::string html = "<nav aria-label=\"Contents\"><ul>\n";
  for (const Section& section : sections)
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, escape_html(section.title));
  return html + "</ul></nav>\n";
}

std::string data_note(const std::string& table) {
  return fmt::format("<p class=\"source\">Data: <a href=\"tables/{0}.csv\">tables/{0}.csv</a></p>\n", table);
}

}  // namespace glovebench::reports
