#include "eval/settings_files.h"

#include <filesystem>
#include <set>

#include "core/base/file_set.h"
#include "eval/regression/baseline.h"
#include "reports/comparison/comparison_report.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

/// Empty unless the run was measured one job at a time.
std::optional<double> frame_ms(const reports::StageTimes& times) {
  if (times.threads != 1 || times.stages.empty()) return std::nullopt;
  double ms = 0;
  for (const reports::StageTimes::Stage& stage : times.stages) ms += stage.median_ms;
  return ms;
}

/// The last part of a path that may end with a slash.
std::string folder_name(const std::string& path) {
  const std::filesystem::path absolute = std::filesystem::absolute(path).lexically_normal();
  return (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
}

}  // namespace

reports::SettingsTable settings_table(const std::vector<std::string>& folders, reports::PairingOptions pairing,
                                      const reports::CompareConfig& config) {
  if (pairing.metrics.empty()) pairing.metrics = reports::headline_metrics();
  std::vector<reports::SettingRun> runs;
  std::set<std::string> processors;
  for (const std::string& folder : folders) {
    FinishedRun run = load_finished_run(folder);
    const reports::StageTimes times = load_stage_times(run.files);
    processors.insert(times.processor);
    run.results.name = folder_name(run.files.folder());
    runs.push_back({std::move(run.results), frame_ms(times)});
  }
  if (processors.size() > 1)  // times of different machines say nothing of the settings
    for (reports::SettingRun& run : runs) run.time_ms.reset();
  return reports::compare_settings(runs, pairing, config);
}

void write_settings_table(const std::string& folder, const reports::SettingsTable& table,
                          const std::vector<reports::StudyResult>& studies) {
  reports::require_own_folder(folder);
  WholeFiles files(folder);
  files.add("table.md", settings_markdown(table));
  files.add("table.csv", settings_csv(table));
  files.add("table.tex", settings_latex(table));
  files.add("index.html", settings_html(table));
  for (const reports::StudyResult& study : studies) {
    files.add(study.name + ".md", study_markdown(study));
    for (const reports::Table& each : study.tables) files.add(each.name + ".csv", to_csv(each));
  }
  files.commit();
}

}  // namespace glovebench::eval
