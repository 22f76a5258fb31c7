#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/file.h"
#include "eval/commands/command.h"
#include "eval/program_info.h"
#include "eval/regression/baseline.h"
#include "eval/suite.h"
#include "reports/comparison/comparison.h"
#include "reports/summary.h"

namespace glovebench::eval {
namespace {

/// None of the suites' own: a floor must not be measured on the seeds that it judges.
constexpr uint64_t kFirstSeed = 1001;

struct CalibrateNoise {
  CommonFlags common;
  std::vector<std::string> suites;
  std::vector<std::string> runs;
  int seed_count = 16;

  void run() {
    if (suites.empty() && runs.empty()) throw Error("calibrate noise", "--suite, --run", "neither", "one of them");
    std::vector<reports::NoiseFloor> floors;
    for (const std::string& run : runs) floors.push_back(measure_run(load_run(run)));
    if (runs.empty()) {
      for (const std::string& suite : suites) floors.push_back(measure_suite(load_suite(suite)));
    }
    for (const reports::NoiseFloor& floor : floors) {
      const std::string path = fmt::format("{}/{}/noise_floor.json", common.output, floor.suite);
      write_file(path, reports::noise_floor_json(floor));
      fmt::print("{}: {} seeds, for results of {} seeds\n", path, floor.seeds, floor.seeds_per_result);
    }
    fmt::print("\n{}", reports::to_markdown(smallest_changes(floors)));
    fmt::print(
        "\nThe smallest change that the gate calls worse: on the baseline's own noise seeds, and, with 90% power, "
        "on "
        "others.\nA change is taken to add the same to every frame.\n");
  }

  reports::NoiseFloor measure_suite(const Suite& suite) const {
    Suite many_seeds = suite;
    many_seeds.seeds.clear();
    for (int s = 0; s < seed_count; ++s) many_seeds.seeds.push_back(kFirstSeed + s);
    CommonFlags flags = common;
    flags.left = side_of(suite) == Side::left;
    Workbench workbench = flags.workbench();
    const Plan plan = plan_suite(workbench, common.tracker_config(), many_seeds, "");
    return measure(run_experiments(workbench, plan).result, suite);
  }

  reports::NoiseFloor measure_run(const reports::NamedResult& run) const {
    for (const std::string& own : suites) {
      const Suite suite = load_suite(own);
      if (suite.name == run.result.suite) return measure(run.result, suite);
    }
    return measure(run.result, suite_of(run, ""));
  }

  static reports::NoiseFloor measure(const reports::RunResult& result, const Suite& suite) {
    reports::NoiseFloor floor = reports::measure_noise_floor(result, static_cast<int>(suite.seeds.size()));
    floor.suite = suite.name;
    floor.commit = result.commit;
    floor.date = host_timings(1).date;
    return floor;
  }

  /// A row for each quantity; for each suite the mean over all its experiments, and the least sensitive of them.
  static reports::TextTable smallest_changes(const std::vector<reports::NoiseFloor>& floors) {
    reports::TextTable table;
    table.heading = {"quantity"};
    table.name_columns = 1;
    for (const reports::NoiseFloor& floor : floors) {
      for (const char* what :
           {"all, same seeds", "all, other seeds", "one experiment, same seeds", "one experiment, other seeds"})
        table.heading.push_back(fmt::format("{}: {}", floor.suite, what));
    }
    for (const reports::Quantity& quantity : reports::quantities()) {
      std::vector<std::string> row = {std::string(quantity.key)};
      for (const reports::NoiseFloor& floor : floors) add_cells(row, floor, quantity.key);
      table.rows.push_back(row);
    }
    return table;
  }

  static void add_cells(std::vector<std::string>& row, const reports::NoiseFloor& floor,
                        std::string_view quantity) {
    const reports::NoiseFloorEntry* all = floor.find(reports::kAllExperiments, quantity);
    double effect = 0, detectable = 0;
    for (const reports::NoiseFloorEntry& entry : floor.entries) {
      if (entry.quantity != quantity || &entry == all) continue;
      effect = std::max(effect, entry.minimum_effect);
      detectable = std::max(detectable, entry.detectable);
    }
    for (const double value : {all ? all->minimum_effect : 0, all ? all->detectable : 0, effect, detectable}) {
      row.push_back(fmt::format("{:.3f}", value));
    }
  }
};

}  // namespace

void add_calibrate(CLI::App& program) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Measure what results can be told apart by.");
  calibrate->require_subcommand(1);
  CLI::App* command = calibrate->add_subcommand(
      "noise",
      "Measure what other noise seeds do to the results of a suite, and propose the smallest effect that counts.\n"
      "The gate and compare take it from the baseline's folder.");
  const auto state = std::make_shared<CalibrateNoise>();
  command->add_option(
      "--suite", state->suites,
      "to run with many seeds: quick, full, or a file; with --run only what the file of an own suite is");
  command->add_option("--run", state->runs,
                      "instead: folder of a run of a suite with many seeds (run --suite --seeds)");
  command->add_option("--seeds", state->seed_count, "noise seeds to measure, four times those of the suite or more")
      ->check(CLI::Range(4, 1000))
      ->capture_default_str();
  state->common.add_output(*command, "folder of the baselines: writes SUITE/noise_floor.json in it", true);
  state->common.add_tracker(*command);
  state->common.add_machine(*command);
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
