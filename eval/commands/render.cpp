#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/registry.h"
#include "eval/commands/flags.h"
#include "eval/frame_formats/frame_format.h"
#include "eval/program.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

using trajectories::Trajectory;

struct Render {
  CommonFlags common;
  std::string trajectory;
  std::string truth = "source";
  std::string format = "png";
  std::string noise = "gradient";
  std::string database;
  int subject = 1;
  std::string appearance = "glove";

  void run() {
    const FrameFormat& chosen = find_frame_format(format);
    if (!database.empty() && !chosen.has_estimates)
      throw Error("--database", "--format", format, estimate_formats());
    const auto movement = std::make_shared<const Trajectory>(load());
    common.warn_of_units(*movement);
    common.left = movement->side == Side::left;
    Workbench workbench = common.workbench();
    RunSpec spec;
    spec.trajectory = movement;
    spec.subject = subject;
    spec.noise = {noise, 1};
    spec.seed = common.seed;
    spec.appearance = from_name<Appearance>(appearance).value();
    const std::string readme = dataset_readme(chosen, spec);
    write_frames(workbench, spec, estimator(workbench), chosen,
                 {common.output, movement->name, workbench.calibration(), workbench.model(), readme});
    WholeFiles files(common.output);
    files.add("README.txt", readme);
    files.commit();
    if (!common.quiet) fmt::print("{}: {} frames of {}\n", common.output, movement->frames.size(), movement->name);
  }

  Trajectory load() const {
    if (trajectories::is_trajectory_file(trajectory)) return load_truth(trajectory, {});
    return load_truth(trajectory, from_name<reports::TruthKind>(truth));
  }

  Estimator estimator(Workbench& workbench) const {
    if (database.empty()) return {};
    const std::shared_ptr<Method> tracker = workbench.make_method(common.tracker_config(), database);
    return [tracker, results = std::vector<TrackResult>()](const DeviceFrame& images, int) mutable {
      const TrackResult& result = results.emplace_back(tracker->track(images, results));
      if (result.status != TrackStatus::tracked || !result.has.hand()) return std::optional<HandFrame>();
      return std::optional(HandFrame{result.timestamp_us, result.posture, result.T_camera_hand});
    };
  }

  static std::string estimate_formats() {
    std::vector<std::string> names;
    for (const FrameFormat& each : frame_formats())
      if (each.has_estimates) names.emplace_back(each.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }
};

}  // namespace

void add_render(Command program) {
  const Command command =
      program.subcommand("render", "Write the synthetic Kinect frames of a trajectory, with their truth.");
  const auto state = std::make_shared<Render>();
  state->common.add_output(command, "folder to write to").required();
  command
      .option("--trajectory", state->trajectory, "Tr1..Tr5, side_3 (`glovebench list families`) or a file (*.json)")
      .required();
  command.option("--truth", state->truth, "which truth of Tr1..Tr5").one_of({"source", "recorded"});
  command.option("--format", state->format, "of the files (`glovebench list datasets`)")
      .one_of(names_in(frame_formats()));
  command.option("--noise", state->noise, "depth noise").one_of(names_in(render::depth_noises()));
  command.option("--subject", state->subject, "whose hand (`glovebench list subjects`)")
      .in(1, render::kSubjectCount);
  command.option("--appearance", state->appearance, "what the hand wears: the glove, or nothing")
      .one_of(all_names<Appearance>());
  command.option("--database", state->database,
                 "track with this database and add the estimates: " + Render::estimate_formats());
  state->common.add_tracker(command);
  state->common.add_seed(command);
  state->common.add_cameras(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
