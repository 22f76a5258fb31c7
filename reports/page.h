#pragma once

#include <string>
#include <vector>

#include "reports/page_frame.h"
#include "reports/tables.h"

namespace glovebench::reports {

/// index.html, one file that needs no other: Figure 4 as a table, the curves of figures 5 and 6 beside the paper's
/// own (of the first noise seed; left out if those experiments were not run), the pictures, and the table of more
/// metrics.
std::string html_page(const RunResult& result, const PaperNumbers& paper,
                      const std::vector<Picture>& pictures = {});

}  // namespace glovebench::reports
