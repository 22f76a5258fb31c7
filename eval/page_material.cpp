#include "eval/page_material.h"

#include <algorithm>

#include "core/base/error.h"
#include "eval/explain.h"
#include "eval/keyframes.h"
#include "eval/share.h"
#include "eval/truths.h"
#include "render/pictures.h"
#include "reports/page/gallery.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::Estimate;
using reports::ExperimentKey;

constexpr int kJpegQuality = 80;

/// The replay of an experiment's seed, with that database alone; null if the plan has none.
std::optional<Replay> find_replay(const Plan& plan, const ExperimentKey& key, uint64_t seed) {
  for (const Replay& replay : plan.replays) {
    if (replay.seed != seed || key_of(replay, key.database) != key) continue;
    if (std::ranges::find(replay.databases, key.database) == replay.databases.end()) continue;
    Replay found = replay;
    found.databases = {key.database};
    return found;
  }
  return std::nullopt;
}

/// Of the experiment's first seed.
std::vector<Estimate> first_seed(const std::vector<reports::ExperimentEstimates>& all, const ExperimentKey& key) {
  std::vector<Estimate> estimates;
  const auto found = std::ranges::find(all, key, &reports::ExperimentEstimates::key);
  if (found == all.end()) return estimates;
  for (const Estimate& estimate : found->estimates)
    if (estimate.seed == found->estimates.front().seed) estimates.push_back(estimate);
  return estimates;
}

std::vector<reports::FrameSheet> make_sheets(Workbench& workbench, const Plan& plan, const Outcome& outcome) {
  const reports::PaperNumbers& paper = reports::paper_numbers();
  const reports::NoiseSetting noise = reports::headline_noise(outcome.result);
  std::vector<reports::FrameSheet> sheets;
  for (const auto& [figure, curve] : {std::pair{"figure5", &paper.figure_5}, {"figure6", &paper.figure_6}}) {
    const ExperimentKey key = {curve->trajectory, curve->database, reports::TruthKind::recorded, 1, noise};
    const std::vector<Estimate> estimates = first_seed(outcome.estimates, key);
    if (estimates.empty()) continue;
    const std::optional<Replay> replay = find_replay(plan, key, estimates.front().seed);
    check(replay.has_value(), "estimates come from a replay of the plan");
    sheets.push_back(make_frame_sheet(workbench, figure, frames_of(*replay), estimates));
  }
  return sheets;
}

/// With what the user of a trajectory or a database of their own has to add.
std::string complete_command(const reports::WorstFrame& worst) {
  std::string command = explain_command(worst);
  if (!find_truth(worst.key)) command += " --trajectory FILE_OF_THE_TRUTH";
  const std::vector<std::string>& known = trajectories::posture_set_names();
  if (std::ranges::find(known, worst.key.database) == known.end()) command += " --database FILE_OF_THE_DATABASE";
  return command;
}

std::vector<reports::Picture> picture_worst_frames(Workbench& workbench, const Plan& plan,
                                                   const reports::RunResult& result) {
  std::vector<reports::Picture> pictures;
  for (const reports::WorstFrame& worst : reports::worst_frames(result)) {
    const std::optional<Replay> replay = find_replay(plan, worst.key, worst.seed);
    check(replay.has_value(), "frames come from a replay of the plan");
    const ColorImage picture = explain_frame(workbench, *replay, worst.frame.frame);
    pictures.push_back({caption(worst), render::encode_jpeg(picture, kJpegQuality), complete_command(worst)});
  }
  return pictures;
}

}  // namespace

reports::PageMaterial page_material(Workbench& workbench, const Plan& plan, const Outcome& outcome) {
  reports::PageMaterial material{page_scripts(), make_sheets(workbench, plan, outcome), {}};
  // Only the paper's method has stages that can be shown.
  if (plan.tracker.method == kPaperMethod)
    material.worst_frames = picture_worst_frames(workbench, plan, outcome.result);
  return material;
}

}  // namespace glovebench::eval
