#include <fmt/format.h>

#include <optional>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/registry.h"
#include "core/kinect/disparity.h"
#include "core/kinect/recording.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/run.h"
#include "eval/terminal.h"
#include "render/exr.h"
#include "render/label_renderer.h"
#include "render/pictures.h"
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

  void run() {
    const auto movement = std::make_shared<const Trajectory>(load());
    common.warn_of_units(*movement);
    common.left = movement->side == Side::left;
    Workbench workbench = common.workbench();
    RunSpec spec;
    spec.trajectory = movement;
    spec.subject = subject;
    spec.noise = {noise, 1};
    spec.seed = common.seed;
    render::SyntheticKinect kinect = make_kinect(workbench, spec);
    std::optional<RecordingWriter> recording;
    std::optional<WholeFiles> pictures;
    if (format == "fakenect") recording.emplace(common.output, workbench.calibration());
    if (format != "fakenect") pictures.emplace(common.output);
    std::unique_ptr<Method> tracker;
    if (!database.empty()) tracker = workbench.make_method(common.tracker_config(), database);

    std::vector<TrackResult> results;
    Progress progress("rendering", common.quiet);
    const int count = static_cast<int>(movement->frames.size());
    for (int f = 0; f < count; ++f) {
      const DeviceFrame frame = *kinect.next_frame();
      if (recording) recording->write(frame);
      if (format == "png") add_pngs(*pictures, frame, f);
      if (tracker && format == "exr") results.push_back(tracker->track(frame, results));
      if (format == "exr") add_layers(*pictures, workbench, kinect, results, frame, f);
      progress.show(static_cast<double>(f + 1) / count);
    }
    if (recording) recording->finish();
    if (pictures) pictures->commit();
    if (!common.quiet) fmt::print("{}: {} frames of {}\n", common.output, count, movement->name);
  }

  Trajectory load() const {
    if (trajectories::is_trajectory_file(trajectory)) return load_truth(trajectory, {});
    return load_truth(trajectory, from_name<reports::TruthKind>(truth));
  }

  static void add_pngs(WholeFiles& pictures, const DeviceFrame& frame, int f) {
    const DepthImage depth = depth_from_disparity(frame.raw_disparity);
    pictures.add(fmt::format("color_{:04}.png", f), encode_png(frame.color));
    pictures.add(fmt::format("depth_{:04}.png", f), encode_png(render::picture_of_depth(depth, 0.4, 1.8)));
  }

  static void add_layers(WholeFiles& pictures, Workbench& workbench, const render::SyntheticKinect& kinect,
                         std::span<const TrackResult> results, const DeviceFrame& frame, int f) {
    render::FrameLayers layers{frame.color, kinect.truth().depth, kinect.truth().label, {}, {}};
    if (!results.empty() && results.back().status == TrackStatus::tracked && results.back().has.hand()) {
      const TrackResult& result = results.back();
      const HandModel& model = *workbench.model();
      render::LabelRenderer renderer;
      const HandImages estimate =
          renderer.render_ids(model, model.pose(result.posture), workbench.calibration().ir, result.T_camera_hand);
      layers.tracker_depth = estimate.depth;
      layers.tracker_label = estimate.label;
    }
    const std::string name = fmt::format("frame_{:04}.exr", f);
    pictures.add(name, render::encode_exr(layers, name));
  }
};

}  // namespace

void add_render(Command program) {
  const Command command = program.subcommand("render", "Write the synthetic Kinect frames of a trajectory.");
  const auto state = std::make_shared<Render>();
  state->common.add_output(command, "folder to write to").required();
  command
      .option("--trajectory", state->trajectory, "Tr1..Tr5, side_3 (`glovebench list families`) or a file (*.json)")
      .required();
  command.option("--truth", state->truth, "which truth of Tr1..Tr5").one_of({"source", "recorded"});
  command
      .option("--format", state->format,
              "png: color and depth pictures; exr: color, z, label, and with --database the tracker's view; "
              "fakenect: a recording that libfreenect's fakenect and `glovebench track` play")
      .one_of({"png", "exr", "fakenect"});
  command.option("--noise", state->noise, "depth noise").one_of(names_in(render::depth_noises()));
  command.option("--subject", state->subject, "whose hand (`glovebench list subjects`)")
      .in(1, render::kSubjectCount);
  command.option("--database", state->database, "exr: track with this database and add the tracker's view");
  state->common.add_tracker(command);
  state->common.add_seed(command);
  state->common.add_cameras(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
