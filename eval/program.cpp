#include "eval/program.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/hand/hand_model.h"
#include "eval/commit.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"
#include "trajectories/generation/families/movement.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestScript = uint64_t{16} << 20;  // bytes

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// A generated movement by its name ("side_3"). Empty for another name.
std::optional<trajectories::Trajectory> make_movement(const std::string& name) {
  const auto movement = trajectories::find_movement(name);
  if (!movement) return std::nullopt;
  static const trajectories::MovementMaterial material =
      trajectories::load_movement_material(trajectory_folder(), HandModel::load(hand_mesh_path()).skeleton());
  return generate_movement(*movement->family, movement->seed, material);
}

/// Throws: Error unless the program has a trajectory of this name.
void require_known(const std::string& name) {
  std::vector<std::string> known;
  for (const trajectories::TrajectoryListing& listing : trajectories::list_trajectories(trajectory_folder()))
    if (std::ranges::find(known, listing.name) == known.end()) known.push_back(listing.name);
  if (std::ranges::find(known, name) != known.end()) return;
  const std::string names = fmt::format("{}", fmt::join(known, ", "));
  const size_t end = std::min(name.rfind('_'), name.size());
  for (const std::string& family : trajectories::movement_family_names())
    known.push_back(family + (end < name.size() ? name.substr(end) : "_1"));
  throw Error("trajectory", "name", quoted_excerpt(name),
              fmt::format("one of {}, a movement of a family as side_3 (`glovebench list families`), or a file "
                          "(*.json){}",
                          names, did_you_mean(name, known)));
}

}  // namespace

const ProgramInfo& program_info() {
  static const ProgramInfo info{GLOVEBENCH_VERSION, kCommit};
  return info;
}

reports::Timings host_timings(int threads) {
  reports::Timings timings;
  timings.host = host_name();
  timings.processor = processor_name();
  timings.threads = threads;
#ifdef __VERSION__
  timings.compiler = __VERSION__;
#endif
  timings.build_type = GLOVEBENCH_BUILD_TYPE;
  timings.commit = program_info().commit;
  timings.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                             fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  return timings;
}

std::string share_folder() {
  const std::string chosen = environment("GLOVEBENCH_SHARE");
  std::error_code error;
  const fs::path folder = chosen.empty() ? fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() /
                                               "share" / "glovebench"
                                         : fs::path(chosen);
  if (!fs::is_directory(folder, error)) {
    throw Error(folder.string(), "data folder", "nothing",
                "the program's data beside it (or GLOVEBENCH_SHARE set to it)");
  }
  return folder.string();
}

std::string hand_mesh_path() { return share_folder() + "/generic-hand-right.glb"; }

std::string trajectory_folder() { return share_folder() + "/trajectories/data"; }

std::string suite_folder() { return share_folder() + "/suites"; }

std::vector<std::string> page_scripts() {
  const std::string folder = share_folder() + "/page/";
  std::vector<std::string> scripts;
  for (const std::string name : {"vega", "vega-lite", "vega-embed"}) {
    scripts.push_back("/*! " + name + "\n" + read_file(folder + name + ".license.txt", kLargestScript) + "*/\n" +
                      read_file(folder + name + ".min.js", kLargestScript));
  }
  return scripts;
}

std::string default_cache_folder() {
  if (const std::string chosen = environment("GLOVEBENCH_CACHE"); !chosen.empty()) return chosen;
  if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty()) return cache + "/glovebench";
  if (const std::string home = environment("HOME"); !home.empty()) return home + "/.cache/glovebench";
  return "glovebench-cache";
}

trajectories::Trajectory load_truth(const std::string& name_or_file, std::optional<reports::TruthKind> truth) {
  if (trajectories::is_trajectory_file(name_or_file)) {
    const trajectories::Trajectory trajectory = trajectories::load_trajectory(name_or_file);
    if (truth && to_string(*truth) != to_string(trajectory.kind))
      throw Error(name_or_file, "kind", std::string(to_string(trajectory.kind)), std::string(to_string(*truth)));
    return trajectory;
  }
  if (auto movement = make_movement(name_or_file)) {
    if (truth == reports::TruthKind::source) return *std::move(movement);
    throw Error(name_or_file, "truth", "recorded", "source: nothing tracked this movement to record it");
  }
  require_known(name_or_file);
  return truth == reports::TruthKind::recorded
             ? trajectories::recorded_trajectory(trajectory_folder(), name_or_file)
             : trajectories::source_trajectory(trajectory_folder(), name_or_file);
}

std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key) {
  const bool recorded = key.truth == reports::TruthKind::recorded;
  if (auto movement = make_movement(key.trajectory); movement && !recorded)
    return std::make_shared<const trajectories::Trajectory>(*std::move(movement));
  for (const trajectories::TrajectoryListing& listing : trajectories::list_trajectories(trajectory_folder())) {
    if (listing.name != key.trajectory) continue;
    if ((listing.kind == trajectories::TrajectoryKind::recorded) != recorded) continue;
    return std::make_shared<const trajectories::Trajectory>(trajectories::load_trajectory(listing.path));
  }
  return nullptr;
}

}  // namespace glovebench::eval
