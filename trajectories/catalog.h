#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

// In the data folder: gestures.csv, captured.csv (postures of people's hands, from npm handy-work and iwer) and
// scripts/Tr1.json (written by hand); sources/Tr1.json and postures/DB_*.json (generated from those);
// recorded/Tr1.json and recorded/hashes.txt (frozen outputs of the tracker).

/// The ground truths of section IV.
const std::vector<std::string>& ground_truth_names();
/// "pinch" or "power".
/// Throws: Error for another name.
std::string grasp_of(std::string_view trajectory);
/// The databases that contain its grasp, the grasp-specific one first.
/// Throws: Error for another name.
std::vector<std::string> databases_of(std::string_view trajectory);
const std::vector<std::string>& posture_set_names();

std::string trajectory_path(const std::string& data_folder, TrajectoryKind kind, const std::string& name);

/// Throws: Error listing the known names or naming the file's fault; name and kind must match the place.
Trajectory source_trajectory(const std::string& data_folder, const std::string& name);
Trajectory recorded_trajectory(const std::string& data_folder, const std::string& name);

/// Throws: Error as above.
PostureSet posture_set(const std::string& data_folder, const std::string& name);
/// Throws: Error.
PostureSet load_gestures(const std::string& data_folder);
/// The postures of people's hands, which the family `captured` is made of. Throws Error.
PostureSet load_captured_postures(const std::string& data_folder);

struct TrajectoryListing {
  std::string name;
  TrajectoryKind kind;
  std::string path;
};
/// Sorted.
std::vector<std::string> script_names(const std::string& data_folder);

/// Lists sources first, each kind by name; opens no file.
/// Throws: Error if there are no sources.
std::vector<TrajectoryListing> list_trajectories(const std::string& data_folder);

}  // namespace glovebench::trajectories
