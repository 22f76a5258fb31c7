#pragma once

#include <vector>

#include "core/database/database.h"

namespace glovebench::trajectories {

inline constexpr size_t kPostureCount20 = 20;

/// Random blends of two or three gestures within limits, with the wrist at 0.
std::vector<Posture> movement_posture_pool(const PostureSet& gestures);

/// The four sets of section IV.
std::vector<PostureSet> make_database_posture_sets(const PostureSet& gestures);

}  // namespace glovebench::trajectories
