#pragma once

#include <string>
#include <vector>

#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// A change between open hand and grasp: from the last frame at one end to the first frame at the other.
struct GraspTransition {
  int first_frame = 0;
  int last_frame = 0;
  bool closing = false;

  int frames() const { return last_frame - first_frame; }
};

/// What a trajectory asks of a tracker.
struct TrajectoryProperties {
  int frames = 0;
  double duration_s = 0;
  double path_length = 0;            ///< m
  double travel = 0;                 ///< largest distance between two positions, m
  double rotation = 0;               ///< largest angle between two orientations, rad
  double peak_speed = 0;             ///< between frames, m/s
  double wrist_flexion_range = 0;    ///< rad
  double wrist_abduction_range = 0;  ///< rad
  std::vector<GraspTransition> transitions;
  int longest_open_hold = 0;   ///< frames settled at the open hand in a row
  int longest_grasp_hold = 0;  ///< frames settled at the grasp in a row
  int settled_frames = 0;      ///< frames settled at either
};

/// Root mean square over the 20 angles that are not the wrist's, radians.
double finger_distance(const Posture& a, const Posture& b);

/// A frame is settled at a posture when its finger_distance to it is below this.
inline constexpr double kSettledDeg = 8;
/// A frame is at one end of a transition when it has gone less than this share of the way.
inline constexpr double kTransitionEnd = 0.15;

TrajectoryProperties measure(const Trajectory& trajectory, const Posture& open, const Posture& grasp);

/// The properties as a Markdown table, a row for each trajectory.
std::string properties_table(const std::vector<Trajectory>& trajectories,
                             const std::vector<TrajectoryProperties>& properties);

}  // namespace glovebench::trajectories
