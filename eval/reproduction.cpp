#include "eval/reproduction.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/adapters/process/process_method.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/tracker/tracker_config.h"
#include "eval/program.h"
#include "eval/run_bytes.h"
#include "eval/studies/study.h"
#include "reports/paper_numbers.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::PaperCurve;
using reports::TruthKind;

constexpr const char *kFigure4 = "fig4", *kFigure5 = "fig5", *kFigure6 = "fig6";

// For estimates: CPU times of one core of a Xeon server.
constexpr double kFrameCpu_s = 0.03;     ///< to render, track and measure a frame
constexpr double kQuickStudyCpu_s = 12;  ///< of the mean

std::string about(double seconds) {
  if (seconds >= 90) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.0f} s", std::max(1.0, seconds));
}

bool is_wanted(const ReproductionOptions& options, std::string_view part) {
  if (part == kFigure4 && !options.trajectories.empty()) return true;
  if (options.only.empty()) return options.trajectories.empty();
  return std::ranges::find(options.only, part) != options.only.end();
}

bool is_wanted(const ReproductionOptions& options, const Study& study) {
  return is_wanted(options, study.name) && !(study.on_request && options.only.empty());
}

void refuse_unknown_parts(const std::vector<std::string>& only) {
  const std::vector<std::string> known = part_names();
  for (const std::string& part : only) {
    if (std::ranges::find(known, part) != known.end()) continue;
    throw Error("--only", "part", part.empty() ? "an empty name" : part, one_of(known, part));
  }
}

/// The single experiment of Figure 5 or 6, unless it is planned as one of Figure 4's.
void add_curve(Plan& plan, const ReproductionOptions& options, const PaperCurve& curve) {
  const auto truth = std::make_shared<const trajectories::Trajectory>(
      trajectories::recorded_trajectory(trajectory_folder(), curve.trajectory));
  RunSpec spec;
  spec.trajectory = truth;
  spec.database = curve.database;
  spec.frames = frames_of(options.study);
  spec.tracker = options.study.tracker;
  if (std::ranges::find(plan.specs, key_of(spec), key_of) != plan.specs.end()) return;
  for (const uint64_t seed : options.study.seeds) {
    spec.seed = seed;
    plan.specs.push_back(spec);
  }
}

/// Hashes of all files of the data folder, by path.
std::map<std::string, std::string> data_hashes() {
  const std::string folder = trajectory_folder();
  std::error_code error;
  const std::filesystem::recursive_directory_iterator files(folder, error);
  if (error) throw Error(folder, "data folder", error.message(), "the program's data");
  std::map<std::string, std::string> hashes;
  for (const auto& entry : files)
    if (entry.is_regular_file()) hashes[entry.path().lexically_relative(folder)] = hash_file(entry.path());
  return hashes;
}

reports::StudyResult run_or_load(const StudyContext& context, const Study& study) {
  const std::string key = study_key(context.workbench, study.name, context.options);
  if (const auto stored = context.store->load(key))
    if (auto result = study_from_bytes(*stored)) return *std::move(result);
  reports::StudyResult result = study.run(context);
  context.store->save(key, to_bytes(result));
  return result;
}

}  // namespace

std::string study_key(Workbench& workbench, std::string_view name, const StudyOptions& options) {
  std::vector<std::string> cascades;
  for (const Cascade& cascade : options.cascades) cascades.push_back(to_string(cascade));
  const nlohmann::json content = {
      {"study", name},
      {"configuration", to_json(options.tracker)},
      {"program", is_program(options.tracker.method) ? program_hash(options.tracker.method) : ""},
      {"seeds", options.seeds},
      {"quick", options.quick},
      {"cascades", cascades},
      {"data", data_hashes()},
      {"package_hand", workbench.package_hand()->hash()},  // subjects and color tables are made from it
      {"hand_and_views", Database::input_hash({}, *workbench.model(), workbench.config().views)},
      {"memory", to_string(workbench.config().memory)},
      {"calibration", to_json(workbench.calibration())},
      {"host", host_timings(1).host},  // a study holds times
  };
  return hash_text(content.dump());
}

std::vector<std::string> part_names() {
  std::vector<std::string> names = {kFigure4, kFigure5, kFigure6};
  for (const Study& study : studies()) names.emplace_back(study.name);
  return names;
}

int exit_code_of(const reports::RequiredClaims& required, const ReproductionOptions& options, bool judged) {
  constexpr int kClaimFailed = 1, kIncomplete = 3;
  if (required.failed > 0) return kClaimFailed;
  const bool all_of_figure4 = is_wanted(options, kFigure4) && options.trajectories.empty();
  return judged && all_of_figure4 && required.not_run > 0 ? kIncomplete : 0;
}

Plan plan_reproduction(const ReproductionOptions& options) {
  refuse_unknown_parts(options.only);
  Plan plan{options.study.tracker, {}, {}, options.study.quick};
  if (is_wanted(options, kFigure4))
    plan.specs = plan_figure4(options.study.tracker,
                              {options.trajectories, options.study.seeds, options.noises, frames_of(options.study)})
                     .specs;
  if (is_wanted(options, kFigure5)) add_curve(plan, options, reports::paper_numbers().figure_5);
  if (is_wanted(options, kFigure6)) add_curve(plan, options, reports::paper_numbers().figure_6);
  return plan;
}

std::string describe_reproduction(Workbench& workbench, const ReproductionOptions& options) {
  const Plan plan = plan_reproduction(options);
  double total_s = 0;
  std::string text;
  const auto add_part = [&](std::string_view name, const std::string& what, double seconds) {
    text += fmt::format("{:<10} {:<50} {:>8}\n", name, what, about(seconds));
    total_s += seconds;
  };
  if (!plan.specs.empty()) {
    size_t frames = 0;
    for (const RunSpec& spec : plan.specs) frames += frames_of(spec).size();
    add_part(is_wanted(options, kFigure4) ? "fig4-fig6" : "fig5, fig6",
             fmt::format("{} runs, {} frames", plan.specs.size(), frames),
             kFrameCpu_s * static_cast<double>(frames) / workbench.config().threads);
  }
  for (const Study& study : studies()) {
    if (!is_wanted(options, study)) continue;
    const double seeds = options.study.quick ? 1 : static_cast<double>(options.study.seeds.size());
    const double cpu_s = options.study.quick ? kQuickStudyCpu_s : study.cpu_s * seeds;
    add_part(study.name, std::string(study.title), cpu_s / workbench.config().threads);
  }
  add_part("together", "", total_s);
  std::vector<std::string> missing;
  for (const std::string& name : trajectories::posture_set_names())
    if (!workbench.has_database(name)) missing.push_back(name);
  if (!missing.empty()) text += fmt::format("databases to be built: {}\n", fmt::join(missing, ", "));
  return text;
}

Outcome reproduce(Workbench& workbench, const ReproductionOptions& options, const RobotOutput& robot,
                  const std::string& folder, const ShowResults& show) {
  const auto add_studies = [&](reports::RunResult& result, RunStore& store) {
    show(result);
    for (const Study& study : studies()) {
      if (!is_wanted(options, study)) continue;
      result.studies.push_back(run_or_load({workbench, options.study, &store}, study));
      show(result);
    }
  };
  return carry_out(workbench, plan_reproduction(options), robot, folder, add_studies);
}

}  // namespace glovebench::eval
