#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/database/database.h"
#include "core/hand/skeleton.h"
#include "trajectories/generation/families/movement_family.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

inline constexpr int kMovementFrames = 100;            ///< of a movement that is known by its name alone
inline constexpr uint64_t kMostMovements = 1'000'000;  ///< the largest seed

/// What movements are made with.
struct MovementMaterial {
  PostureSet gestures;                              ///< random postures keep away from them
  PostureSet captured;                              ///< the postures of captured families
  Skeleton skeleton;                                ///< of the hand whose parts must not pierce each other
  double least_distance_deg = kGestureDistanceDeg;  ///< finger_distance from each gesture
};
/// From the data folder. Throws Error.
MovementMaterial load_movement_material(const std::string& data_folder, const Skeleton& skeleton);

/// A movement of a family at 15 Hz: all that it depends on are family, seed and material. A shorter one is the
/// beginning of a longer one. Throws Error if the ranges leave no posture or pose to go to.
Trajectory generate_movement(const MovementFamily& family, uint64_t seed, const MovementMaterial& material,
                             int frame_count = kMovementFrames);

/// "side_3": the movement of a family and a seed.
std::string movement_name(const MovementFamily& family, uint64_t seed);
/// A movement by its name.
struct NamedMovement {
  const MovementFamily* family = nullptr;
  uint64_t seed = 0;
};
/// Empty if the name is not that of a movement.
std::optional<NamedMovement> find_movement(std::string_view name);

/// The angle between the back of the hand and the camera's view, deg: 0 if it faces the camera, 180 if the palm
/// does.
double tilt_deg(const Eigen::Matrix3d& R_camera_hand);

}  // namespace glovebench::trajectories
