#include "eval/run_mcap.h"

#include <algorithm>
#include <map>

#include "eval/frame_formats/frame_format.h"
#include "reports/estimates.h"

namespace glovebench::eval {
namespace {

Estimator stored_estimates(const std::string& path, uint64_t seed) {
  std::map<int, HandFrame> tracked;
  for (const reports::Estimate& estimate : reports::read_estimates(path))
    if (estimate.seed == seed && estimate.status == TrackStatus::tracked)
      tracked[estimate.frame] = {estimate.timestamp_us, estimate.posture, estimate.T_camera_hand};
  return [tracked](const DeviceFrame&, int number) {
    const auto found = tracked.find(number);
    return found == tracked.end() ? std::optional<HandFrame>() : found->second;
  };
}

}  // namespace

void write_run_mcaps(Workbench& workbench, const Plan& plan, const std::string& folder) {
  const FrameFormat& mcap = find_frame_format("mcap");
  std::vector<reports::ExperimentKey> written;
  for (const RunSpec& spec : plan.specs) {
    const reports::ExperimentKey key = key_of(spec);
    if (std::ranges::find(written, key) != written.end()) continue;
    written.push_back(key);
    const Dataset dataset{folder, to_string(key), workbench.calibration(), workbench.model(),
                          dataset_readme(mcap, spec)};
    write_frames(workbench, spec, stored_estimates(folder + "/" + reports::estimates_file(key), spec.seed), mcap,
                 dataset);
  }
}

}  // namespace glovebench::eval
