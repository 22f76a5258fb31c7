#include "reports/report.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>

#include "core/base/error.h"
#include "core/base/file.h"
#include "reports/claims/claims_report.h"
#include "reports/command_tables.h"
#include "reports/histories/histories.h"
#include "reports/json_text.h"
#include "reports/latex.h"
#include "reports/results_json.h"
#include "reports/study_text.h"
#include "reports/summary.h"

namespace glovebench::reports {
namespace {

namespace fs = std::filesystem;

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
    for (const Table& table : study.tables) files.push_back({table_file(table), table_csv(table)});
  const std::vector<ClaimVerdict> verdicts = judge(claims(), all_measures(result));
  if (any_was_run(verdicts)) {
    files.push_back({"claims.json", claims_json(verdicts)});
    files.push_back({"tables/claims.csv", claims_csv(verdicts)});
  }
  return files;
}

constexpr std::array<const char*, 4> kFolders = {"", "tables/", "histories/", "estimates/"};

/// The names of files of studies: only a report's own results say which those are.
std::vector<std::string> study_files(const std::vector<StudyResult>& studies) {
  std::vector<std::string> names;
  for (const StudyResult& study : studies)
    for (const Table& table : study.tables) names.push_back(table_file(table));
  return names;
}
/// Of the report that is in the folder; none if there is none that can be read.
std::vector<std::string> older_study_files(const std::string& folder) {
  try {
    return study_files(read_results(folder + "/results.json").studies);
  } catch (const Error&) {
    return {};
  }
}

/// What nobody but write_report calls a file in a run's folder, and what only some reports have, beside the
/// studies'.
bool is_of_some_reports(const std::string& name) {
  static const std::string experiment = R"([^/]+_(recorded|source)_subject[0-9]+_[a-z]+_[0-9.e+-]+\.csv)";
  static const std::regex pattern(
      "claims\\.json|tables/(figure[56]|claims|commands)\\.csv|(tables/frames_|estimates/)" + experiment);
  return std::regex_match(name, pattern);
}
bool is_of_a_report(const std::string& name) {
  static const std::regex always(R"((results|config|timings|histories/(bencher|github_action_benchmark))\.json|)"
                                 R"(summary\.md|index\.html|tables/figure4\.(csv|tex))");
  return is_of_some_reports(name) || std::regex_match(name, always);
}
bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Temporary files of writes that were interrupted.
void remove_unfinished_files(const std::string& folder, const std::vector<std::string>& of_studies) {
  for (const std::string part : kFolders) {
    remove_leftovers(folder + "/" + part, [&](const std::string& name) {
      return is_of_a_report(part + name) || is_among(of_studies, part + name);
    });
  }
}

/// Tables and estimates of experiments and studies that an older report had.
void remove_stale_files(const std::string& folder, const std::vector<std::string>& of_studies,
                        const std::vector<std::string>& names) {
  std::vector<fs::path> stale;
  std::error_code ignored;  // a file that stays is no reason to lose the report
  for (const std::string part : kFolders) {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(folder) / part, ignored)) {
      const std::string name = part + entry.path().filename().string();
      const bool is_ours = is_of_some_reports(name) || is_among(of_studies, name);
      if (is_ours && !is_among(names, name)) stale.push_back(entry.path());
    }
  }
  for (const fs::path& path : stale) fs::remove(path, ignored);
}

}  // namespace

std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const PageMaterial& material,
                                      const std::vector<ExperimentEstimates>& estimates) {
  const std::vector<std::string> older = older_study_files(folder);
  std::vector<std::string> of_studies = study_files(result.studies);
  of_studies.insert(of_studies.end(), older.begin(), older.end());
  remove_unfinished_files(folder, of_studies);
  const PaperNumbers& paper = paper_numbers();
  WholeFiles files(folder);
  files.add("config.json", format_json(result.configuration));
  files.add("summary.md", summary_markdown(result, paper));
  files.add("index.html", html_page(result, paper, timings, material));
  files.add("timings.json", timings_json(timings, result.studies));
  for (const NamedFile& table : other_files(result)) files.add(table.name, table.content);
  for (const ExperimentEstimates& experiment : estimates)
    files.add(estimates_file(experiment.key), estimates_csv(experiment));
  files.add("results.json", results_json(result));
  // results.json, whose numbers are compared, is the last; what it has no experiments for goes before it comes.
  remove_stale_files(folder, of_studies, files.names());
  files.commit();
  return files.names();
}

}  // namespace glovebench::reports
