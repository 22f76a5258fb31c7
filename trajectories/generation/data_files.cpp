#include "trajectories/generation/data_files.h"

#include <vector>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/database_postures.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/posture_file.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::trajectories {

std::map<std::string, std::string> generate_data_files(const std::string& data_folder) {
  const PostureSet gestures = load_gestures(data_folder);
  std::map<std::string, std::string> files;
  for (const PostureSet& set : make_database_posture_sets(gestures)) {
    files["postures/" + set.name + ".json"] = canonical_text(set);
  }
  for (const std::string& name : script_names(data_folder)) {
    const std::string path = data_folder + "/scripts/" + name + ".json";
    const MotionScript script = parse_motion_script(read_file(path, kLargestMotionScript), gestures, path);
    if (script.name != name) throw Error(path, "name", script.name, name);
    files["sources/" + name + ".json"] = canonical_text(perform(script));
  }
  return files;
}

std::string source_properties_table(const std::string& data_folder) {
  const PostureSet gestures = load_gestures(data_folder);
  std::vector<Trajectory> trajectories;
  std::vector<TrajectoryProperties> properties;
  for (const std::string& name : ground_truth_names()) {
    trajectories.push_back(source_trajectory(data_folder, name));
    properties.push_back(
        measure(trajectories.back(), find_posture(gestures, "open"), find_posture(gestures, grasp_of(name))));
  }
  return properties_table(trajectories, properties);
}

}  // namespace glovebench::trajectories
