#include <fmt/format.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/registry.h"
#include "eval/commands/flags.h"
#include "eval/frame_formats/frame_format.h"
#include "eval/reproduction.h"
#include "eval/run_warnings.h"
#include "eval/settings_run.h"
#include "eval/streaming.h"
#include "eval/suite.h"
#include "eval/terminal.h"
#include "reports/comparison/comparison_report.h"
#include "reports/report.h"
#include "reports/summary.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

struct RunCommand {
  explicit RunCommand(Command own_command) : command(own_command) {}

  const Command command;
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  CommonFlags common;
  TrackerChoices choices;
  std::string study_name;
  std::string suite_name;
  std::string filter;
  bool quick = false;
  bool mcap = false;
  bool list = false;
  bool dry_run = false;
  std::vector<std::string> trajectories;
  std::vector<std::string> databases;
  std::string truth = "source";
  std::string noise = "gradient";
  double gain = 1;
  int subject = 1;
  std::string appearance = "glove";
  int seed_count = 1;
  bool streaming = false;
  double tracker_ms = 0;
  RobotFlags robot;

  void run() {
    choices.choose(common);
    if (!study_name.empty()) return run_study();
    const Suite suite = chosen_suite();
    common.left = side_of(suite) == Side::left;
    Workbench workbench = common.workbench();
    Plan plan = plan_suite(workbench, common.tracker_config(), suite, filter);
    if (streaming) plan.streaming = {command.given("--tracker-ms") ? std::optional(tracker_ms) : std::nullopt};
    warn(unit_warnings(plan));
    const std::vector<NamedTracker> settings =
        choices.are_several() ? choices.trackers(common) : std::vector<NamedTracker>{};
    if (list) return print_list(plan, settings);
    if (dry_run) return print_dry_run(workbench, plan, settings);
    require_output();
    settings.empty() ? run_plan(workbench, plan) : compare_settings(workbench, plan, settings);
  }

  static void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) say("glovebench: warning: {}\n", warning);
  }

  void run_plan(Workbench& workbench, const Plan& plan) {
    common.check_report_folder();
    const auto [result, timings] = carry_out(workbench, plan, robot.output_of(workbench), common.output);
    if (mcap) write_run_mcaps(workbench, plan.specs, common.output);
    warn(lost_hand_warnings(plan, result, common.output));
    if (common.quiet) return;
    if (!find_table(result.studies, "families"))
      fmt::print("{}\n", reports::headline_text(result, terminal_columns()));
    for (const reports::StudyResult& study : result.studies)
      fmt::print("{}", study_text(study, terminal_columns()));
    fmt::print("All metrics, with intervals: {}/summary.md\n", common.output);
    print_end(timings);
  }

  /// Writes a report of each setting into a folder of its own, and the table of all beside them.
  void compare_settings(Workbench& workbench, const Plan& plan, const std::vector<NamedTracker>& settings) {
    if (!robot.output.empty()) throw Error("--robot-out", "settings", "several", "one");
    common.check_output_folder();
    reports::require_own_folder(common.output, {"table.md", "index.html"});
    const RobotOutput robot_output = robot.output_of(workbench);
    std::vector<TrackerConfig> trackers;
    for (const NamedTracker& setting : settings) trackers.push_back(setting.tracker);
    RunStore store(common.output);
    const auto runs = run_settings(workbench, plan, trackers, {workbench.config().threads, &store});
    std::vector<std::string> folders;
    std::vector<std::pair<std::string, reports::StudyResult>> streamed;
    for (size_t s = 0; s < settings.size(); ++s) {
      folders.push_back(fmt::format("{}/{}", common.output, settings[s].name));
      constexpr int kOneJob = 1;  // each frame was timed alone, but not its commands
      const Plan planned = with_tracker(plan, trackers[s]);
      const Outcome outcome =
          report_runs(workbench, planned, runs[s], {kOneJob, start, false}, robot_output, folders.back());
      if (mcap) write_run_mcaps(workbench, planned.specs, folders.back());
      warn(lost_hand_warnings(planned, outcome.result, folders.back()));
      for (const reports::StudyResult& study : outcome.result.studies)
        if (study.name == kStreamingStudy) streamed.emplace_back(settings[s].name, study);
    }
    const reports::SettingsTable table = settings_table(folders);
    std::vector<reports::StudyResult> studies;
    if (!streamed.empty()) studies.push_back(joined_streaming(streamed));
    write_settings_table(common.output, table, studies);
    store.finish();
    if (common.quiet) return;
    for (const reports::StudyResult& study : studies) fmt::print("{}", study_text(study, terminal_columns()));
    fmt::print("{}\nOf each setting: {}/NAME/summary.md. Again: glovebench table {}\nReport: {}/index.html\n",
               settings_text(table, terminal_columns()), common.output, fmt::join(folders, " "), common.output);
  }

  /// Runs one part of the reproduction. A cascade on the command line replaces the four of Figure 8.
  void run_study() {
    for (const char* flag : {"--suite", "--filter", "--list", "--dry-run", "--trajectory", "--database", "--truth",
                             "--noise", "--gain", "--subject", "--appearance", "--hand", "--mcap", "--streaming"})
      if (command.given(flag)) throw Error(fmt::format("run {}: {} does not go with a study", study_name, flag));
    const Study& chosen = study(study_name);
    for (const char* flag : {"--profile", "--config", "--method", "--cascade"})
      if (chosen.own_settings && command.given(flag))
        throw Error(
            fmt::format("run {}: {} does not go with this study, which has its own settings", study_name, flag));
    if (choices.are_several() && choices.cascades.size() < 2)
      throw Error(study_name, "flags", "several settings", "several --cascade alone");
    StudyOptions options{common.tracker_config(), {}, quick, {}};
    for (const std::string& cascade : choices.cascades) options.cascades.push_back(parse_cascade(cascade));
    options.seeds = common.seeds(seed_count);
    Workbench workbench = common.workbench();
    if (common.output.empty()) return print_study(chosen.run({workbench, options}));
    common.check_report_folder();
    const Outcome outcome =
        reproduce(workbench, {options, {}, {{}}, {study_name}}, robot.output_of(workbench), common.output);
    if (common.quiet) return;
    print_study(outcome.result.studies.front());
    print_end(outcome.timings);
  }
  void print_end(const reports::Timings& timings) const {
    fmt::print("{:.1f} s, {} threads. Report: {}/index.html\n", timings.wall_s, timings.threads, common.output);
  }
  void print_study(const reports::StudyResult& result) const {
    if (quick) fmt::print("A quick run: nothing can be concluded from its numbers.\n\n");
    fmt::print("{}", reports::study_text(result, terminal_columns()));
  }

  /// The suite by name, or an unnamed suite from the flags.
  Suite chosen_suite() const {
    require_one_choice();
    Suite suite = suite_name.empty() ? suite_of_flags() : load_suite(suite_name);
    const bool keeps_its_seeds = !suite_name.empty() && !command.given("--seed") && !command.given("--seeds");
    if (keeps_its_seeds) return suite;
    const bool has_count = suite_name.empty() || command.given("--seeds");
    suite.seeds = common.seeds(has_count ? seed_count : static_cast<int>(suite.seeds.size()));
    return suite;
  }

  /// A shell's `gen/*.json` names the manifest that `generate` wrote beside the movements.
  static std::vector<std::string> without_manifests(const std::vector<std::string>& names) {
    std::vector<std::string> movements;
    for (const std::string& name : names)
      if (std::filesystem::path(name).filename() != kManifest) movements.push_back(name);
    return movements.empty() ? names : movements;
  }

  Suite suite_of_flags() const {
    Suite suite;
    for (const std::string& trajectory : without_manifests(trajectories)) {
      SuiteEntry entry{trajectory,    {}, databases, subject, from_name<Appearance>(appearance).value(),
                       {noise, gain}, {}};
      if (!trajectories::is_trajectory_file(trajectory)) entry.truth = from_name<reports::TruthKind>(truth);
      suite.entries.push_back(entry);
    }
    return suite;
  }

  void require_one_choice() const {
    if (suite_name.empty() && !(command.given("--trajectory") && command.given("--database")))
      throw Error("run", "experiments", "none", "--suite, or --trajectory and --database");
    for (const char* flag :
         {"--trajectory", "--database", "--truth", "--noise", "--gain", "--subject", "--appearance"})
      if (!suite_name.empty() && command.given(flag))
        throw Error(fmt::format("run: {} does not go with --suite, whose file says it", flag));
  }

  void require_output() const {
    if (common.output.empty()) throw Error("--output", "folder", "nothing", "a folder for the report");
  }

  static void print_list(const Plan& plan, const std::vector<NamedTracker>& settings) {
    fmt::print("{}", list_experiments(plan));
    for (const NamedTracker& setting : settings) fmt::print("each with setting {}\n", setting.name);
  }

  void print_dry_run(Workbench& workbench, const Plan& plan, const std::vector<NamedTracker>& settings) const {
    fmt::print("{}", describe_plan(workbench, plan));
    for (const NamedTracker& setting : settings) fmt::print("each with setting {}\n", setting.name);
    fmt::print("report: {}\n", common.output.empty() ? "nowhere without --output" : common.output);
  }
};

}  // namespace

void add_run(Command program) {
  const Command command = program.subcommand(
      "run",
      "Replay a suite, or trajectories, also your own, through the tracker and report the errors.\n"
      "If --cascade, --config, --method or --profile is repeated, a table compares its values with the paper's "
      "settings.");
  const auto state = std::make_shared<RunCommand>(command);
  state->common.add_output(command, "folder of the report");
  command.option(
      "--mcap", state->mcap,
      "also write EXPERIMENT.mcap: frames, truth and estimates of the first seed, for Foxglove or Rerun");
  command.option("--streaming", state->streaming,
                 "also measure the answers that a live system uses: late ones, and none to "
                 "frames that arrive while the tracker computes");
  command
      .option("--tracker-ms", state->tracker_ms,
              "with --streaming: time of each frame [measured, one job at a time]")
      .in(0, 1e6)
      .needs("--streaming");
  command.option("--list", state->list, "print the experiments and stop");
  command.option("--dry-run", state->dry_run, "print what would be done and touch nothing");
  const Command experiments = command.group("Experiments");
  experiments.option("study", state->study_name,
                     "instead: a study of the paper, e.g. fig8 (`glovebench list studies`)");
  experiments.option("--quick", state->quick, "of a study: a few frames and queries").needs("study");
  experiments.option("--suite", state->suite_name,
                     "experiments that belong together: a name (`glovebench list suites`) or a file (*.json)");
  experiments.option("--filter", state->filter,
                     "only experiments with such a name, e.g. 'Tr4_*' (shell wildcards)");
  experiments.option("--trajectory", state->trajectories,
                     "names (`glovebench list trajectories`; side_3: of `list families`) or files (*.json)");
  experiments.option("--database", state->databases,
                     "to track against: names (`glovebench list databases`) or files (*.glovedb, *.csv, *.json)");
  experiments.option("--truth", state->truth, "which truth of a named one").one_of({"source", "recorded"});
  const Command camera = command.group("Camera and hand");
  camera.option("--noise", state->noise, "depth noise").one_of(names_in(render::depth_noises()));
  camera.option("--gain", state->gain, "factor on the noise's gain").in(0, 100);
  camera.option("--subject", state->subject, "whose hand is in front of the camera (`glovebench list subjects`)")
      .in(1, render::kSubjectCount);
  camera.option("--appearance", state->appearance, "what the hand wears: the glove, or nothing")
      .one_of(all_names<Appearance>());
  state->common.add_seed(camera);
  camera
      .option("--seeds", state->seed_count,
              "noise seeds an experiment, counted up from --seed [a suite: its own seeds]")
      .in(1, 1000);
  state->common.add_cameras(camera);
  state->robot.add(command, "folder for the robot commands of each experiment").named_file();
  state->common.add_hand(command);
  state->choices.add(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
