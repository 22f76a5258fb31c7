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

constexpr std::string_view kPaper = "paper", kLiteral = "paper-literal", kRecommended = "recommended";

RunResult run_plan(const StudyContext& context, const Plan& plan) {
  return results_of(plan, run_specs(context, plan.specs), context.workbench);
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

/// A profile beside the paper's.
struct Comparison {
  std::string_view profile;
  const char *table, *title, *explanation;
  std::vector<std::string_view> metrics;
};

Table errors_table(const Comparison& comparison, const RunResult& paper, const RunResult& other) {
  Table table = {comparison.table,
                 comparison.title,
                 comparison.explanation,
                 {{"trajectory", "trajectory"},
                  {"database", "database"},
                  {"truth", "truth"},
                  {"noise", "noise"},
                  {"profile", "profile"}},
                 5,
                 {}};
  for (const std::string_view metric : comparison.metrics) {
    const std::string_view name = metric.substr(0, metric.find('_'));
    table.columns.push_back({std::string(metric), fmt::format("{} {}", name, reports::metric_of(metric).unit)});
  }
  for (const ExperimentResult& experiment : paper.experiments) {
    const ExperimentResult* same = find_experiment(other, experiment.key);
    check(same != nullptr, "both profiles run the same experiments");
    for (const auto& [profile, result] : {std::pair{kPaper, &experiment}, {comparison.profile, same}}) {
      Row& row = table.rows.emplace_back(reports::experiment_names(experiment.key));
      row.emplace_back(std::string(profile));
      for (const std::string_view metric : comparison.metrics)
        row.push_back(reports::cell(value_of(reports::metric_of(metric), *result)));
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
  const Comparison comparison = {
      kLiteral,
      "paper_literal",
      "Two readings of section III-C",
      "The paper smooths \"the posture and pose estimation by interpolating with estimations from the three "
      "previous frames\". \"paper\" filters the posture alone, \"paper-literal\" the pose, too. Mean errors of the "
      "tracked frames of Figure 4; found: of the frames in which the hand is visible. Nothing here decides an exit "
      "code.",
      {"position_error_mm", "posture_rms_deg", "rotation_error_deg", "found_percent"}};
  const RunResult paper = figure4_of(context, kPaper), literal = figure4_of(context, kLiteral);
  reports::StudyResult result{
      "paper_literal",
      "The paper's sentence on smoothing, taken literally",
      {errors_table(comparison, paper, literal), filter_table("paper_literal_filter", paper, literal)},
      {}};
  if (!context.options.quick) result.tables.push_back(claims_table(paper, literal));
  return result;
}

reports::StudyResult run_recommended(const StudyContext& context) {
  const Comparison comparison = {
      kRecommended,
      "recommended",
      "Figure 4 with the recommended settings",
      "\"paper\" is what the paper describes, \"recommended\" what its users should take. Mean errors of the "
      "tracked "
      "frames; usable: of the frames in which the hand is visible. Nothing here decides an exit code.",
      {"position_error_mm", "posture_rms_deg", "rotation_error_deg", "fingertip_error_mm", "usable_percent"}};
  const RunResult paper = figure4_of(context, kPaper), recommended = figure4_of(context, kRecommended);
  return {"recommended", "The recommended settings", {errors_table(comparison, paper, recommended)}, {}};
}

reports::StudyResult run_filter(const StudyContext& context) {
  const RunResult paper = curves_of(context, kPaper), literal = curves_of(context, kLiteral);
  return {"filter", "Which reading of the filter", {filter_table("filter", paper, literal)}, {}};
}

}  // namespace glovebench::eval
