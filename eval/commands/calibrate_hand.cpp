#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <optional>

#include "core/base/whole_file.h"
#include "core/calibration/hand_report.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/sources/source.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

struct CalibrateHand {
  CommonFlags common;
  SourceFlags from;
  std::string database = "DB_20_postures";
  std::string colors;  ///< color table; empty: the tracker's own
  std::string report;  ///< *.json; empty: none
  int frame_count = 120;

  void run() {
    require_writable_files({{"--output", common.output}, {"--report", report, ".json"}});
    const std::shared_ptr<const ColorTable> own_colors =
        colors.empty() ? nullptr : std::make_shared<ColorTable>(ColorTable::load(colors));
    TrackSource source = open_source(from, common.quiet);
    Workbench workbench = common.workbench();
    const std::string name = workbench.add_database(database);
    TrackerConfig config = common.tracker_config();
    config.method = "articulated";
    const MethodInputs inputs{config, source.device->calibration(), workbench.model(), workbench.database(name),
                              own_colors ? own_colors : workbench.color_table(config.segmentation.color_space)};
    const std::vector<calibration::TrackedView> views = take_views(source, inputs);
    const calibration::ShownMotion motion = calibration::motion_of(views);
    require_motion(motion, from.source);

    const calibration::HandMesh mesh{hand_mesh_path(), workbench.config().side};
    const calibration::HandFit fit = tbb::task_arena(workbench.config().threads).execute([&] {
      return fit_hand_shape(views, inputs.calibration.ir, mesh);
    });
    write_file(common.output, reports::format_json(to_json(measured_hand(fit, mesh.side))));
    if (!report.empty()) write_file(report, reports::format_json(hand_report_json(fit, motion, from.source)));
    if (common.quiet) return;
    fmt::print("{}: a {} hand of {} frames\n\n{}", common.output, to_string(mesh.side), views.size(),
               hand_report_markdown(fit, motion));
  }

  std::vector<calibration::TrackedView> take_views(TrackSource& source, const MethodInputs& inputs) const {
    const std::unique_ptr<Method> method = find_method(inputs.config.method).make(inputs);
    std::vector<calibration::TrackedView> views;
    std::vector<TrackResult> results;
    take_spread(source, frame_count, "tracking", common.quiet, [&](const DeviceFrame& frame) {
      results.push_back(method->track(frame, results));
      if (std::optional<calibration::TrackedView> view = calibration::view_of(frame, results.back(), inputs))
        views.push_back(std::move(*view));
    });
    return views;
  }
};

}  // namespace

void add_calibrate_hand(Command calibrate) {
  const Command command = calibrate.subcommand(
      "hand",
      "Fit the tracker's hand to a person, for --hand: sizes, surface, pattern of the glove.\n"
      "Record about 10 s in which the hand opens, closes, bends and turns over (core/calibration/README.md).");
  const auto state = std::make_shared<CalibrateHand>();
  state->from.add(command, "a hand that moves");
  state->common.add_output(command, "hand to write, for --hand (*.json)").required();
  command.option("--report", state->report, "sizes, residuals and what was not seen, to write (*.json)");
  command.option("--database", state->database,
                 "to track with: name (`glovebench list databases`) or file (*.glovedb, *.csv, *.json)");
  command.option("--colors", state->colors,
                 "color table (`glovebench calibrate colors`) [calibrated from rendered views]");
  command.option("--frames", state->frame_count, "frames to take, spread over the recording").in(30, 1000);
  command.option("--left", state->common.left, "a left hand");
  command.option("--config", state->common.config_file,
                 "JSON file with the tracker's fields to change; the method is `articulated`");
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
