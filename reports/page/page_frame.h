#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace glovebench::reports {

// What the pages of a run and of a comparison share: one file each that needs no other.

/// A picture for a page.
struct Picture {
  std::string caption;
  std::string image;         ///< the bytes of a PNG or JPEG file
  std::string command = "";  ///< what shows it again; may be empty
};

/// The pictures under a heading; empty if there are none.
std::string picture_section(const std::string& title, const std::vector<Picture>& pictures);

/// Bytes of a PNG or JPEG file as an address: "data:image/png;base64,...".
std::string data_uri(const std::string& image);

/// A chart that data/page_charts.js draws in this place from the page's tables: its name there and, where there are
/// several, a number: "differences 3". `label` says what it shows.
std::string chart_place(const std::string& chart, const std::string& label);
/// The end of a document whose charts are drawn: its tables, which are texts of CSV files by their names, and the
/// scripts Vega, Vega-Lite and Vega-Embed in that order. Empty without scripts.
std::string chart_scripts(const nlohmann::ordered_json& tables, const std::vector<std::string>& scripts);

/// A whole document with the project's style; `body` is HTML and follows the title as a heading. `style` is added
/// to the project's, `end` follows all that is shown.
std::string html_document(const std::string& title, const std::string& body, const std::string& style = "",
                          const std::string& end = "");

}  // namespace glovebench::reports
