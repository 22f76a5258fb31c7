#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

// Where things lie under the data folder:
//   gestures.csv            the gestures that everything is made of (written by hand)
//   captured.csv            postures of people's hands, from npm handy-work and iwer
//   scripts/Tr1.json        keyframes of a source trajectory (written by hand)
//   sources/Tr1.json        source trajectories (generated)
//   recorded/Tr1.json       recorded trajectories (frozen outputs of the tracker)
//   recorded/hashes.txt     their hashes
//   postures/DB_*.json      posture sets of the databases (generated)

/// The five ground truths of section IV: "Tr1" .. "Tr5".
const std::vector<std::string>& ground_truth_names();
/// The gesture that a ground truth grasps with, "pinch" or "power". Throws Error if there is no such trajectory.
std::string grasp_of(std::string_view trajectory);
/// The databases that contain the grasp of a ground truth, the grasp-specific one first: e.g. DB_open_power,
/// DB_open_pinch_power, DB_20_postures. Throws Error if there is no such trajectory.
std::vector<std::string> databases_of(std::string_view trajectory);
/// "DB_open_pinch", "DB_open_power", "DB_open_pinch_power", "DB_20_postures".
const std::vector<std::string>& posture_set_names();

std::string trajectory_path(const std::string& data_folder, TrajectoryKind kind, const std::string& name);

/// Trajectory `name` of the data folder. Throws Error naming the known ones if it is not there, or what is wrong
/// with its file; its name and kind must be those of its place.
Trajectory source_trajectory(const std::string& data_folder, const std::string& name);
Trajectory recorded_trajectory(const std::string& data_folder, const std::string& name);

/// A posture set of the data folder. Throws Error as above.
PostureSet posture_set(const std::string& data_folder, const std::string& name);
/// The gestures that scripts and sets are made of. Throws Error.
PostureSet load_gestures(const std::string& data_folder);
/// The postures of people's hands, which the family `captured` is made of. Throws Error.
PostureSet load_captured_postures(const std::string& data_folder);

struct TrajectoryListing {
  std::string name;
  TrajectoryKind kind;
  std::string path;
};
/// The names of the data folder's motion scripts, sorted: the ground truths, and what else has a source.
std::vector<std::string> script_names(const std::string& data_folder);

/// All trajectories of the data folder, sources first, by name; files are not opened. Throws Error if the folder
/// has no sources.
std::vector<TrajectoryListing> list_trajectories(const std::string& data_folder);

}  // namespace glovebench::trajectories
