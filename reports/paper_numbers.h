#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/tracker/tracker_config.h"

namespace glovebench::reports {

/// The three errors that the paper prints.
struct PaperErrors {
  double position_mm = 0;
  double posture_deg = 0;
  double rotation_deg = 0;
};

/// A per-frame curve of the paper (figures 5 and 6) and its mean, which is a row of Figure 4.
struct PaperCurve {
  std::string trajectory;
  std::string database;
  PaperErrors mean;
  std::vector<PaperErrors> frames;
};

/// A row of Figure 8: one cascade with one database.
struct PaperCascade {
  std::string database;
  Cascade cascade;
  double posture_error_deg = 0;
  double time_ms = 0;
};

/// What the paper prints, as data.
struct PaperNumbers {
  std::string source;
  PaperCurve figure_5;
  PaperCurve figure_6;
  std::vector<PaperCascade> figure_8;
  double rate_hz = 0;
  std::string rate_hardware;
  double mean_position_error_below_mm = 0;

  /// The printed mean errors of an experiment; null where the paper shows a bar only.
  const PaperErrors* mean_of(const std::string& trajectory, const std::string& database) const;
};

/// The numbers that this program carries (reports/data/paper_numbers.json).
const PaperNumbers& paper_numbers();
/// Strict; throws Error naming `where` and the field.
PaperNumbers parse_paper_numbers(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
