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

// For all but captured families.
inline constexpr Range kDipShare = {0.5, 0.9};        ///< of a finger's PIP angle
inline constexpr double kNeighborCorrelation = 0.6;   ///< of neighboring fingers' flexions, index to little
inline constexpr double kGestureDistanceDeg = 15;     ///< least finger_distance from gestures
inline constexpr double kMostOverlap = 2e-3;          ///< of hand parts, m
inline constexpr double kLongestMovementRestS = 0.3;  ///< between two ways

/// Ranges to draw from (trajectories/README.md).
struct MovementFamily {
  std::string_view name;
  std::string_view description;

  // In every frame.
  Range tilt_deg;   ///< as tilt_deg() (movement.h)
  Range depth;      ///< hand's origin, m
  double off_axis;  ///< origin's largest x and y, share of half the depth image
  // Key poses.
  Range tilt_axis_deg;  ///< in the image: 0 is the hand's breadth, 90 its length; reversed in half of the
                        ///< movements
  double yaw_deg;       ///< about the optical axis, both ways
  // Between keys. The slower of both sets the time.
  Range speed;      ///< peak, m/s
  Range turn_rate;  ///< peak, rad/s

  // Key postures. 0: straight finger, 1: fist.
  std::array<Range, 2> bends;  ///< of alternate keys
  double wrist;                ///< largest share of the wrist's limits
  Range posture_s;             ///< from posture to posture, s
  bool captured = false;       ///< people's postures
};

std::span<const MovementFamily> movement_families();
std::vector<std::string> movement_family_names();
/// Throws: Error for an unknown name.
const MovementFamily& find_movement_family(std::string_view name);
std::string movement_families_text();

}  // namespace glovebench::trajectories
