#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/random.h"
#include "core/database/database.h"
#include "core/hand/skeleton.h"
#include "trajectories/generation/families/movement_family.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

inline constexpr int kMovementFrames = 100;            ///< of movements known by name
inline constexpr uint64_t kMostMovements = 1'000'000;  ///< largest seed

struct MovementMaterial {
  PostureSet gestures;                              ///< that random postures avoid
  PostureSet captured;                              ///< for captured families
  Skeleton skeleton;                                ///< its parts must not overlap
  double least_distance_deg = kGestureDistanceDeg;  ///< finger_distance from each gesture
};
/// Throws: Error.
MovementMaterial load_movement_material(const std::string& data_folder, const Skeleton& skeleton);

/// Within limits and `bend`. MCP and PIP flexions are uniform and correlated (kNeighborCorrelation). DIP is a
/// share of PIP (kDipShare). Parts may overlap, and a gesture may be near.
Posture random_posture(const MovementFamily& family, const Range& bend, RandomStream& random);

/// At 15 Hz. Depends only on family, seed and material. A shorter movement is the beginning of a longer one.
/// Throws: Error if the ranges allow no posture or pose.
Trajectory generate_movement(const MovementFamily& family, uint64_t seed, const MovementMaterial& material,
                             int frame_count = kMovementFrames);

/// "side_3".
std::string movement_name(const MovementFamily& family, uint64_t seed);
struct NamedMovement {
  const MovementFamily* family = nullptr;
  uint64_t seed = 0;
};
/// Empty for other names.
std::optional<NamedMovement> find_movement(std::string_view name);

/// 0 if the back of the hand faces the camera, 180 if the palm does.
double tilt_deg(const Eigen::Matrix3d& R_camera_hand);

}  // namespace glovebench::trajectories
