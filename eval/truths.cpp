#include "eval/truths.h"

#include "eval/share.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {

std::shared_ptr<const trajectories::Trajectory> find_truth(const reports::ExperimentKey& key) {
  const bool recorded = key.truth == reports::TruthKind::recorded;
  for (const trajectories::TrajectoryListing& listing : trajectories::list_trajectories(trajectory_folder())) {
    if (listing.name != key.trajectory) continue;
    if ((listing.kind == trajectories::TrajectoryKind::recorded) != recorded) continue;
    return std::make_shared<const trajectories::Trajectory>(trajectories::load_trajectory(listing.path));
  }
  return nullptr;
}

}  // namespace glovebench::eval
