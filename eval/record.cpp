#include "eval/record.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "eval/run.h"

namespace glovebench::eval {

trajectories::Trajectory record_truth(Workbench& workbench, const trajectories::Trajectory& source,
                                      const std::string& database, const TrackerConfig& config, uint64_t seed) {
  RunSpec spec;
  spec.trajectory = std::make_shared<const trajectories::Trajectory>(source);
  spec.noise = {"kinect", 1};  // the paper recorded with a real Kinect
  spec.seed = seed;
  spec.database = database;
  spec.tracker = config;
  const Run run = execute(workbench, {&spec, 1}, {}).front();

  trajectories::Trajectory recorded = source;
  recorded.kind = trajectories::TrajectoryKind::recorded;
  recorded.description =
      fmt::format("{} as the {} profile tracked it with {}", source.name, config.profile, database);
  recorded.provenance = trajectories::Provenance{source.name,    trajectories::hash(source),
                                                 database,       workbench.database(database)->input_hash(),
                                                 config.profile, hash_text(to_json(config).dump())};
  for (size_t f = 0; f < recorded.frames.size(); ++f) {
    const TrackResult& result = run.answers[f];
    if (result.status != TrackStatus::tracked) {
      throw Error(source.name, fmt::format("frame {}", f), std::string(to_string(result.status)),
                  "a tracked frame: a truth has no gaps");
    }
    if (!result.has.hand()) throw Error(config.method, fmt::format("frame {}", f), "no posture or no pose", "both");
    recorded.frames[f].posture = result.posture;
    recorded.frames[f].T_camera_hand = result.T_camera_hand;
  }
  return recorded;
}

}  // namespace glovebench::eval
