#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

struct MarkerFrame {
  int64_t timestamp_us = 0;
  std::vector<Eigen::Vector3d> points;  ///< by name, capture frame, m; NaN: gap
};

struct MarkerSequence {
  std::vector<std::string> names;   ///< distinct
  std::vector<MarkerFrame> frames;  ///< in time order, not empty
};

inline constexpr size_t kMaxMarkers = 200;
inline constexpr size_t kMaxMarkerFrames = 432'000;
inline constexpr double kMaxCoordinate = 100;

inline Eigen::Vector3d gap() { return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }
inline bool is_seen(const Eigen::Vector3d& point) { return point.allFinite(); }
/// True for "unlabeled...", "unnamed..." (any case) and "*...".
bool is_unlabeled(const std::string& name);

/// `cell`: seconds.
/// Throws: Error.
int64_t timestamp_from(std::string_view cell, const std::string& where, const std::string& field);

/// A gap if all cells are empty or NaN. `scale`: m per unit.
/// Throws: Error if only some cells are empty, or one is invalid.
Eigen::Vector3d point_from(std::span<const std::string_view> cells, double scale, const std::string& where,
                           const std::string& field);

/// Throws: Error for an invalid or repeated name, or too many.
void add_name(std::string_view name, MarkerSequence& sequence, const std::string& where, const std::string& field);

/// Times count from `first_us`.
/// Throws: Error if time does not increase, or for too many frames, or gaps for `text_bytes`.
void add_frame(MarkerFrame frame, int64_t first_us, size_t text_bytes, MarkerSequence& sequence,
               const std::string& where, const std::string& field);

/// Format "csv", mm to 0.001.
std::string csv_markers(const MarkerSequence& sequence);

/// Largest distance from a marker's predicted place, m.
inline constexpr double kLabelGate = 0.015;

struct Relabeling {
  std::vector<Eigen::Vector3d> points;  ///< a point or gap per marker
  int corrected = 0;                    ///< markers whose point changed or vanished
};

/// Assigns points within kLabelGate to markers by the least sum of squared distances. A marker's own point counts
/// as half as far. `predicted`, `labeled`: one per marker.
Relabeling relabel(const std::vector<Eigen::Vector3d>& predicted, const std::vector<Eigen::Vector3d>& labeled,
                   const std::vector<Eigen::Vector3d>& unlabeled);

/// A distinct column per row, with the least sum of finite costs (Kuhn and Munkres). Needs rows <= columns.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace glovebench::trajectories
