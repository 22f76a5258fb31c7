#pragma once

#include <optional>
#include <span>
#include <vector>

#include "eval/plan.h"
#include "eval/workbench.h"
#include "reports/estimates.h"
#include "reports/page/page.h"

namespace glovebench::eval {

/// Chart scripts, sheets of Figures 5 and 6 if run, the worst frames if they can be explained, and warnings.
/// Throws: Error.
reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const reports::RunResult& result,
                                    const std::vector<reports::ExperimentEstimates>& estimates);

/// Shows all stages of a frame, tracked without those before it. The method must be one that `shows_stages`.
/// `in_run`, `hand_in_run`: the run's errors and estimate.
/// Throws: Error if the trajectory lacks the frame.
ColorImage explain_frame(Workbench& workbench, const RunSpec& spec, const reports::FrameRecord& in_run,
                         const std::optional<HandFrame>& hand_in_run);

/// The IR camera, cropped and scaled to a tile (px) around every frame's glove. Needs a frame.
PinholeCamera camera_around(const PinholeCamera& ir, const HandModel& hand, std::span<const HandFrame> frames,
                            int tile_width, int tile_height);

/// Two tiles per frame, without noise: true hand in color; estimated minus true depth (lost: true hand in gray).
/// `estimates`: one per frame.
/// Paper: pictures under Figures 5 and 6.
reports::FrameSheet make_frame_sheet(Workbench& workbench, const std::string& figure,
                                     std::span<const HandFrame> frames,
                                     std::span<const reports::Estimate> estimates);

}  // namespace glovebench::eval
