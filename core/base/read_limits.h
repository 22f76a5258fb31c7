#pragma once

#include <cstdint>

namespace glovebench {

// Larger files are refused before they take memory (core/README.md), bytes.
/// Trajectories and posture sets.
inline constexpr uint64_t kLargestMovement = uint64_t{64} << 20;
/// Results and estimates: the report of some million frames.
inline constexpr uint64_t kLargestResults = 256'000'000;
/// Files that do not grow with the frames: times, ratios, noise floors.
inline constexpr uint64_t kLargestSmallFile = 16'000'000;

}  // namespace glovebench
