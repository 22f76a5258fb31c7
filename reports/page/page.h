#pragma once

#include <set>
#include <string>
#include <vector>

#include "reports/page/page_frame.h"
#include "reports/results.h"
#include "reports/tables.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// All frames of a curve in one image. A frame has two tiles: true hand, and below it estimated minus true depth.
/// Frame i is in column i % columns, pair of tile rows i / columns.
struct FrameSheet {
  std::string figure;  ///< "figure5"
  std::string image;   ///< bytes of a JPEG or PNG file
  int columns = 1;
  int tile_width = 0;   ///< px
  int tile_height = 0;  ///< px
  int first_frame = 0;  ///< in the trajectory
  int frames = 0;
};

/// Larger depth differences have the strongest color.
inline constexpr double kSheetDifferenceMm = 20;

struct PageMaterial {
  /// Vega, Vega-Lite, Vega-Embed, in this order. Empty: no charts.
  std::vector<std::string> scripts;
  std::vector<FrameSheet> sheets;          ///< of Figures 5 and 6
  std::vector<Picture> worst_frames;       ///< none: `explain` cannot show the frames
  std::vector<std::string> warnings = {};  ///< a sentence each
  std::set<std::string> from_files = {};   ///< truths (truth_name) and databases that `explain` reads from files
};

/// index.html in one file (reports/README.md). `timings`: for robot commands and, with studies, the machine.
std::string html_page(const RunResult& result, const PaperNumbers& paper, const Timings& timings = {},
                      const PageMaterial& material = {});

struct WorstFrame {
  ExperimentKey key;
  uint64_t seed = 0;
  FrameRecord frame;
  std::string metric;  ///< by which it was chosen
};

/// Half of `count` by position error, half by posture error (RMS), from subject 1 on source truth under the
/// headline noise, else from all experiments. At most two per experiment, 0.5 s apart in a run; none lost or
/// repeated.
std::vector<WorstFrame> worst_frames(const RunResult& result, int count = 8);

/// `folder`: of the run. `from_files`: as in PageMaterial; PATH stands for such a file's folder.
std::string explain_command(const WorstFrame& worst, const std::set<std::string>& from_files = {},
                            const std::string& folder = ".");
std::string caption(const WorstFrame& worst);

}  // namespace glovebench::reports
