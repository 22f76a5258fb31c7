#pragma once

#include <string>
#include <vector>

#include "reports/page/page.h"

namespace glovebench::reports {

struct Section {
  std::string id;
  std::string title;  ///< plain text
  std::string html;   ///< below the heading, or with its own
};

std::string data_note(const std::string& table);

/// Figure 4 or other experiments' errors; Figures 5 and 6 if run.
std::vector<Section> experiment_sections(const RunResult& result, const PaperNumbers& paper,
                                         const std::vector<FrameSheet>& sheets);
std::vector<Section> study_sections(const RunResult& result);
/// Curves and worst frames of each experiment.
Section frames_section(const RunResult& result, const PageMaterial& material);

std::string keyframes_html(const FrameSheet& sheet);
/// One frame with a slider, for data/page_frames.js.
std::string frame_viewer_html(const FrameSheet& sheet);
/// CSS with each sheet once.
std::string sheet_style(const std::vector<FrameSheet>& sheets);

}  // namespace glovebench::reports
