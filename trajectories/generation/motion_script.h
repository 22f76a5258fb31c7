#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

inline constexpr double kFrameRateHz = 15;

/// `value_at` interpolates along minimum-jerk profiles.
template <typename Value>
struct Keyframe {
  int frame = 0;
  Value value;
};

/// rad
struct WristAngles {
  double flexion = 0;
  double abduction = 0;
};

/// Camera frame, m.
struct HandPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// The seed determines drift and tremor.
struct MotionScript {
  std::string name;
  std::string description;
  uint64_t seed = 0;
  int frame_count = 0;
  std::vector<Keyframe<Posture>> postures;
  std::vector<Keyframe<WristAngles>> wrist;
  std::vector<Keyframe<HandPose>> poses;
};

inline constexpr uint64_t kLargestMotionScript = uint64_t{1} << 18;  // bytes

/// Reads "glovebench-motion-script" (README.md). Postures blend `gestures`.
/// Throws: Error.
MotionScript parse_motion_script(std::string_view text, const PostureSet& gestures, const std::string& where);

/// Share of the way at a share of time, 0..1 (Flash and Hogan 1985).
double minimum_jerk(double time);

/// Linear from a to b. Rotations take the shortest turn.
WristAngles mix(const WristAngles& a, const WristAngles& b, double share);
Posture mix(const Posture& a, const Posture& b, double share);
HandPose mix(const HandPose& a, const HandPose& b, double share);
/// `keys`: in the order of frames. The last value stays.
template <typename Value>
Value value_at(const std::vector<Keyframe<Value>>& keys, int frame) {
  size_t next = 1;
  while (next < keys.size() && keys[next].frame < frame) ++next;
  if (next >= keys.size()) return keys.back().value;
  const Keyframe<Value>& a = keys[next - 1];
  const Keyframe<Value>& b = keys[next];
  return mix(a.value, b.value, minimum_jerk(static_cast<double>(frame - a.frame) / (b.frame - a.frame)));
}

/// R_camera_hand, rad. At 0, fingers point up in the image and the back faces the camera. Roll is about camera y,
/// pitch about x, yaw about z.
Eigen::Quaterniond hand_rotation(double yaw, double pitch, double roll);

/// At 15 Hz.
Trajectory perform(const MotionScript& script);

}  // namespace glovebench::trajectories
