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
  const std::string run = run_name(result);
  std::vector<NamedFile> files = {{"histories/bencher.json", bencher_json(result)},
                                  {"histories/github_action_benchmark.json", github_action_benchmark_json(result)}};
  if (is_figure4(result))
    files.push_back({"tables/figure4.tex", figure4_latex(result, paper, headline_noise(result))});
  else if (!result.experiments.empty())
    files.push_back({"tables/errors.tex", errors_latex(result)});
  const auto tables = csv_tables(result, paper);
  for (const auto& [name, csv] : tables.items()) files.push_back({"tables/" + name + ".csv", csv});
  for (const ExperimentResult& experiment : result.experiments)
    files.push_back({"tables/frames_" + to_string(experiment.key) + ".csv", frames_csv(run, experiment)});
  if (has_commands(result)) files.push_back({"tables/commands.csv", commands_csv(result)});
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  if (any_was_run(verdicts)) {
    files.push_back({"claims.json", claims_json(verdicts)});
    files.push_back({"tables/claims.csv", claims_csv(run, verdicts)});
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
