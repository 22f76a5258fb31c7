#pragma once

#include <string>

namespace glovebench::reports {

std::string embedded_paper_numbers();  ///< data/paper_numbers.json
std::string embedded_claims();         ///< data/claims.json
std::string embedded_page_style();     ///< data/page.css
std::string embedded_page_script();    ///< data/page_charts.js, data/page_frames.js, data/page.js

}  // namespace glovebench::reports
