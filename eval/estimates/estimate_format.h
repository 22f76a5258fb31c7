#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tracker/track_result.h"
#include "eval/estimates/joint_orders.h"

namespace glovebench::eval {

/// Another program's estimates of one movement, by time.
struct EstimateSequence {
  uint64_t seed = 1;
  EstimateParts has = {.internals = false};
  std::vector<int> joints;  ///< of the skeleton; empty: none
  JointOrder order;         ///< of the file, if it has joints
  std::vector<int64_t> timestamps_us;
  std::vector<TrackStatus> statuses;
  std::vector<size_t> begins;  ///< of each frame's numbers
  /// Each tracked frame adds what the file has: 22 angles (rad), position (m) and quaternion w x y z, joints (m).
  std::vector<double> numbers;

  size_t size() const { return timestamps_us.size(); }
  size_t numbers_per_frame() const;
  void reserve(size_t frames);
  /// `own`: its numbers; ignored for lost frames.
  /// Throws: Error if time does not increase, or for impossible numbers.
  void add(int64_t timestamp_us, TrackStatus status, std::span<const double> own, const std::string& where,
           const std::string& field);
  TrackResult answer(size_t frame) const;
};

/// What a file may leave unsaid. Empty: nobody says.
struct EstimateFlags {
  JointOrder order;
  std::string units;  ///< of positions: m, cm, mm, or none (without scale)
  std::string frame;  ///< of joints: camera or wrist
  std::string time;   ///< of time stamps: s, ms, us
};

/// eval/estimates/X_estimates.cpp defines `EstimateFormat X_estimates()`.
struct EstimateFormat {
  std::string_view name;
  std::string_view description;
  bool (*fits)(std::string_view path, std::string_view first_line);
  /// Throws: Error, also if neither file nor flags say a required fact.
  std::vector<EstimateSequence> (*read)(std::string_view bytes, const EstimateFlags& flags,
                                        const std::string& where);
};
std::span<const EstimateFormat> estimate_formats();

/// `format`: a name; empty: by ending and first line.
/// Throws: Error.
std::vector<EstimateSequence> load_estimates(const std::string& path, const std::string& format,
                                             const EstimateFlags& flags);

/// Adds the posture or joints of a second file at the same time stamps. A frame that one of them lacks is lost.
/// Throws: Error unless exactly the first has poses.
EstimateSequence merged(const EstimateSequence& poses, const EstimateSequence& beside, const std::string& where);

/// m per unit, 1 for "none".
/// Throws: Error for another word, or if a nonempty `flag` differs.
double meters_of(std::string_view unit, const std::string& flag, const std::string& where,
                 const std::string& field);
/// Throws: Error likewise.
double microseconds_of(std::string_view unit, const std::string& flag, const std::string& where,
                       const std::string& field);
/// Throws: Error beyond 300 years from 0.
int64_t timestamp_of(double time, double unit_us, const std::string& where, const std::string& field);
/// Position (m) and quaternion w x y z.
std::array<double, 7> pose_numbers(const Eigen::Isometry3d& T);
/// Parts of joints alone. `frame`: the file's, may be empty.
/// Throws: Error if neither file nor flags say it.
EstimateParts parts_of_joints(std::string_view units, std::string_view frame, const EstimateFlags& flags,
                              const std::string& where);

}  // namespace glovebench::eval
