#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "eval/commands/flags.h"
#include "eval/experiment.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "eval/suite.h"
#include "reports/comparison/comparison.h"
#include "reports/table.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

/// No suite's seed, since a noise floor must not be measured on the seeds that it judges.
constexpr uint64_t kFirstSeed = 1001;

struct CalibrateNoise {
  CommonFlags common;
  std::vector<std::string> suites;
  std::vector<std::string> runs;
  int seed_count = 16;

  void run() {
    if (suites.empty() && runs.empty()) throw Error("calibrate noise", "--suite, --run", "neither", "one of them");
    common.check_output_folder();
    std::vector<reports::NoiseFloor> floors;
    for (const std::string& run : runs) floors.push_back(measure_run(load_finished_run(run).results));
    if (runs.empty())
      for (const std::string& suite : suites) floors.push_back(measure_suite(load_suite(suite)));
    for (const reports::NoiseFloor& floor : floors) {
      const std::string path = path_within(common.output, floor.suite + "/noise_floor.json");
      write_file(path, reports::noise_floor_json(floor));
      if (common.quiet) continue;
      fmt::print("{}: {} seeds, for results of {} seeds\n", path, floor.seeds, floor.seeds_per_result);
    }
    if (common.quiet) return;
    for (const reports::NoiseFloor& floor : floors)
      fmt::print("\n{}", reports::to_markdown(smallest_changes(floor)));
    fmt::print(
        "\nThe smallest change that the gate stops: on the baseline's own noise seeds, and, with 90% power, on "
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
    const std::vector<MeasuredRun> runs =
        eval::measure(workbench, execute(workbench, plan.specs, {workbench.config().threads}));
    return measure(results_of(plan, runs, workbench), suite);
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

  /// One row per metric: the mean over all experiments, and the least sensitive experiment.
  static reports::Table smallest_changes(const reports::NoiseFloor& floor) {
    reports::Table table = reports::table_of({"suite " + floor.suite, "all, same seeds", "all, other seeds",
                                              "worst experiment, same seeds", "worst experiment, other seeds"});
    for (const reports::Metric& metric : reports::gated_metrics()) {
      std::optional<double> all_effect, all_detectable, effect, detectable;
      for (const reports::NoiseFloorEntry& entry : floor.entries) {
        if (entry.quantity != metric.key) continue;
        const bool is_all = entry.experiment == reports::kAllExperiments;
        raise(is_all ? all_effect : effect, entry.minimum_effect);
        raise(is_all ? all_detectable : detectable, entry.detectable);
      }
      table.rows.push_back({std::string(metric.key), reports::fixed(all_effect, 3),
                            reports::fixed(all_detectable, 3), reports::fixed(effect, 3),
                            reports::fixed(detectable, 3)});
    }
    return table;
  }

  static void raise(std::optional<double>& largest, double value) {
    largest = std::max(largest.value_or(0), value);
  }
};

}  // namespace

void add_calibrate_noise(Command calibrate) {
  const Command command = calibrate.subcommand(
      "noise",
      "Measure what other noise seeds do to the results of a suite, and propose the smallest effect that counts.\n"
      "The gate and compare take it from the baseline's folder.");
  const auto state = std::make_shared<CalibrateNoise>();
  command.option(
      "--suite", state->suites,
      "to run with many seeds: quick, full, or a file; with --run only what the file of an own suite is");
  command.option("--run", state->runs, "instead: folder of a run of a suite with many seeds (run --suite --seeds)");
  command.option("--seeds", state->seed_count, "noise seeds to measure, four times those of the suite or more")
      .in(4, 1000);
  state->common.add_output(command, "folder of the baselines: writes SUITE/noise_floor.json in it").required();
  state->common.add_tracker(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
