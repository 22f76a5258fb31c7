#include "eval/score.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/registry.h"
#include "core/base/text.h"
#include "eval/commands/flags.h"
#include "eval/experiment.h"
#include "eval/program.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"
#include "render/label_renderer.h"
#include "reports/summary.h"
#include "trajectories/capture/import_capture.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

struct ScoreCommand {
  explicit ScoreCommand(Command own_command) : command(own_command) {}

  const Command command;
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  CommonFlags common;
  ScoreRequest request;
  std::string truth, truth_kind = "source", name, joints, time_offset;
  double tolerance_ms = 0;
  int subject = 1;
  reports::NoiseSetting noise;
  RobotFlags robot;
  std::string source, database = "DB_20_postures", colors, layout;

  void run() {
    if (source.empty() == request.estimates.empty())
      throw Error("score", "estimates", source.empty() ? "none" : "--estimates and --source", "one of these flags");
    common.check_report_folder();
    if (!source.empty()) return score_recording();
    for (const char* flag : {"--config", "--cascade", "--method", "--profile"})
      if (command.given(flag)) throw Error(fmt::format("score: {} goes with --source", flag));
    complete_request();
    Workbench workbench = common.workbench();
    report(workbench, score(workbench, request), request.estimates);
  }

  void report(Workbench& workbench, const Score& scored, const std::string& estimates) {
    for (const auto& warning : scored.plan.score.at("warnings"))
      say("glovebench: warning: {}: {}\n", estimates, warning.get<std::string>());
    const std::vector<MeasuredRun> runs = measure(workbench, scored.runs);
    const Outcome outcome = report_runs(workbench, scored.plan, runs, {workbench.config().threads, start, false},
                                        robot.output_of(workbench), common.output);
    if (common.quiet) return;
    fmt::print("{}\n", reports::headline_text(outcome.result, terminal_columns()));
    print_joint_errors(outcome.result);
    for (const std::string& match : scored.matches) fmt::print("{}\n", match);
    fmt::print("All metrics, with intervals: {0}/summary.md\nReport: {0}/index.html\n", common.output);
  }

  /// Tracks a recording and scores it against a capture of the same hand.
  void score_recording() {
    for (const char* flag : {"--format", "--beside", "--joints", "--units", "--frame", "--time-unit", "--tolerance",
                             "--time-offset", "--subject", "--noise", "--gain"})
      if (command.given(flag)) throw Error(fmt::format("score: {} does not go with --source", flag));
    const auto capture = std::make_shared<const trajectories::Trajectory>(load_capture());
    common.left = capture->side == Side::left;
    const SourceFlags from = {.source = source, .calibration = common.calibration, .topics = ""};
    TrackSource recording = open_source(from, common.quiet);
    if (recording.frame_count == 0) throw Error("--source", "kind", source, "a recording, not a camera");
    common.calibration_json = to_json(recording.device->calibration());
    Workbench workbench = common.workbench();
    const std::string name_of_database = workbench.add_database(database);
    const TrackerConfig config = common.tracker_config();
    const std::unique_ptr<Method> method = make_method(
        {config, recording.device->calibration(), workbench.model(), workbench.database(name_of_database),
         colors.empty() ? workbench.color_table(config.segmentation.color_space)
                        : std::make_shared<const ColorTable>(ColorTable::load(colors)),
         render::label_renderer_factory()});
    CaptureRequest asked;
    asked.spec.trajectory = capture;
    asked.spec.seed = common.seed;
    asked.spec.database = name.empty() ? name_of_database : checked_name(name, "--name", "name");
    asked.spec.tracker = config;
    asked.answers = track_recording(recording, *method, common.quiet);
    asked.recording = source;
    report(workbench, score_against_capture(workbench, asked), source);
  }

  /// Markers, or a movement that was made of them; in the capture's frame.
  trajectories::Trajectory load_capture() const {
    using trajectories::Format;
    const bool is_movement = trajectories::is_trajectory_file(truth);
    const Format* format = is_movement ? nullptr : format_of_file(truth, &Format::markers);
    if (!format) return load_truth(truth, from_name<reports::TruthKind>(truth_kind));
    const Side side = common.left ? Side::left : Side::right;
    const trajectories::HandFit fit = trajectories::import_capture(
        {truth}, *format, side, trajectories::load_marker_layout(layout), HandModel::load(hand_mesh_path()));
    const std::string stem = std::filesystem::path(truth).stem().string();
    return trajectory_of(fit, {side, Eigen::Isometry3d::Identity()}, checked_name(stem, "--truth", "file name"), 1);
  }

  void complete_request() {
    const bool is_file = trajectories::is_trajectory_file(truth);
    const auto kind =
        is_file && !command.given("--truth-kind") ? std::nullopt : from_name<reports::TruthKind>(truth_kind);
    const auto movement = std::make_shared<const trajectories::Trajectory>(load_truth(truth, kind));
    common.warn_of_units(*movement);
    common.left = movement->side == Side::left;
    if (name.empty()) name = std::filesystem::path(request.estimates).stem().string();
    request.spec = {.trajectory = movement,
                    .subject = subject,
                    .noise = noise,
                    .seed = common.seed,
                    .database = checked_name(name, "--name", "name of the estimates"),
                    .tracker = common.tracker_config()};
    if (!joints.empty()) request.flags.order = load_joint_order(joints);
    if (command.given("--tolerance")) request.tolerance_ms = tolerance_ms;
    request.estimates_offset = time_offset == "estimate";
    if (request.estimates_offset || time_offset.empty()) return;
    const std::optional<double> offset = number_in<double>(time_offset);
    constexpr double kLongest_ms = 1e13;
    if (!offset || !(std::abs(*offset) <= kLongest_ms))
      throw Error("--time-offset", "value", quoted_excerpt(time_offset), "milliseconds, or estimate");
    request.offset_ms = *offset;
  }

  /// Prints joint errors if the estimates lack what the headline needs.
  static void print_joint_errors(const reports::RunResult& result) {
    const reports::ExperimentResult& experiment = result.experiments.front();
    if (experiment.aggregate_of("vertex_error_mm").mean) return;
    std::vector<std::string> errors;
    for (const char* key : {"joint_error_mm", "mpjpe_root_mm", "mpjpe_scaled_mm", "mpjpe_procrustes_mm"}) {
      const reports::Metric& metric = reports::metric_of(key);
      if (const auto mean = value_of(metric, experiment))
        errors.push_back(fmt::format("{} {:.2f}", metric.heading, *mean));
    }
    if (!errors.empty()) fmt::print("{}.\n", fmt::join(errors, ", "));
  }
};

std::string names_of_orders() {
  std::vector<std::string> names = names_in(joint_orders());
  return fmt::format("{}, or a map (*.json)", fmt::join(names, ", "));
}

std::string formats_text() {
  std::string text;
  for (const EstimateFormat& format : estimate_formats())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", format.name, format.description);
  return text;
}

}  // namespace

void add_score(Command program) {
  const Command command = program.subcommand(
      "score",
      "Measure the estimates of any program against a truth and report the errors.\n"
      "Metrics that need what the estimates lack are empty.\n"
      "With --source: track a recording and measure it against motion capture of the same hand.");
  const auto state = std::make_shared<ScoreCommand>(command);
  state->common.add_output(command, "folder of the report").required();
  command
      .option(
          "--truth", state->truth,
          "Tr1..Tr5, side_3 (`glovebench list families`) or a file (*.json); with --source also markers (*.trc, "
          "*.csv, *.bvh)")
      .required();
  command.option("--truth-kind", state->truth_kind, "which truth of Tr1..Tr5").one_of({"source", "recorded"});
  command.option("--estimates", state->request.estimates, "file").existing_file();
  command.option("--name", state->name, "of the program, in tables [the file's]");
  const Command recording = command.group("A recording against motion capture");
  recording.option("--source", state->source,
                   "instead of --estimates: a recording to track, as of `track --source`; time offset and rigid "
                   "transform to the truth are estimated");
  recording.option("--database", state->database, "to track against: name (`glovebench list databases`) or file")
      .needs("--source");
  recording.option("--colors", state->colors, "color table (`glovebench calibrate colors`)").needs("--source");
  recording.option("--layout", state->layout, "JSON file that says where markers of other names sit")
      .needs("--source");
  recording.option("--left", state->common.left, "a left hand, of markers").needs("--source");
  state->common.add_tracker(recording);
  const Command file = command.group("What the file does not say");
  file.option("--format", state->request.format, formats_text() + " [by ending and first line]")
      .one_of(names_in(estimate_formats()));
  file.option("--beside", state->request.beside, "file with the angles or joints of the same poses")
      .existing_file();
  file.option("--joints", state->joints, "their order: " + names_of_orders());
  file.option("--units", state->request.flags.units, "of positions; none: without scale")
      .one_of({"m", "cm", "mm", "none"});
  file.option("--frame", state->request.flags.frame,
              "of joints: camera, or wrist for joints relative to each other along the camera's axes")
      .one_of({"camera", "wrist"});
  file.option("--time-unit", state->request.flags.time, "of time stamps").one_of({"s", "ms", "us"});
  const Command times = command.group("Times");
  times
      .option("--tolerance", state->tolerance_ms,
              "ms between an estimate and its frame, at most [half the time between frames]")
      .in(0, 1e6);
  times.option("--time-offset", state->time_offset, "ms to add to the estimates' times, or estimate");
  const Command camera = command.group("What the program saw");
  camera.option("--subject", state->subject, "whose hand (`glovebench list subjects`)")
      .in(1, render::kSubjectCount);
  camera.option("--noise", state->noise.model, "depth noise").one_of(names_in(render::depth_noises()));
  camera.option("--gain", state->noise.factor, "factor on the noise's gain").in(0, 100);
  state->common.add_seed(camera);
  state->common.add_cameras(camera);
  state->robot.add(command, "folder for the robot commands").named_file();
  state->common.add_hand(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
