#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace glovebench::reports {

struct Picture {
  std::string caption;
  std::string image;         ///< bytes of a PNG or JPEG file
  std::string command = {};  ///< shows it again; may be empty
};

/// Empty without pictures.
std::string picture_section(const std::string& title, const std::vector<Picture>& pictures);

/// `image`: bytes of a PNG or JPEG file.
std::string data_uri(const std::string& image);

/// Where data/page_charts.js draws `chart`, a name there, with a number if there are several ("differences 3").
std::string chart_place(const std::string& chart, const std::string& label);
/// The end of a page. `tables`: CSV texts by name. `scripts`: as in PageMaterial. Empty without scripts.
std::string chart_scripts(const nlohmann::ordered_json& tables, const std::vector<std::string>& scripts);

/// A document in the project's style, plus `style`.
std::string html_document(const std::string& title, const std::string& body, const std::string& style = "",
                          const std::string& end = "");

}  // namespace glovebench::reports
