#include "eval/record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "eval/replay.h"
#include "eval/terminal.h"

namespace glovebench::eval {

trajectories::Trajectory record_truth(Workbench& workbench, const trajectories::Trajectory& source,
                                      const std::string& database, const TrackerConfig& config, uint64_t seed) {
  Replay pass;
  pass.truth = std::make_shared<const trajectories::Trajectory>(source);
  pass.noise = {"kinect", 1};  // the paper recorded with a real Kinect
  pass.seed = seed;
  pass.databases = {database};
  pass.tracker = config;
  Progress progress("recording " + source.name, workbench.config().quiet);
  size_t done = 0;
  const TrackedReplay tracked =
      replay(workbench, pass, [&] { progress.show(static_cast<double>(++done) / source.frames.size()); }).front();

  trajectories::Trajectory recorded = source;
  recorded.kind = trajectories::TrajectoryKind::recorded;
  recorded.description =
      fmt::format("{} as the {} profile tracked it with {}", source.name, config.profile, database);
  recorded.provenance = trajectories::Provenance{source.name,    trajectories::hash(source),
                                                 database,       workbench.database(database)->input_hash(),
                                                 config.profile, hash_text(to_json(config).dump())};
  for (size_t f = 0; f < recorded.frames.size(); ++f) {
    const TrackResult& result = tracked.results[f];
    if (result.status != TrackStatus::tracked) {
      throw Error(source.name, fmt::format("frame {}", f), std::string(to_string(result.status)),
                  "a tracked frame: a truth has no gaps");
    }
    recorded.frames[f].posture = result.posture;
    recorded.frames[f].T_camera_hand = result.T_camera_hand;
  }
  return recorded;
}

}  // namespace glovebench::eval
