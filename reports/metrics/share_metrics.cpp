#include "reports/results.h"

namespace glovebench::reports {

std::vector<Metric> share_metrics() {
  // Tolerance 0, since two frames, the least effect, are more than any tolerance.
  constexpr Metric::Gate kGate = {1, 0};
  return {{.key = "uncovered_percent",
           .unit = "%",
           .description = "frames that are lost, or 50 mm or 30 degrees off",
           .formula = "100 (frames - covered frames) / frames",
           .place = 112,
           .gate = kGate,
           .of_record = [](const FrameRecord& frame) { return !frame.covered; }},
          {.key = "false_tracked_percent",
           .unit = "%",
           .description = "tracked frames that are 50 mm or 30 degrees off",
           .formula = "100 (tracked frames - covered frames) / frames",
           .place = 114,
           .gate = kGate,
           .of_record = [](const FrameRecord& frame) { return frame.false_tracked; }},
          {.key = "false_lost_percent",
           .unit = "%",
           .description = "lost frames in which the hand could be tracked",
           .formula = "100 (lost frames in which most of the glove is in the volume, none at the border) / frames",
           .place = 116,
           .gate = kGate,
           .of_record = [](const FrameRecord& frame) { return frame.false_lost; }}};
}

}  // namespace glovebench::reports
