#pragma once

#include <string>
#include <vector>

#include "reports/page/page_frame.h"
#include "reports/tables.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Pictures of all frames of a curve in one image. A frame has two tiles, one above the other: the true hand, and
/// the difference of the depth images of estimate and truth. Frame i of the sheet is in column i % columns of the
/// pair of tile rows i / columns.
struct FrameSheet {
  std::string figure;  ///< "figure5"
  std::string image;   ///< the bytes of a JPEG (or PNG) file
  int columns = 1;
  int tile_width = 0;   ///< px
  int tile_height = 0;  ///< px
  int first_frame = 0;  ///< its number in the trajectory
  int frames = 0;
};

/// Depth differences of that much and more have the strongest color of a sheet.
inline constexpr double kSheetDifferenceMm = 20;

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
