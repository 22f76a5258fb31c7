#pragma once

#include <string>
#include <string_view>

#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

/// Reads a table of points: the headings `time_s`, then NAME_x_mm, NAME_y_mm, NAME_z_mm for each point (or all in
/// _m), and a line for each frame. Three cells that are empty or NaN are a gap. `where` names the text in messages.
/// Throws Error naming line and field, what was found and what was expected.
MarkerSequence parse_csv_markers(std::string_view text, const std::string& where);

/// The table that parse_csv_markers reads, in mm to 0.001.
std::string csv_markers(const MarkerSequence& sequence);

}  // namespace glovebench::trajectories
