#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/hand/hand_frame.h"

namespace glovebench::trajectories {

/// `source`: the movement itself, which no tracker has seen. `recorded`: the output of the tracker when it
/// followed a source (the paper's protocol, section IV).
enum class TrajectoryKind { source, recorded };
constexpr auto names_of(TrajectoryKind) {
  return std::to_array<std::string_view>({"source", "recorded"});
}

/// What a recorded trajectory was made from: enough to record it again and to notice a change.
struct Provenance {
  std::string source;         ///< name of the source trajectory
  std::string source_hash;    ///< its `hash`
  std::string database;       ///< e.g. "DB_open_power"
  std::string database_hash;  ///< hash of the database's inputs
  std::string profile;        ///< of the tracker, e.g. "paper"
  std::string profile_hash;   ///< hash of the tracker's effective configuration

  friend bool operator==(const Provenance&, const Provenance&) = default;
};

/// A movement of the hand in front of the camera: a ground truth.
struct Trajectory {
  std::string name;
  std::string description;
  Side side = Side::right;
  TrajectoryKind kind = TrajectoryKind::source;
  std::optional<Provenance> provenance;  ///< there if and only if `kind` is `recorded`
  std::vector<HandFrame> frames;         ///< at least one, in time order
};

inline constexpr int64_t kMaxTimestampUs = 1'000'000'000'000'000;  ///< 31 years
inline constexpr double kMaxPositionMm = 10'000;                   ///< of each coordinate, either sign
/// A file's quaternion may be this far from unit length (a value typed with four decimals passes); it is
/// normalized.
inline constexpr double kQuaternionNormTolerance = 1e-3;

/// Reads the JSON format of README.md. `where` names the text in messages. Throws Error naming the field, what
/// was found and what was expected.
Trajectory parse_trajectory(std::string_view text, const std::string& where);

/// The canonical file content: angles to 0.001 deg, positions to 0.001 mm, quaternions to 1e-7 with w >= 0.
/// Byte for byte the same for the same trajectory, and for the one parsed from it. Throws Error if the trajectory
/// would be refused by parse_trajectory.
std::string canonical_text(const Trajectory& trajectory);
/// Writes the canonical content. Throws Error.
void write_trajectory(const Trajectory& trajectory, const std::string& path);

/// The hash of the canonical content: identifies a truth in results.
std::string hash(const Trajectory& trajectory);

}  // namespace glovebench::trajectories
