#include "reports/report.h"

#include "core/base/file_set.h"
#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/histories/histories.h"
#include "reports/json_text.h"
#include "reports/results_json.h"
#include "reports/summary.h"

namespace glovebench::reports {
namespace {

struct NamedFile {
  std::string name;
  std::string content;
};

std::vector<NamedFile> other_files(const RunResult& result) {
  const PaperNumbers& paper = paper_numbers();
  const NoiseSetting noise = headline_noise(result);
  std::vector<NamedFile> files = {{"histories/bencher.json", bencher_json(result)},
                                  {"histories/github_action_benchmark.json", github_action_benchmark_json(result)},
                                  {"tables/figure4.csv", figure4_csv(result, paper, noise)},
                                  {"tables/figure4.tex", figure4_latex(result, paper, noise)}};
  const auto add_curve = [&](const std::string& name, const PaperCurve& curve) {
    const ExperimentKey key = {curve.trajectory, curve.database, TruthKind::recorded, 1, noise};
    if (const ExperimentResult* experiment = find_experiment(result, key))
      files.push_back({name, curve_csv(*experiment, curve)});
  };
  add_curve("tables/figure5.csv", paper.figure_5);
  add_curve("tables/figure6.csv", paper.figure_6);
  for (const ExperimentResult& experiment : result.experiments)
    files.push_back({"tables/frames_" + to_string(experiment.key) + ".csv", frames_csv(experiment)});
  if (has_commands(result)) files.push_back({"tables/commands.csv", commands_csv(result)});
  for (const StudyResult& study : result.studies)
    for (const Table& table : study.tables) files.push_back({"tables/" + table.name + ".csv", to_csv(table)});
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  if (any_was_run(verdicts)) {
    files.push_back({"claims.json", claims_json(verdicts)});
    files.push_back({"tables/claims.csv", claims_csv(verdicts)});
  }
  return files;
}

/// Names that only some reports have.
bool is_of_some_reports(const std::string& name) {
  return name.starts_with("tables/") || name.starts_with("histories/") || name.starts_with("estimates/") ||
         name == "claims.json";
}

}  // namespace

std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material,
                                      const std::vector<ExperimentEstimates>& estimates) {
  const PaperNumbers& paper = paper_numbers();
  WholeFiles files(folder);
  for (const auto& [name, entry] : Manifest(files.manifest()))
    if (is_of_some_reports(name)) files.remove(name);
  files.add("config.json", format_json(result.configuration));
  files.add("summary.md", summary_markdown(result, paper));
  files.add("index.html", html_page(result, paper, timings, material));
  files.add("timings.json", timings_json(timings, result.studies));
  for (const NamedFile& table : other_files(result)) files.add(table.name, table.content);
  for (const ExperimentEstimates& experiment : estimates)
    files.add(estimates_file(experiment.key), estimates_csv(experiment));
  files.add("results.json", results_json(result));
  files.commit();
  return files.names();
}

}  // namespace glovebench::reports
