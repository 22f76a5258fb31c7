#pragma once

#include <string>
#include <vector>

#include "reports/estimates.h"

namespace glovebench::reports {

/// Counts of each status, path and angles over time. `scripts`: as in PageMaterial.
std::string track_page(const std::string& title, const std::vector<Estimate>& estimates,
                       const std::vector<std::string>& scripts);

}  // namespace glovebench::reports
