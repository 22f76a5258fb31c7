#include "reports/report.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>

#include "core/base/file.h"
#include "reports/histories/histories.h"
#include "reports/json_text.h"
#include "reports/latex.h"
#include "reports/results_json.h"
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
  return files;
}

constexpr std::array<const char*, 4> kFolders = {"", "tables/", "histories/", "estimates/"};

/// What nobody but write_report calls a file in a run's folder, and what only some reports have.
bool is_of_some_reports(const std::string& name) {
  static const std::string experiment = R"([^/]+_(recorded|source)_subject[0-9]+_[a-z]+_[0-9.e+-]+\.csv)";
  static const std::regex pattern("tables/figure[56]\\.csv|(tables/frames_|estimates/)" + experiment);
  return std::regex_match(name, pattern);
}
bool is_of_a_report(const std::string& name) {
  static const std::regex always(R"((results|config|timings|histories/(bencher|github_action_benchmark))\.json|)"
                                 R"(summary\.md|index\.html|tables/figure4\.(csv|tex))");
  return is_of_some_reports(name) || std::regex_match(name, always);
}

/// Tables and estimates of experiments that an older report had.
void remove_stale_files(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<fs::path> stale;
  std::error_code ignored;  // a file that stays is no reason to lose the report
  for (const std::string part : kFolders) {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(folder) / part, ignored)) {
      const std::string name = part + entry.path().filename().string();
      if (is_of_some_reports(name) && std::ranges::find(names, name) == names.end()) stale.push_back(entry.path());
    }
  }
  for (const fs::path& path : stale) fs::remove(path, ignored);
}

}  // namespace

std::vector<std::string> write_report(const std::string& folder, const RunResult& result, const Timings& timings,
                                      const std::vector<Picture>& pictures,
                                      const std::vector<ExperimentEstimates>& estimates) {
  for (const std::string part : kFolders)
    remove_leftovers(folder + "/" + part, [&](const std::string& name) { return is_of_a_report(part + name); });
  const PaperNumbers& paper = paper_numbers();
  WholeFiles files(folder);
  files.add("config.json", format_json(result.configuration));
  files.add("summary.md", summary_markdown(result, paper));
  files.add("index.html", html_page(result, paper, pictures));
  files.add("timings.json", timings_json(timings));
  for (const NamedFile& table : other_files(result)) files.add(table.name, table.content);
  for (const ExperimentEstimates& experiment : estimates)
    files.add(estimates_file(experiment.key), estimates_csv(experiment));
  files.add("results.json", results_json(result));
  // results.json, whose numbers are compared, is the last; what it has no experiments for goes before it comes.
  remove_stale_files(folder, files.names());
  files.commit();
  return files.names();
}

}  // namespace glovebench::reports
