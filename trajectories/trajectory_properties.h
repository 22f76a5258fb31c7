#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/cloud/labeled_cloud.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// From the last frame at one end (open, grasp) to the first at the other.
struct GraspTransition {
  int first_frame = 0;
  int last_frame = 0;
  bool closing = false;

  int frames() const { return last_frame - first_frame; }
};

struct TrajectoryProperties {
  int frames = 0;
  double duration_s = 0;
  double path_length = 0;            ///< m
  double travel = 0;                 ///< largest distance, m
  double rotation = 0;               ///< largest angle, rad
  double peak_speed = 0;             ///< between frames, m/s
  double wrist_flexion_range = 0;    ///< rad
  double wrist_abduction_range = 0;  ///< rad
  std::vector<GraspTransition> transitions;
  int longest_open_hold = 0;   ///< frames
  int longest_grasp_hold = 0;  ///< frames
  int settled_frames = 0;      ///< at either end
};

/// RMS over finger angles, rad.
double finger_distance(const Posture& a, const Posture& b);

/// Largest finger_distance of a settled frame.
inline constexpr double kSettledDeg = 8;
/// A frame within this share of the way is at an end.
inline constexpr double kTransitionEnd = 0.15;

TrajectoryProperties measure(const Trajectory& trajectory, const Posture& open, const Posture& grasp);

/// Markdown, one row per trajectory.
std::string properties_table(const std::vector<Trajectory>& trajectories,
                             const std::vector<TrajectoryProperties>& properties);

/// A sentence if the file's angles look like radians, else empty.
std::string angle_doubt(std::span<const Posture> postures);

/// A sentence per doubt about units: angle_doubt, or most frames are outside of the working volume.
std::vector<std::string> unit_doubts(const Trajectory& trajectory, const WorkingVolume& volume);

/// Angles, position and time linearly, rotation by slerp. `share`: 0 to 1.
HandFrame frame_between(const HandFrame& before, const HandFrame& after, double share);

}  // namespace glovebench::trajectories
