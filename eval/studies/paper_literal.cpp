#include <fmt/format.h>

#include "core/base/error.h"
#include "eval/experiment.h"
#include "eval/studies/study.h"
#include "reports/claims/claims_report.h"
#include "reports/claims/figure4_measures.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

using reports::ClaimVerdict;
using reports::ExperimentResult;
using reports::Row;
using reports::RunResult;
using reports::Table;

constexpr std::array<std::string_view, 2> kProfiles = {"paper", "paper-literal"};

/// Figure 4 with a profile; a quick one has a stretch of one movement.
RunResult figure4_of(const StudyContext& context, std::string_view name) {
  Figure4Options options;
  options.seeds = context.options.seeds;
  options.frames = frames_of(context.options);
  if (context.options.quick) options.trajectories = {"Tr4"};
  const Plan plan = plan_figure4(profile(std::string(name)), options);
  const RunOptions how = {context.workbench.config().threads, context.store};
  return results_of(plan, measure(context.workbench, execute(context.workbench, plan.specs, how)),
                    context.workbench);
}

Table empty_errors_table() {
  Table table = {
      "paper_literal",
      "Two readings of section III-C",
      "The paper smooths \"the posture and pose estimation by interpolating with estimations from the three "
      "previous frames\". Its Figure 5 shows how for the posture: each frame keeps 3/4 of the previous answer and "
      "so "
      "lags by three. \"paper-literal\" filters the pose like that, too. \"paper\" does not, since the rotation "
      "errors of Figure 5 jump from frame to frame. Mean errors of the tracked frames of Figure 4; found: of the "
      "frames in which the hand is visible. Nothing here decides an exit code.",
      {{"trajectory", "trajectory"}, {"database", "database"}, {"truth", "truth"}, {"noise", "noise"}},
      4,
      {}};
  struct Pair {
    const char *key, *heading;
  };
  for (const Pair& pair : {Pair{"position_error_mm", "mm"}, Pair{"posture_rms_deg", "posture deg"},
                           Pair{"rotation_error_deg", "rotation deg"}, Pair{"found_percent", "found %"}})
    for (const char* name : {"paper", "literal"})
      table.columns.push_back({fmt::format("{}_{}", name, pair.key), fmt::format("{} {}", name, pair.heading)});
  return table;
}

Table errors_table(const RunResult& paper, const RunResult& literal) {
  Table table = empty_errors_table();
  for (const ExperimentResult& experiment : paper.experiments) {
    const ExperimentResult* other = find_experiment(literal, experiment.key);
    check(other != nullptr, "both profiles run the same experiments");
    Row& row = table.rows.emplace_back(reports::experiment_names(experiment.key));
    for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg"})
      for (const ExperimentResult* each : {&experiment, other})
        row.push_back(reports::cell(each->aggregate_of(metric).mean));
    for (const ExperimentResult* each : {&experiment, other}) {
      const std::optional<double> share = each->coverage.found_share();
      row.push_back(reports::cell(share ? std::optional(100 * *share) : share));
    }
  }
  return table;
}

/// The claims that the experiments measure, as they come out for each profile.
Table claims_table(const RunResult& paper, const RunResult& literal) {
  Table table = {"paper_literal_claims",
                 "The claims about Figures 4 to 6, by profile",
                 "",
                 {{"claim", "claim"},
                  {"paper", "paper"},
                  {"paper_outcome", "outcome"},
                  {"literal", "paper-literal"},
                  {"literal_outcome", "outcome"}},
                 1,
                 {}};
  const std::vector<ClaimVerdict> ours = judge(reports::claims(), figure4_measures(paper)),
                                  theirs = judge(reports::claims(), figure4_measures(literal));
  for (size_t c = 0; c < ours.size(); ++c) {
    if (ours[c].outcome == reports::ClaimOutcome::not_run) continue;
    Row& row = table.rows.emplace_back(Row{ours[c].claim.id});
    for (const ClaimVerdict* verdict : {&ours[c], &theirs[c]}) {
      row.emplace_back(measured_text(*verdict));
      row.emplace_back(std::string(to_string(verdict->outcome)));
    }
  }
  return table;
}

}  // namespace

reports::StudyResult run_paper_literal(const StudyContext& context) {
  const RunResult paper = figure4_of(context, kProfiles[0]), literal = figure4_of(context, kProfiles[1]);
  reports::StudyResult result{
      "paper_literal", "The paper's sentence on smoothing, taken literally", {errors_table(paper, literal)}, {}};
  if (!context.options.quick) result.tables.push_back(claims_table(paper, literal));
  return result;
}

}  // namespace glovebench::eval
