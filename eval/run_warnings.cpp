#include "eval/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "eval/program.h"
#include "reports/page/page.h"
#include "reports/text.h"
#include "trajectories/catalog.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentKey;
using trajectories::Trajectory;

std::map<std::string, RunSpec> specs_by_truth(const Plan& plan) {
  std::map<std::string, RunSpec> specs;
  for (const RunSpec& spec : plan.specs) specs.try_emplace(truth_name(key_of(spec)), spec);
  return specs;
}

bool is_from_file(const RunSpec& spec) {
  if (!spec.setting.empty()) return false;  // a family's
  const std::shared_ptr<const Trajectory> known = find_truth(key_of(spec));
  return !known || hash(*known) != hash(*spec.trajectory);
}

}  // namespace

std::vector<std::string> unit_warnings(const Plan& plan) {
  std::vector<std::string> warnings;
  for (const auto& [name, spec] : specs_by_truth(plan))
    for (const std::string& doubt : trajectories::unit_doubts(*spec.trajectory, plan.tracker.volume))
      warnings.push_back(fmt::format("{}: {}", spec.trajectory->name, doubt));
  return warnings;
}

std::vector<std::string> lost_hand_warnings(const Plan& plan, const reports::RunResult& result,
                                            const std::string& folder) {
  std::vector<std::string> warnings;
  if (is_program(plan.tracker.method)) return warnings;
  for (const reports::ExperimentResult& experiment : result.experiments) {
    const reports::Coverage& coverage = experiment.coverage;
    if (coverage.frames == 0 || coverage.lost < coverage.frames) continue;
    const reports::SeedRun& run = experiment.runs.front();
    warnings.push_back(fmt::format(
        "{}: none of {} frames was tracked. Likely causes: the hand is outside of the image or of the working "
        "volume ({:g} to {:g} mm), or the database lacks its postures.",
        to_string(experiment.key), coverage.frames, 1000 * plan.tracker.volume.z_min,
        1000 * plan.tracker.volume.z_max));
    if (!shows_stages(plan.tracker.method)) continue;
    warnings.back() += " To see: " + reports::explain_command({experiment.key, run.seed, run.frames.front(), ""},
                                                              inputs_from_files(plan), folder);
  }
  return warnings;
}

std::vector<std::string> no_answer_warnings(const std::map<std::string, size_t>& reasons) {
  constexpr size_t kMost = 5;
  std::vector<std::pair<std::string, size_t>> sorted(reasons.begin(), reasons.end());
  std::ranges::stable_sort(sorted, std::greater(), [](const auto& entry) { return entry.second; });
  std::vector<std::string> warnings;
  size_t others = 0;
  for (size_t i = 0; i < sorted.size(); ++i) {
    const auto& [reason, frames] = sorted[i];
    if (i >= kMost)
      others += frames;
    else
      warnings.push_back(fmt::format("{} lost, no answer: {}", reports::counted(frames, "frame"), reason));
  }
  if (others > 0) warnings.push_back(fmt::format("{} lost for other reasons", reports::counted(others, "frame")));
  return warnings;
}

std::map<std::string, size_t> no_answer_reasons(std::span<const MeasuredRun> runs) {
  std::map<std::string, size_t> reasons;
  for (const MeasuredRun& each : runs)
    for (const TrackResult& answer : each.run.answers)
      if (!answer.reason.empty()) ++reasons[answer.reason];
  return reasons;
}

std::set<std::string> inputs_from_files(const Plan& plan) {
  std::set<std::string> names;
  for (const auto& [name, spec] : specs_by_truth(plan))
    if (is_from_file(spec)) names.insert(name);
  const std::vector<std::string>& known = trajectories::posture_set_names();
  for (const RunSpec& spec : plan.specs)
    if (std::ranges::find(known, spec.database) == known.end()) names.insert(spec.database);
  return names;
}

}  // namespace glovebench::eval
