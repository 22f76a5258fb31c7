#include "trajectories/generation/data_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/low_dispersion.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/generation/natural_variation.h"
#include "trajectories/posture_file.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::trajectories {
namespace {

constexpr uint64_t kSeed = 1;
constexpr int kPoolSize = 2000;
constexpr int kBlendedGestures = 3;
constexpr double kModeDeviation = 1.8;  ///< degrees RMS of each mode

/// Three random gestures with weights that favor one of them.
Posture random_blend(const PostureSet& gestures, RandomStream& random) {
  Posture blend = Posture::Zero();
  double total = 0;
  for (int i = 0; i < kBlendedGestures; ++i) {
    const double uniform = random.uniform();
    const double weight = uniform * uniform + 1e-6;
    blend += weight * gestures.postures[random.index(gestures.postures.size())];
    total += weight;
  }
  return blend / total;
}

/// Fingers do not bend backwards at the middle joint, and the end joint follows it.
Posture with_natural_fingers(Posture posture) {
  for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
    posture[pip] = std::max(posture[pip], 0.0);
    posture[pip + 1] = posture[pip] * kEndJointShare;
  }
  return clamp_to_limits(posture);
}

PostureSet subset(const PostureSet& gestures, const std::string& name, const std::vector<std::string>& members) {
  PostureSet set{.name = name, .posture_names = members, .postures = {}};
  for (const std::string& member : members) set.postures.push_back(find_posture(gestures, member));
  return set;
}

}  // namespace

std::vector<Posture> movement_posture_pool(const PostureSet& gestures) {
  std::vector<Posture> pool;
  for (int i = 0; i < kPoolSize; ++i) {
    RandomStream random(kSeed, "database", i, "movement posture");
    Posture posture = random_blend(gestures, random);
    for (const Posture& mode : variation_modes()) posture += kModeDeviation * random.normal() * mode;
    pool.push_back(with_natural_fingers(posture));
  }
  return pool;
}

std::vector<PostureSet> make_database_posture_sets(const PostureSet& gestures) {
  PostureSet twenty = subset(gestures, "DB_20_postures", {"open", "pinch", "power"});
  const std::vector<Posture> pool = movement_posture_pool(gestures);
  const size_t movement_count = kPostureCount20 - twenty.postures.size();
  for (const size_t index : low_dispersion_sample(pool, twenty.postures, movement_count)) {
    twenty.posture_names.push_back(fmt::format("movement_{:02}", twenty.postures.size() - 2));
    twenty.postures.push_back(pool[index]);
  }
  return {subset(gestures, "DB_open_pinch", {"open", "pinch"}),
          subset(gestures, "DB_open_power", {"open", "power"}),
          subset(gestures, "DB_open_pinch_power", {"open", "pinch", "power"}), std::move(twenty)};
}

std::map<std::string, std::string> generate_data_files(const std::string& data_folder) {
  const PostureSet gestures = load_gestures(data_folder);
  std::map<std::string, std::string> files;
  for (const PostureSet& set : make_database_posture_sets(gestures))
    files["postures/" + set.name + ".json"] = canonical_text(set);
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
