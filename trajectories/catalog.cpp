#include "trajectories/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/text.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

namespace fs = std::filesystem;

std::string folder_of(TrajectoryKind kind) { return kind == TrajectoryKind::source ? "sources" : "recorded"; }

/// `what` the files in the folder are, for the error.
void expect_known(const fs::path& folder, const std::string& what, const std::string& name) {
  const std::vector<std::string> known = json_names(folder);
  if (std::ranges::find(known, name) != known.end()) return;
  if (known.empty()) throw Error(folder.string(), what, "none", "files *.json");
  throw Error(what, "name", quoted_excerpt(name), one_of(known, name));
}

Trajectory trajectory_of(const std::string& data_folder, TrajectoryKind kind, const std::string& name) {
  expect_known(fs::path(data_folder) / folder_of(kind), fmt::format("{} trajectories", to_string(kind)), name);
  const std::string path = trajectory_path(data_folder, kind, name);
  Trajectory trajectory = load_trajectory(path);
  if (trajectory.name != name) throw Error(path, "name", quoted_excerpt(trajectory.name), quoted_excerpt(name));
  if (trajectory.kind != kind)
    throw Error(path, "kind", quoted_excerpt(to_string(trajectory.kind)), quoted_excerpt(to_string(kind)));
  return trajectory;
}

}  // namespace

std::vector<std::string> json_names(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

const std::vector<std::string>& ground_truth_names() {
  static const std::vector<std::string> names = {"Tr1", "Tr2", "Tr3", "Tr4", "Tr5"};
  return names;
}

std::string grasp_of(std::string_view trajectory) {
  const std::vector<std::string>& names = ground_truth_names();
  const auto found = std::ranges::find(names, trajectory);
  if (found == names.end())
    throw Error("ground truths", "trajectory", quoted_excerpt(trajectory), one_of(names, trajectory));
  constexpr int pinch_count = 2;  // Tr1 and Tr2 pinch, the others grasp with the whole hand
  return found - names.begin() < pinch_count ? "pinch" : "power";
}

std::vector<std::string> databases_of(std::string_view trajectory) {
  return {"DB_open_" + grasp_of(trajectory), "DB_open_pinch_power", "DB_20_postures"};
}

const std::vector<std::string>& posture_set_names() {
  static const std::vector<std::string> names = {"DB_open_pinch", "DB_open_power", "DB_open_pinch_power",
                                                 "DB_20_postures"};
  return names;
}

std::string trajectory_path(const std::string& data_folder, TrajectoryKind kind, const std::string& name) {
  return (fs::path(data_folder) / folder_of(kind) / (name + ".json")).string();
}

Trajectory source_trajectory(const std::string& data_folder, const std::string& name) {
  return trajectory_of(data_folder, TrajectoryKind::source, name);
}

Trajectory recorded_trajectory(const std::string& data_folder, const std::string& name) {
  return trajectory_of(data_folder, TrajectoryKind::recorded, name);
}

PostureSet posture_set(const std::string& data_folder, const std::string& name) {
  const fs::path folder = fs::path(data_folder) / "postures";
  expect_known(folder, "databases", name);
  const std::string path = (folder / (name + ".json")).string();
  PostureSet set = load_posture_set(path);
  if (set.name != name) throw Error(path, "name", quoted_excerpt(set.name), quoted_excerpt(name));
  return set;
}

PostureSet load_gestures(const std::string& data_folder) {
  return load_posture_set((fs::path(data_folder) / "gestures.csv").string());
}

PostureSet load_captured_postures(const std::string& data_folder) {
  return load_posture_set((fs::path(data_folder) / "captured.csv").string());
}

std::vector<std::string> script_names(const std::string& data_folder) {
  return json_names(fs::path(data_folder) / "scripts");
}

std::vector<TrajectoryListing> list_trajectories(const std::string& data_folder) {
  std::vector<TrajectoryListing> listing;
  for (const TrajectoryKind kind : {TrajectoryKind::source, TrajectoryKind::recorded}) {
    for (const std::string& name : json_names(fs::path(data_folder) / folder_of(kind)))
      listing.push_back({name, kind, trajectory_path(data_folder, kind, name)});
    if (listing.empty()) throw Error(data_folder, "sources", "no trajectories", "files sources/*.json");
  }
  return listing;
}

}  // namespace glovebench::trajectories
