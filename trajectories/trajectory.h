#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/hand/posture.h"

namespace glovebench::trajectories {

/// `source`: a movement as it was made. `recorded`: a tracker's output on a source.
/// Paper: section IV.
enum class TrajectoryKind { source, recorded };
constexpr auto names_of(TrajectoryKind) { return std::to_array<std::string_view>({"source", "recorded"}); }

struct Provenance {
  std::string source;
  std::string source_hash;
  std::string database;
  std::string database_hash;  ///< of inputs
  std::string profile;
  std::string profile_hash;  ///< of the effective configuration

  friend bool operator==(const Provenance&, const Provenance&) = default;
};

struct Trajectory {
  std::string name;
  std::string description;
  Side side = Side::right;
  TrajectoryKind kind = TrajectoryKind::source;
  std::optional<Provenance> provenance;  ///< for `recorded` only
  std::vector<HandFrame> frames;         ///< in time order, not empty
};

inline constexpr int64_t kMaxTimestampUs = 1'000'000'000'000'000;
inline constexpr double kMaxPositionMm = 10'000;  ///< of each coordinate
/// Largest deviation from unit length in a file; reading normalizes.
inline constexpr double kQuaternionNormTolerance = 1e-3;

/// Parses the JSON of README.md.
/// Throws: Error.
Trajectory parse_trajectory(std::string_view text, const std::string& where);

/// The file of README.md. Parsing reproduces it byte for byte.
/// Throws: Error if it could not be read again.
std::string canonical_text(const Trajectory& trajectory);
/// Throws: Error.
void write_trajectory(const Trajectory& trajectory, const std::string& path);

/// Hash of canonical_text.
std::string hash(const Trajectory& trajectory);

}  // namespace glovebench::trajectories
