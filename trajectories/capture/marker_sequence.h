#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

/// The points of one moment, one for each name of the sequence.
struct MarkerFrame {
  int64_t timestamp_us = 0;
  std::vector<Eigen::Vector3d> points;  ///< m, in the capture's own frame; all NaN where a point was not seen
};

/// What a motion capture says: points with names, over time.
struct MarkerSequence {
  std::vector<std::string> names;   ///< differ; those of points without a label begin as is_unlabeled says
  std::vector<MarkerFrame> frames;  ///< at least one, in time order
};

/// A file may hold as many, and coordinates this large (m).
inline constexpr size_t kMaxMarkers = 200;
inline constexpr size_t kMaxMarkerFrames = 432'000;  ///< an hour at 120 Hz
inline constexpr double kMaxCoordinate = 100;

/// The place of a point that was not seen.
inline Eigen::Vector3d gap() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}
inline bool is_seen(const Eigen::Vector3d& point) {
  return point.allFinite();
}
/// Points that the capture saw and could not name: "unlabeled...", "unnamed..." (in any case), "*...".
bool is_unlabeled(const std::string& name);

/// The timestamp in a cell of seconds. Throws Error.
int64_t timestamp_from(std::string_view cell, const std::string& where, const std::string& field);

/// The point in three cells, or a gap if all are empty or NaN. `scale`: metres of the cells' unit. Throws Error if
/// some of them are empty, or one is no number or too large.
Eigen::Vector3d point_from(std::span<const std::string_view> cells, double scale, const std::string& where,
                           const std::string& field);

/// Adds a name. Throws Error if it is no name (is_name, or '*' and a number), was there before, or is one too many.
void add_name(std::string_view name, MarkerSequence& sequence, const std::string& where, const std::string& field);

/// Adds a frame; times count from the first frame's. Throws Error if its time is not after that of the one before,
/// if there are too many, or if most points of a long capture are left out: `text_bytes`, the capture's size, does
/// not say then how many there are.
void add_frame(MarkerFrame frame, int64_t first_us, size_t text_bytes, MarkerSequence& sequence,
               const std::string& where, const std::string& field);

/// The table of the format "csv", in mm to 0.001.
std::string csv_markers(const MarkerSequence& sequence);

}  // namespace glovebench::trajectories
