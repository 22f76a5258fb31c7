#include "eval/run_mcap.h"

#include <algorithm>

#include "eval/frame_formats/frame_format.h"
#include "reports/estimates.h"

namespace glovebench::eval {
namespace {

Estimator stored_estimates(const std::string& path, uint64_t seed) {
  return [estimates = reports::read_estimates(path), seed](const DeviceFrame&, int number) {
    return reports::find_hand(estimates, seed, number);
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
