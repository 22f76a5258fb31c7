#pragma once

#include <string>
#include <vector>

#include "reports/page/page.h"

namespace glovebench::reports {

/// A part of the page, which its contents list names.
struct Section {
  std::string id;
  std::string title;  ///< plain text
  std::string html;   ///< what follows the heading, or begins with a heading of its own
};

/// Where the numbers of a chart are.
std::string data_note(const std::string& table);

/// The experiments: Figure 4, the curves of figures 5 and 6 with their keyframes. Those that were run.
std::vector<Section> experiment_sections(const RunResult& result, const PaperNumbers& paper,
                                         const std::vector<FrameSheet>& sheets);
/// A section for each study of a run, with its charts and tables.
std::vector<Section> study_sections(const RunResult& result);

/// The keyframes of a curve and, for data/page_frames.js, the place of one frame with its slider.
std::string keyframes_html(const FrameSheet& sheet);
std::string frame_viewer_html(const FrameSheet& sheet);
/// Puts each sheet into the page once: the tiles are windows on it.
std::string sheet_style(const std::vector<FrameSheet>& sheets);

}  // namespace glovebench::reports
