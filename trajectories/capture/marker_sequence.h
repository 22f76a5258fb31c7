#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
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

}  // namespace glovebench::trajectories
