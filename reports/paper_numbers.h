#pragma once

#include <string>
#include <vector>

#include "core/tracker/tracker_config.h"

namespace glovebench::reports {

struct PaperErrors {
  double position_mm = 0;
  double posture_deg = 0;
  double rotation_deg = 0;
};

/// Paper: Figures 5 and 6.
struct PaperCurve {
  std::string trajectory;
  std::string database;
  PaperErrors mean;
  std::vector<PaperErrors> frames;
};

/// Paper: Figure 8.
struct PaperCascade {
  std::string database;
  Cascade cascade;
  double posture_error_deg = 0;
  double time_ms = 0;
};

struct PaperNumbers {
  std::string source;
  PaperCurve figure_5;
  PaperCurve figure_6;
  std::vector<PaperCascade> figure_8;
  double rate_hz = 0;
  std::string rate_hardware;
  double mean_position_error_below_mm = 0;

  /// Printed means. Null where the paper has only a bar.
  const PaperErrors* mean_of(const std::string& trajectory, const std::string& database) const;
};

/// reports/data/paper_numbers.json.
const PaperNumbers& paper_numbers();
/// Throws: Error.
PaperNumbers parse_paper_numbers(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
