#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/base/line_file.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/methods/method.h"
#include "core/robot/command_guard.h"
#include "core/tracker/track_result.h"
#include "eval/commands/flags.h"
#include "eval/commands/robot_outputs.h"
#include "eval/program.h"
#include "eval/run_warnings.h"
#include "eval/sources/source.h"
#include "eval/terminal.h"
#include "eval/track_overlay.h"
#include "render/label_renderer.h"
#include "reports/page/track_page.h"

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

/// Finds out if the hand that is seen has other sizes than the tracker's.
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
  bool is_hurried = false;     ///< plays a recording to a robot as fast as it is tracked
  std::string format;          ///< of the estimates; empty: by the file's ending
  std::string overlay, page;   ///< folder of pictures and HTML file; empty: none

  // State of the run.
  int frames = 0, unusable = 0, tracked = 0;
  std::vector<double> latencies_ms;         ///< of frames that were tracked or lost
  std::vector<reports::Estimate> for_page;  ///< with `page`
  HandCheck hand_check;
  std::map<std::string, size_t> no_answers;  ///< reasons, with their frames
  bool has_heading = false;                  ///< of the CSV file
  std::optional<Error> failure;              ///< of the device, or of a command
  bool is_whole = true;                      ///< all commands succeeded and all lines were written

  void run() {
    require_different_files({{"--output", common.output}, {"--robot-out", robot.output}, {"--page", page}});
    const bool writes_csv = is_csv();
    require_writable_files({{"--page", page, ".html"}});
    const std::shared_ptr<const ColorTable> own_colors =
        colors.empty() ? nullptr : std::make_shared<ColorTable>(ColorTable::load(colors));
    CommandGuard guard(robot.limits.limits());
    RobotOutputs outputs(robot.output, bus_options(guard.limits()));
    TrackSource source = open_source(from, common.quiet);
    Workbench workbench = common.workbench();
    const std::string name = workbench.add_database(database);
    const TrackerConfig config = common.tracker_config();
    const std::unique_ptr<Method> method =
        make_method({config, source.device->calibration(), workbench.model(), workbench.database(name),
                     own_colors ? own_colors : workbench.color_table(config.segmentation.color_space),
                     render::label_renderer_factory()});
    RobotSetup setup = robot.setup(workbench);
    std::optional<TrackOverlay> pictures;
    if (!overlay.empty()) pictures.emplace(overlay, workbench.model(), source.device->calibration());
    LineFile output(common.output);
    // After reading all files: opening a pipe may block, and a signal must end that.
    const Interruption interruption;
    setup.arm_start = outputs.arm_start().value_or(setup.arm_start);
    RobotCommander commander(setup);
    const size_t kept_results = static_cast<size_t>(config.smoothing.forget_after);
    const auto start = std::chrono::steady_clock::now();
    track_all(source, *method, kept_results, [&](int number, const DeviceFrame& frame, const TrackResult& result) {
      const TrackResult hand = lost_without_hand(result);
      if (outputs.any()) command(hand, commander, guard, source.arrived_us(), outputs);
      if_it_fails([&] {
        append(output, writes_csv, number, writes_csv ? hand : result);
        if (pictures) pictures->add(number, frame, hand);
      });
      if (!page.empty()) for_page.push_back(estimate_of(number, hand));
    });
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (frames == unusable) refuse();
    finish(output, outputs, pictures ? &*pictures : nullptr);
    if (!page.empty()) write_file(page, reports::track_page(from.source, for_page, page_scripts()));
    warn(config.volume);
    if (!common.quiet) print_summary(source, spent.count());
    if (failure) throw Error(*failure);
    if (!common.quiet && !source.ended_by().empty()) say("glovebench: {}\n", source.ended_by());
  }

  /// A robot, pictures, a page and CSV show posture and pose. A program may give less.
  static TrackResult lost_without_hand(TrackResult result) {
    if (!result.has.hand() && result.status == TrackStatus::tracked) result.status = TrackStatus::missing;
    return result;
  }

  static reports::Estimate estimate_of(int number, const TrackResult& result) {
    return {0, number, result.timestamp_us, result.status, result.posture, result.T_camera_hand};
  }

  /// The heading of a CSV file comes with its first line.
  void append(LineFile& output, bool writes_csv, int number, const TrackResult& result) {
    if (!writes_csv) return output.append(estimate_line(number, result));
    if (!std::exchange(has_heading, true)) output.append(reports::estimates_heading());
    output.append(reports::estimate_csv_line(estimate_of(number, result)));
  }

  void warn(const WorkingVolume& volume) const {
    for (const std::string& warning : no_answer_warnings(no_answers)) say("glovebench: warning: {}\n", warning);
    if (!failure && tracked == 0 && no_answers.empty())
      say("glovebench: warning: none of {} frames was tracked. Likely causes: a left hand without --left, glove "
          "colors other than those of --colors, or a hand outside of the working volume ({:g} to {:g} mm)\n",
          frames, 1000 * volume.z_min, 1000 * volume.z_max);
    if (hand_check.asks_for_calibration())
      say("glovebench: warning: the hand has other sizes than the tracker's. To fit them: glovebench calibrate "
          "hand, then --hand\n");
  }

  void print_summary(const TrackSource& source, double seconds) const {
    fmt::print(messages(), "{}: {} of {} frames tracked{}{}\n", common.output, tracked, frames,
               counted(unusable, "unusable"), counted(source.dropped(), "dropped"));
    if (latencies_ms.empty()) return;
    fmt::print(messages(), "{:.1f} frames/s; from frame to estimate {:.1f} ms (median), {:.1f} ms (95%)\n",
               static_cast<double>(latencies_ms.size()) / seconds, *quantile_of(latencies_ms, 0.5),
               *quantile_of(latencies_ms, 0.95));
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

  /// CSV or JSON Lines, from --format or else the ending.
  bool is_csv() const {
    if (!format.empty()) return format == "csv";
    if (common.output.ends_with(".csv")) return true;
    if (common.output.ends_with(".jsonl") || find_output(common.output).is_stream) return false;
    throw Error("--output", "file name", common.output, "the ending .jsonl or .csv, or --format");
  }

  using UseResult = std::function<void(int number, const DeviceFrame& frame, const TrackResult& result)>;

  void track_all(TrackSource& source, Method& method, size_t kept_results, const UseResult& use) {
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
        if (drives_a_robot && source.frame_count > 0 && !is_hurried) pace.wait_for(frame->depth_timestamp_us);
        const int64_t arrived_us = source.frame_count > 0 ? system_us() : source.arrived_us();
        const TrackResult result = results.emplace_back(method.track(*frame, results));
        if (results.size() == 2 * kept_results)  // not in each frame: an erasure moves the rest
          results.erase(results.begin(), results.begin() + static_cast<ptrdiff_t>(kept_results));
        latencies_ms.push_back(static_cast<double>(system_us() - arrived_us) / 1000);
        if (!result.reason.empty()) ++no_answers[result.reason];
        use(number, *frame, result);
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
  void finish(LineFile& output, RobotOutputs& outputs, TrackOverlay* pictures) {
    if_it_fails([&] { outputs.finish(is_whole); });
    if (is_whole) if_it_fails([&] { output.finish(); });
    if (is_whole && pictures) if_it_fails([&] { pictures->finish(); });
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
    if (failure) throw Error(*failure);
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
  state->from.add(command, "a recording, or a camera until Ctrl-C");
  command.option("--frames", state->limit, "how many to track; 0: all").not_negative();
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
              "estimates to write, a line a frame: JSON (*.jsonl) or CSV (*.csv); -: to standard output")
      .required();
  command.option("--format", state->format, "of the estimates [by the ending; of streams jsonl]")
      .one_of({"jsonl", "csv"});
  command.option("--overlay", state->overlay,
                 "the tracked hand over the color images: folder for pictures, or video (*.mp4)");
  command.option("--page", state->page, "page with the path and the angles, to write (*.html)");
  state->robot.add(command, "robot commands to write (*.jsonl)");
  const Command robot = command.group("Robot");
  state->bus.add(robot, "stream the robot commands: dds[:DOMAIN], as ROS 2 speaks it");
  robot
      .option("--robot-topics", state->topics,
              "own, which only `robot-server` hears; controller, those of a robot's controllers, from where the "
              "robot is measured to stand (the arm's, too, unless --robot-arm none)")
      .one_of({"own", "controller"})
      .needs("--robot");
  robot
      .option("--as-fast-as-possible", state->is_hurried,
              "command the robot as fast as a recording is tracked, not in the recording's own time")
      .needs("--robot");
  command.option("--left", state->common.left, "a left hand");
  state->common.add_hand(command);
  state->common.add_tracker(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
