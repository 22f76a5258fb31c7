#pragma once

#include <string>
#include <string_view>

#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

/// Reads a TRC file, the table of points that Motion Analysis' programs and OpenSim write: tabs between cells;
/// three lines about the file, of which units (mm or m) and numbers of markers and frames count; the names, a name
/// over three columns; X1, Y1, Z1, ...; then a line for each frame: its number, its time in s, the points. Three
/// cells that are empty, NaN or zero are a gap. Throws Error naming line and field, what was found and what was
/// expected.
MarkerSequence parse_trc_markers(std::string_view text, const std::string& where);

}  // namespace glovebench::trajectories
