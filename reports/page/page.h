#pragma once

#include <string>
#include <vector>

#include "reports/page/frame_sheet.h"
#include "reports/page/page_frame.h"
#include "reports/tables.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// What the page shows beside the numbers.
struct PageMaterial {
  /// Vega, Vega-Lite and Vega-Embed, in that order: the text of scripts that draw the charts. Without them the page
  /// has its tables and pictures.
  std::vector<std::string> scripts;
  std::vector<FrameSheet> sheets;     ///< of figures 5 and 6
  std::vector<Picture> worst_frames;  ///< as chosen by `worst_frames`
};

/// index.html, one file that needs no other: the paper's figures 4 to 9 beside its numbers, as charts over tables;
/// what was not run is left out. Without JavaScript the tables and the keyframes are there. Of the times of the run
/// those of the robot commands are shown, and, if it has studies, which are of times themselves, where it ran.
std::string html_page(const RunResult& result, const PaperNumbers& paper, const Timings& timings = {},
                      const PageMaterial& material = {});

}  // namespace glovebench::reports
