#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

/// Names of the JSON files in a folder, sorted. Empty if there is no such folder.
std::vector<std::string> json_names(const std::string& folder);

// The data folder (README.md).

/// The ground truths of section IV.
const std::vector<std::string>& ground_truth_names();
/// "pinch" or "power".
/// Throws: Error for another name.
std::string grasp_of(std::string_view trajectory);
/// Databases with its grasp, the one for this grasp first.
/// Throws: Error for another name.
std::vector<std::string> databases_of(std::string_view trajectory);
const std::vector<std::string>& posture_set_names();

std::string trajectory_path(const std::string& data_folder, TrajectoryKind kind, const std::string& name);

/// Throws: Error, also if name or kind do not match the path.
Trajectory source_trajectory(const std::string& data_folder, const std::string& name);
Trajectory recorded_trajectory(const std::string& data_folder, const std::string& name);

/// Throws: Error, also if the name does not match.
PostureSet posture_set(const std::string& data_folder, const std::string& name);
/// Throws: Error.
PostureSet load_gestures(const std::string& data_folder);
/// People's postures, for the family `captured`.
/// Throws: Error.
PostureSet load_captured_postures(const std::string& data_folder);

struct TrajectoryListing {
  std::string name;
  TrajectoryKind kind;
  std::string path;
};
/// Sorted.
std::vector<std::string> script_names(const std::string& data_folder);

/// Sources first, each kind by name. Opens no file.
/// Throws: Error without sources.
std::vector<TrajectoryListing> list_trajectories(const std::string& data_folder);

}  // namespace glovebench::trajectories
