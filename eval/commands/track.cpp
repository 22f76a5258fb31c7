#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "core/base/error.h"
#include "core/base/line_file.h"
#include "core/base/whole_file.h"
#include "core/methods/method.h"
#include "core/robot/command_guard.h"
#include "core/tracker/track_result.h"
#include "eval/commands/flags.h"
#include "eval/commands/robot_outputs.h"
#include "eval/commands/track_source.h"
#include "eval/interruption.h"
#include "eval/terminal.h"
#include "render/label_renderer.h"

namespace glovebench::eval {
namespace {

/// Plays a recording no faster than it was taken.
class Pace {
 public:
  /// Returns when the frame is due or the user interrupts.
  void wait_for(int64_t timestamp_us) {
    using namespace std::chrono;
    constexpr milliseconds kLongestNap(50);
    if (last_us_) due_ += microseconds(timestamp_us - *last_us_);
    last_us_ = timestamp_us;
    while (steady_clock::now() < due_ && !Interruption::wished())
      std::this_thread::sleep_for(std::min<steady_clock::duration>(kLongestNap, due_ - steady_clock::now()));
    due_ = steady_clock::now();
  }

 private:
  std::optional<int64_t> last_us_;
  std::chrono::steady_clock::time_point due_;
};

/// Whether the tracker's hand has other sizes than the one it sees.
class HandCheck {
 public:
  void add(const TrackResult& result) {
    if (result.status != TrackStatus::tracked || !result.misfit) return;
    ++frames_;
    far_ += *result.misfit > kFar;
  }
  bool asks_for_calibration() const { return frames_ >= kLeastFrames && 2 * far_ > frames_; }

 private:
  static constexpr int kLeastFrames = 30;
  /// m. Medians of movements: at most 0.05 mm with the right hand or a calibrated one, with every noise model; at
  /// least 0.14 mm with a hand 5% larger.
  static constexpr double kFar = 0.09e-3;

  int frames_ = 0, far_ = 0;
};

struct Track {
  CommonFlags common;
  SourceFlags from;
  std::string database;
  std::string colors;  ///< color table; empty: the tracker's own
  int limit = 0;       ///< frames; 0: to the end
  RobotFlags robot;
  BusFlags bus;
  std::string topics = "own";  ///< to which commands are sent

  // Of the run.
  int frames = 0, unusable = 0, tracked = 0;
  HandCheck hand_check;
  std::optional<Error> failure;  ///< of the device, or of a command
  bool is_whole = true;          ///< all commands succeeded and all lines were written

  void run() {
    require_different_files({{"--output", common.output}, {"--robot-out", robot.output}});
    const std::shared_ptr<const ColorTable> own_colors =
        colors.empty() ? nullptr : std::make_shared<ColorTable>(ColorTable::load(colors));
    CommandGuard guard(robot.limits.limits());
    RobotOutputs outputs(robot.output, bus_options(guard.limits()));
    TrackSource source = open_source(from, common.quiet);
    Workbench workbench = common.workbench();
    const std::string name = workbench.add_database(database);
    const TrackerConfig config = common.tracker_config();
    const std::unique_ptr<Method> method =
        find_method(config.method)
            .make({config, source.device->calibration(), workbench.model(), workbench.database(name),
                   own_colors ? own_colors : workbench.color_table(config.segmentation.color_space),
                   render::label_renderer_factory()});
    RobotSetup setup = robot.setup(workbench);
    LineFile output(common.output);
    // After reading all files: opening a pipe may block, and a signal must end that.
    const Interruption interruption;
    setup.arm_start = outputs.arm_start().value_or(setup.arm_start);
    RobotCommander commander(setup);
    const size_t kept_results = static_cast<size_t>(config.smoothing.forget_after);
    track_all(source, *method, kept_results, output, [&](const TrackResult& result) {
      if (outputs.any()) command(result, commander, guard, source.arrived_us(), outputs);
    });
    if (frames == unusable) refuse();
    finish(output, outputs);
    if (!common.quiet && !failure && tracked == 0)
      say("glovebench: warning: none of {} frames was tracked. Likely causes: a left hand without --left, glove "
          "colors "
          "other than those of --colors, or a hand outside of the working volume ({:g} to {:g} mm)\n",
          frames, 1000 * config.volume.z_min, 1000 * config.volume.z_max);
    const bool is_other_hand = hand_check.asks_for_calibration();
    if (!common.quiet && is_other_hand)
      say("glovebench: warning: the hand has other sizes than the tracker's. To fit them: glovebench calibrate "
          "hand, "
          "then --hand\n");
    if (!common.quiet)
      fmt::print(messages(), "{}: {} of {} frames tracked{}{}{}\n", common.output, tracked, frames,
                 counted(unusable, "unusable"), counted(source.dropped(), "dropped"),
                 is_other_hand ? "; other sizes of the hand: see glovebench calibrate hand" : "");
    if (failure) throw *failure;
    if (!common.quiet && !source.ended_by().empty()) say("glovebench: {}\n", source.ended_by());
  }

  /// Empty without `--robot`.
  std::optional<RobotBusOptions> bus_options(const CommandLimits& limits) const {
    if (bus.middleware.empty()) return std::nullopt;
    return RobotBusOptions{.domain = bus.domain(),
                           .access = bus.access("sender"),
                           .to_controller = topics == "controller",
                           .arm = robot.arm != "none",
                           .T_flange_wrist = robot.mounting.T_flange_wrist(),
                           .longest_step_s = limits.longest_step_s};
  }

  void track_all(TrackSource& source, Method& method, size_t kept_results, LineFile& output,
                 const std::function<void(const TrackResult&)>& command_robot) {
    Progress progress("tracking", common.quiet);
    StatusLine status(common.quiet || source.frame_count > 0);
    Pace pace;
    const bool drives_a_robot = !bus.middleware.empty();
    std::vector<TrackResult> results;  // the newest
    while (!failure && !Interruption::wished() && (limit == 0 || frames < limit)) {
      const int number = frames;
      const std::optional<DeviceFrame> frame = next_frame(*source.device);
      if (!frame && frames == number) return;
      if (frame) {
        if (drives_a_robot && source.frame_count > 0) pace.wait_for(frame->depth_timestamp_us);
        const TrackResult result = results.emplace_back(method.track(*frame, results));
        if (results.size() == 2 * kept_results)  // not in each frame: an erasure moves the rest
          results.erase(results.begin(), results.begin() + static_cast<ptrdiff_t>(kept_results));
        command_robot(result);
        if_it_fails([&] { output.append(estimate_line(number, result)); });
        tracked += result.status == TrackStatus::tracked;
        hand_check.add(result);
        status.show(result, source.dropped());
      }
      if (source.frame_count > 0) progress.show(static_cast<double>(frames) / source.frame_count);
    }
  }

  void command(const TrackResult& result, RobotCommander& commander, CommandGuard& guard, int64_t arrived_us,
               RobotOutputs& outputs) {
    if_it_fails([&] { outputs.send(guard, commander.command(result), arrived_us); });
  }

  /// Names the files of a session, even if its device failed. A session that lost a line keeps an older file and
  /// leaves its own lines beside it; the message says where.
  void finish(LineFile& output, RobotOutputs& outputs) {
    if_it_fails([&] { outputs.finish(is_whole); });
    if (is_whole) if_it_fails([&] { output.finish(); });
    if (is_whole) return;
    std::string message = failure->what();
    for (const std::string& lines : {output.kept(), outputs.kept()})
      if (message.find(lines) == std::string::npos) message += "; kept: " + lines;
    throw Error(message);
  }

  /// Notes an output's error, which ends the session.
  void if_it_fails(const std::function<void()>& write) {
    try {
      write();
    } catch (const Error& e) {
      if (is_whole) failure = e;
      is_whole = false;
    }
  }

  /// The summary's stream; stdout may hold the lines.
  std::FILE* messages() const {
    for (const std::string& path : {common.output, robot.output})
      if (!path.empty() && find_output(path).descriptor == STDOUT_FILENO) return stderr;
    return stdout;
  }

  /// Counts the frame. Empty at the end and for an unusable frame.
  std::optional<DeviceFrame> next_frame(Device& device) {
    try {
      std::optional<DeviceFrame> frame = device.next_frame();
      frames += frame.has_value();
      return frame;
    } catch (const FrameError& e) {
      ++frames;
      ++unusable;
      if (!common.quiet) say("glovebench: skipped: {}\n", e.what());
    } catch (const Error& e) {
      failure = e;
    }
    return std::nullopt;
  }

  [[noreturn]] void refuse() const {
    if (failure) throw *failure;
    throw Error(from.source, "usable frames", fmt::format("none of {}", frames), "at least one");
  }

  static std::string counted(int count, const char* what) {
    return count > 0 ? fmt::format(", {} {}", count, what) : "";
  }
};

}  // namespace

void add_track(Command program) {
  const Command command =
      program.subcommand("track", "Track the hand in a recording or before a Kinect and write the estimates.");
  const auto state = std::make_shared<Track>();
  command
      .option("--source", state->from.source,
              "fakenect:FOLDER, a recording; freenect[:INDEX], a Kinect, until Ctrl-C")
      .required();
  command.option("--calibration", state->from.calibration,
                 "calibration (*.json) [the recording's; of a Kinect: nominal values]");
  command.option("--frames", state->limit, "stop after that many; 0: none is the last").not_negative();
  command
      .option("--every-frame", state->from.every_frame,
              "freenect: drop none that comes too fast, for what the fakenect library plays")
      .rare();
  command
      .option("--database", state->database,
              "name (`glovebench list databases`) or file (*.glovedb, *.csv, *.json)")
      .required();
  command.option("--colors", state->colors,
                 "color table (`glovebench calibrate colors`) [calibrated from rendered views]");
  command
      .option("-o,--output", state->common.output,
              "estimates to write, one line of JSON a frame (*.jsonl; -: to standard output)")
      .required();
  state->robot.add(command, "robot commands to write (*.jsonl)");
  const Command robot = command.group("Robot");
  state->bus.add(robot, "stream the robot commands: dds[:DOMAIN], as ROS 2 speaks it");
  robot
      .option("--robot-topics", state->topics,
              "own, which only `robot-server` hears; controller, those of a robot's controllers, from where the "
              "robot is measured to stand (the arm's, too, unless --robot-arm none)")
      .one_of({"own", "controller"})
      .needs("--robot");
  command.option("--left", state->common.left, "a left hand");
  state->common.add_hand(command);
  state->common.add_tracker(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
