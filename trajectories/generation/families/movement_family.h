#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::trajectories {

struct Range {
  double low = 0;
  double high = 0;

  bool holds(double value) const { return low <= value && value <= high; }
};

// What holds for the postures of every family but the captured ones.
inline constexpr Range kDipShare = {0.5, 0.9};        ///< of a finger's PIP angle
inline constexpr double kNeighborCorrelation = 0.6;   ///< of neighbors' flexions, index to little, as drawn
inline constexpr double kGestureDistanceDeg = 15;     ///< the least finger_distance from each gesture
inline constexpr double kMostOverlap = 2e-3;          ///< how far flesh yields where parts of a hand touch, m
inline constexpr double kLongestMovementRestS = 0.3;  ///< between two ways, of pose and posture

/// A kind of movement, as ranges that any number of movements are drawn from. Poses and postures go from one random
/// key to the next along minimum-jerk profiles and rest there for a moment, independently of each other.
struct MovementFamily {
  std::string_view name;
  std::string_view description;

  // Where the hand is and how it is held, in every frame.
  Range tilt_deg;   ///< of the back of the hand, from facing the camera (0) to the palm facing it (180)
  Range depth;      ///< of the hand's origin, m
  double off_axis;  ///< the same: most of x and y, as a share of half the depth image there
  // Of the key poses.
  Range tilt_axis_deg;  ///< in the image, from the hand's breadth (0) to its length (90); for half of the movements
                        ///< the axis is reversed
  double yaw_deg;       ///< about the optical axis: up to that, either way
  // Of the way from key to key; the one that takes longer sets the time, so each peak is at most this.
  Range speed;      ///< peak, m/s
  Range turn_rate;  ///< peak, rad/s

  // Key postures. 0 is a straight finger, 1 a fist.
  std::array<Range, 2> bends;  ///< of every other key
  double wrist;                ///< the largest share of the wrist's limits
  Range posture_s;             ///< time from one posture to the next
  bool captured = false;       ///< postures are those of people, not random ones
};

/// All families, in the order in which they are listed.
std::span<const MovementFamily> movement_families();
std::vector<std::string> movement_family_names();
/// Throws Error listing the known ones.
const MovementFamily& find_movement_family(std::string_view name);
/// What `glovebench list families` prints: each family with its ranges, and what holds for all.
std::string movement_families_text();

}  // namespace glovebench::trajectories
