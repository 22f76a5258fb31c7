#include <fmt/format.h>

#include <optional>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/kinect/recording.h"
#include "core/methods/method.h"
#include "core/robot/json_lines_sink.h"
#include "core/tracker/estimate_line.h"
#include "eval/commands/command.h"
#include "eval/progress.h"

namespace glovebench::eval {
namespace {

constexpr std::string_view kRecordingPrefix = "fakenect:";

struct Track {
  CommonFlags common;
  std::string source;
  std::string database;
  RobotFlags robot;

  void run() {
    if (!source.starts_with(kRecordingPrefix)) {
      throw Error("--source", "kind", source, "fakenect:FOLDER");
    }
    RecordingDevice device(source.substr(kRecordingPrefix.size()));
    Workbench workbench = common.workbench();
    const std::string name = workbench.add_database(database);
    const TrackerConfig config = common.tracker_config();
    const std::unique_ptr<Method> method =
        find_method(config.method)
            .make({config, device.calibration(), workbench.model(), workbench.database(name),
                   workbench.color_table(config.segmentation.color_space)});
    std::optional<JsonLinesSink> sink;
    if (!robot.output.empty()) sink.emplace(robot.output);
    RobotCommander commander(robot.T_base_camera());

    Progress progress("tracking", common.quiet);
    std::string lines;
    int frames = 0, tracked = 0;
    while (const std::optional<DeviceFrame> frame = device.next_frame()) {
      const TrackResult result = method->track(*frame);
      lines += estimate_line(frames++, result) + "\n";
      tracked += result.status == TrackStatus::tracked;
      if (sink) sink->send(commander.command(result));
      progress.show(static_cast<double>(frames) / device.frame_count());
    }
    write_file(common.output, lines);
    if (sink) sink->finish();
    fmt::print("{}: {} of {} frames tracked\n", common.output, tracked, frames);
  }
};

}  // namespace

void add_track(CLI::App& program) {
  CLI::App* command = program.add_subcommand("track", "Track the hand in a recording and write the estimates.");
  const auto state = std::make_shared<Track>();
  command->add_option("--source", state->source, "fakenect:FOLDER, a recording with calibration.json beside it")
      ->required();
  command
      ->add_option("--database", state->database,
                   "name (`glovebench list databases`) or file (*.glovedb, *.csv, *.json)")
      ->required();
  state->common.add_output(*command, "estimates to write, one line of JSON a frame (*.jsonl)", true);
  state->robot.add(*command, "robot commands to write (*.jsonl)");
  command->add_flag("--left", state->common.left, "a left hand");
  state->common.add_tracker(*command);
  state->common.add_machine(*command);
  command->callback([state] { state->run(); });
}

}  // namespace glovebench::eval
