// Writes the reports of an invented run and an invented comparison, to test the schemas and look at the pages:
// reports_example FOLDER
// Or measures invented frames, to compute the metrics again elsewhere: reports_example --measured FILE

#include <cstdio>
#include <exception>

#include "ci/build_paths.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "reports/claims/claims_report.h"
#include "reports/comparison/example_comparison.h"
#include "reports/comparison/example_runs.h"
#include "reports/comparison/settings_table.h"
#include "reports/example_result.h"
#include "reports/metrics/example_measured.h"
#include "reports/page/example_material.h"
#include "reports/report.h"

namespace {

std::vector<std::string> page_scripts() {
  std::vector<std::string> scripts;
  for (const std::string name : {"vega", "vega-lite", "vega-embed"})
    scripts.push_back(glovebench::read_file(glovebench::build_paths::share("page/" + name + ".min.js")));
  return scripts;
}

glovebench::reports::Timings example_timings() {
  glovebench::reports::Timings timings;
  timings.host = "example";
  timings.processor = "an invented processor";
  timings.compiler = "none";
  timings.build_type = "Release";
  timings.commit = "0123456789";
  timings.date = "2026-01-01T00:00:00Z";
  return timings;
}

glovebench::reports::SettingsTable example_settings() {
  using namespace glovebench::reports;
  const auto setting = [](const char* name, double shift_mm, double time_ms) {
    return SettingRun{example_named(name, {noisy_experiment("Tr4", {1, 2}, 96, "a", shift_mm)}), time_ms};
  };
  return compare_settings({setting("paper", 0, 6), setting("recommended", -1, 25), setting("exact-3", -0.1, 7)},
                          {.metrics = headline_metrics()});
}

}  // namespace

int main(int argc, char** argv) {
  const bool measures = argc == 3 && std::string_view(argv[1]) == "--measured";
  if (argc != 2 && !measures) {
    std::fprintf(stderr, "usage: %s FOLDER | --measured FILE\n", argv[0]);
    return 2;
  }
  try {
    using namespace glovebench::reports;
    if (measures) {
      const auto hand = glovebench::HandModel::load(glovebench::build_paths::hand_mesh());
      glovebench::write_file(argv[2], example_measured_json(hand).dump());
      return 0;
    }
    RunResult result = full_result();
    result.studies.push_back(example_figure9());
    result.studies.push_back(example_ablations());
    write_report(argv[1], result, example_timings(), example_material(result, page_scripts()));
    write_report(std::string(argv[1]) + "/small", small_result(), {});
    RunResult own = small_result();
    own.experiments.front().key.trajectory = "wave";
    write_report(std::string(argv[1]) + "/own", own, {}, {page_scripts(), {}, example_pictures(own)});
    const std::string comparison = std::string(argv[1]) + "/comparison";
    ComparisonReport report = full_comparison();
    report.scripts = page_scripts();
    write_comparison(comparison, report);
    write_comparison(comparison + "/small", small_comparison());
    glovebench::write_file(comparison + "/incomparable.xml", incomparable_junit("a.json: seeds: found <1>\n\x01"));
    glovebench::write_file(std::string(argv[1]) + "/settings.html",
                           settings_html(example_settings(), page_scripts()));
    std::fputs(figure4_table(result, paper_numbers(), {}).c_str(), stdout);
    std::fputs(claims_table(judge(claims(), all_measures(result))).c_str(), stdout);
    std::fputs(comparison_table(report, false).c_str(), stdout);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
