#pragma once

#include <span>
#include <vector>

#include "eval/workbench.h"
#include "reports/estimates.h"
#include "reports/page/page.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// The IR camera, cropped and scaled to a tile with the glove of every frame, at least one.
/// Units: px of the tile.
PinholeCamera camera_around(const PinholeCamera& ir, const HandModel& hand, std::span<const HandFrame> frames,
                            int tile_width, int tile_height);

/// Two tiles a frame, without noise: the true hand in color, and estimated minus true depth. `estimates`: one seed,
/// one a frame; a lost frame shows the true hand in gray.
/// Paper: pictures under Figures 5 and 6.
reports::FrameSheet make_frame_sheet(Workbench& workbench, const std::string& figure,
                                     std::span<const HandFrame> frames,
                                     std::span<const reports::Estimate> estimates);

}  // namespace glovebench::eval
