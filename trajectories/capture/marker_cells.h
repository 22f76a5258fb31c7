#pragma once

#include <span>
#include <string>
#include <string_view>

#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

/// The timestamp in a cell of seconds. Throws Error.
int64_t timestamp_from(std::string_view cell, const std::string& where, const std::string& field);

/// The point in three cells, or a gap if all are empty or NaN. `scale`: metres of the cells' unit. Throws Error if
/// some of them are empty, or one is no number or too large.
Eigen::Vector3d point_from(std::span<const std::string_view> cells, double scale, const std::string& where,
                           const std::string& field);

/// Adds a name. Throws Error if it is no name (is_name, or '*' and a number), was there before, or is one too many.
void add_name(std::string_view name, MarkerSequence& sequence, const std::string& where, const std::string& field);

/// Adds a frame; times count from the first frame's. Throws Error if its time is not after that of the one before,
/// or if most points of a long capture are left out: `text_bytes`, the capture's size, does not say then how many
/// there are.
void add_frame(MarkerFrame frame, int64_t first_us, size_t text_bytes, MarkerSequence& sequence,
               const std::string& where, const std::string& field);

}  // namespace glovebench::trajectories
