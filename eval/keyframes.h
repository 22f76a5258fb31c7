#pragma once

#include <span>
#include <vector>

#include "eval/workbench.h"
#include "reports/estimates.h"
#include "reports/page/frame_sheet.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// The part of the depth camera's view that a sheet shows, the same in all frames: a camera whose image is a tile
/// of that size (px) and holds the glove of every frame, with a margin. Frames are at least one.
PinholeCamera camera_around(const PinholeCamera& ir, const HandModel& hand, std::span<const HandFrame> frames,
                            int tile_width, int tile_height);

/// The pictures under Figures 5 and 6 of the paper, of every frame: the true hand as the depth camera would see it
/// in color, and the depth of the estimated hand minus that of the true one, in the same pixels. `estimates` are
/// those of one seed, one a frame; a lost frame's picture shows the true hand alone, in gray. Both hands are drawn
/// without noise.
reports::FrameSheet make_frame_sheet(Workbench& workbench, const std::string& figure,
                                     std::span<const HandFrame> frames,
                                     std::span<const reports::Estimate> estimates);

}  // namespace glovebench::eval
