#include <fmt/format.h>

#include "core/base/error.h"
#include "eval/experiment.h"
#include "eval/studies/filter_reading.h"
#include "eval/studies/study.h"
#include "reports/claims/claims_report.h"
#include "reports/claims/figure4_measures.h"
#include "reports/metrics/metric.h"
#include "reports/paper_numbers.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

using reports::ClaimVerdict;
using reports::ExperimentResult;
using reports::Row;
using reports::RunResult;
using reports::Table;

constexpr std::array<std::string_view, 2> kProfiles = {"paper", "paper-literal"};

RunResult run_plan(const StudyContext& context, const Plan& plan) {
  const RunOptions how = {context.workbench.config().threads, context.store};
  return results_of(plan, measure(context.workbench, execute(context.workbench, plan.specs, how)),
                    context.workbench);
}

Plan figure4_with(const StudyContext& context, std::string_view profile_name) {
  Figure4Options options;
  options.seeds = context.options.seeds;
  options.frames = frames_of(context.options);
  return plan_figure4(profile(std::string(profile_name)), options);
}

/// Figure 4 with a profile; a quick one has a stretch of one movement.
RunResult figure4_of(const StudyContext& context, std::string_view profile_name) {
  Plan plan = figure4_with(context, profile_name);
  if (context.options.quick)
    std::erase_if(plan.specs, [](const RunSpec& spec) { return spec.trajectory->name != "Tr4"; });
  return run_plan(context, plan);
}

/// The experiments of Figures 5 and 6 with a profile.
RunResult curves_of(const StudyContext& context, std::string_view profile_name) {
  Plan plan = figure4_with(context, profile_name);
  std::erase_if(plan.specs, [](const RunSpec& spec) {
    return key_of(spec).truth != reports::TruthKind::recorded ||
           reports::paper_numbers().mean_of(spec.trajectory->name, spec.database) == nullptr;
  });
  return run_plan(context, plan);
}

Table empty_errors_table() {
  Table table = {
      "paper_literal",
      "Two readings of section III-C",
      "The paper smooths \"the posture and pose estimation by interpolating with estimations from the three "
      "previous frames\". \"paper\" filters the posture alone, \"paper-literal\" the pose, too. Mean errors of the "
      "tracked frames of Figure 4; found: of the frames in which the hand is visible. Nothing here decides an exit "
      "code.",
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
    for (const char* metric : {"position_error_mm", "posture_rms_deg", "rotation_error_deg", "found_percent"})
      for (const ExperimentResult* each : {&experiment, other})
        row.push_back(reports::cell(value_of(reports::metric_of(metric), *each)));
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
    if (!ours[c].measure || ours[c].claim.definition().withdrawn) continue;
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
  reports::StudyResult result{"paper_literal",
                              "The paper's sentence on smoothing, taken literally",
                              {errors_table(paper, literal), filter_table("paper_literal_filter", paper, literal)},
                              {}};
  if (!context.options.quick) result.tables.push_back(claims_table(paper, literal));
  return result;
}

reports::StudyResult run_filter(const StudyContext& context) {
  const RunResult paper = curves_of(context, kProfiles[0]), literal = curves_of(context, kProfiles[1]);
  return {"filter", "Which reading of the filter", {filter_table("filter", paper, literal)}, {}};
}

}  // namespace glovebench::eval
