#pragma once

#include <vector>

#include "core/database/database.h"

namespace glovebench::trajectories {

inline constexpr size_t kPostureCount20 = 20;  ///< of DB_20_postures: the three and 17 movement postures

/// Plausible postures of a moving hand: blends of two or three of the gestures, varied along variation_modes().
/// Within the limits; wrist angles zero; end joints bend about two thirds as far as middle joints. Deterministic.
std::vector<Posture> movement_posture_pool(const PostureSet& gestures);

/// The four sets of section IV: DB_open_pinch, DB_open_power, DB_open_pinch_power, DB_20_postures.
std::vector<PostureSet> make_database_posture_sets(const PostureSet& gestures);

}  // namespace glovebench::trajectories
