#include <fmt/format.h>

#include <cstdio>

#include "eval/commands/flags.h"
#include "eval/reproduction.h"
#include "eval/terminal.h"
#include "reports/claims/claims_report.h"
#include "reports/paper_numbers.h"
#include "reports/summary.h"
#include "reports/tables.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

struct Reproduce {
  CommonFlags common;
  ReproductionOptions options;
  int seed_count = 1;
  bool all_gains = false;
  bool dry_run = false;
  RobotFlags robot;

  int run() {
    constexpr double kLogInterval = 25;  // s; a log needs a line at least every 30 s
    log_progress(kLogInterval);
    refuse_twice("--trajectory", options.trajectories);
    refuse_twice("--only", options.only);
    options.study.tracker = common.tracker_config();  // fails before anything is built
    if (common.output.empty()) common.output = "out";
    options.study.seeds = common.seeds(seed_count);
    if (all_gains) options.noises = {{"gradient", 1}, {"gradient", 0.5}, {"gradient", 2}, {"kinect", 1}};
    plan_reproduction(options);  // checks the names of parts, too
    if (!dry_run) common.check_report_folder();

    Workbench workbench = common.workbench();
    if (dry_run) {
      fmt::print("{}report: {}\n", describe_reproduction(workbench, options), common.output);
      return 0;
    }
    const Outcome outcome = reproduce(workbench, options, robot.output_of(workbench), common.output,
                                      [this](const reports::RunResult& so_far) { show_newest(so_far); });
    const std::vector<reports::ClaimVerdict> verdicts =
        reports::judge(reports::claims(), reports::all_measures(outcome.result));
    const bool judged = reports::are_claims_judged(outcome.result);
    if (!common.quiet) print_end(outcome, verdicts, judged);
    return exit_code_of(reports::count_required(verdicts), options, judged);
  }

  void print_end(const Outcome& outcome, const std::vector<reports::ClaimVerdict>& verdicts, bool judged) const {
    if (reports::any_was_run(verdicts)) fmt::print("{}\n", reports::claims_table(verdicts));
    if (!options.study.quick && !judged)
      fmt::print("No claim is judged: they are about the paper's configuration; this is another.\n\n");
    if (options.study.quick)
      fmt::print("{}\n", reports::wrapped(reports::quick_note(outcome.result), terminal_columns()));
    if (!outcome.result.experiments.empty()) fmt::print("Figures 4 to 6: {}/tables/figure*.csv\n", common.output);
    for (const reports::StudyResult& study : outcome.result.studies)
      fmt::print("{}: {}/summary.md\n", study.title, common.output);
    fmt::print("{:.0f} s, {} threads. Report: {}/index.html\n", outcome.timings.wall_s, outcome.timings.threads,
               common.output);
  }

  /// Shows Figure 4 first, then the newest study. If stdout has no reader, the work goes on and the summary fails.
  void show_newest(const reports::RunResult& so_far) const {
    if (common.quiet) return;
    const std::string text = so_far.studies.empty()
                                 ? figure4_text(so_far)
                                 : reports::study_text(so_far.studies.back(), terminal_columns());
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  }

  std::string figure4_text(const reports::RunResult& result) const {
    std::string text;
    if (result.experiments.empty()) return text;
    for (const reports::NoiseSetting& noise : options.noises) {
      if (all_gains) text += fmt::format("Depth noise: {} x{}\n", noise.model, noise.factor);
      text += reports::figure4_table(result, reports::paper_numbers(), noise, terminal_columns()) + "\n";
    }
    return text;
  }
};

}  // namespace

void add_reproduce(Command program) {
  const Command command = program.subcommand(
      "reproduce",
      "Run the paper's experiments, judge its claims, and write the report.\n"
      "Figures 4 to 6: five trajectories x the databases that hold their grasp, against the recorded truth, the "
      "source truth, and the source with a second subject's hand in front of the camera. Figures 7 to 9, "
      "ablations, "
      "and a tracker without depth.\n"
      "Exit code 1: a claim that is required does not hold.\n"
      "Exit code 3: one was not measured, although all of Figure 4 was asked for.");
  const auto state = std::make_shared<Reproduce>();
  state->options.study.seeds.clear();
  state->common.add_output(command, "folder of the report [out]");
  command.option("--only", state->options.only, fmt::format("parts, of {}", fmt::join(part_names(), ", ")))
      .comma_separated();
  command.option("--quick", state->options.study.quick,
                 "a few frames and queries of everything, in under a minute: shows that it runs, judges no claim");
  command.option("--dry-run", state->dry_run,
                 "print the parts, their work and about how long they take; touch nothing");
  state->common.add_tracker(command);
  state->common.add_seed(command);
  state->common.add_machine(command);
  command
      .option("--trajectory", state->options.trajectories,
              "Figure 4 with only these, e.g. Tr4, and no other parts than those of --only")
      .one_of(trajectories::ground_truth_names());
  command.option("--seeds", state->seed_count, "noise seeds an experiment, counted up from --seed").in(1, 1000);
  command
      .option("--all-noise", state->all_gains,
              "Figure 4 also with half and double noise gain, and the kinect noise model")
      .rare();
  state->robot.add(command, "folder for the robot commands of each experiment").named_file();
  command.runs([state] { return state->run(); });
}

}  // namespace glovebench::eval
