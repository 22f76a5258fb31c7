#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ranges>

#include "core/adapters/process/process_method.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/run.h"
#include "eval/terminal.h"
#include "reports/text.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

constexpr int kFaulty = 1;  // exit code

/// Tries a program on a few frames and says what is wrong with its answers.
struct MethodTest {
  CommonFlags common;

  std::vector<std::string> faults;
  trajectories::Trajectory tracked;  ///< what it answered
  std::vector<double> distances_mm;  ///< from the true hand

  /// Returns the exit code.
  int run() {
    if (!is_program(common.method)) throw Error("method test", "method", common.method, "exec:COMMAND");
    trajectories::Trajectory truth = load_truth("Tr4", reports::TruthKind::source);
    constexpr size_t kFrames = 10;
    truth.frames.resize(kFrames);
    try_on(std::make_shared<const trajectories::Trajectory>(std::move(truth)));
    judge();
    for (const std::string& fault : faults) fmt::print("- {}", reports::wrapped(fault, terminal_columns(), 2));
    fmt::print("{}\n", faults.empty() ? "Its answers are well-formed." : "Its answers are wrong. See above.");
    return faults.empty() ? 0 : kFaulty;
  }

  void try_on(const std::shared_ptr<const trajectories::Trajectory>& truth) {
    Workbench workbench = common.workbench();
    const TrackerConfig config = common.tracker_config();
    const std::unique_ptr<Method> method =
        make_method({config, workbench.calibration(), workbench.model(), nullptr, nullptr});
    render::SyntheticKinect kinect = make_kinect(workbench, {.trajectory = truth});
    std::vector<TrackResult> results;
    fmt::print("frame  status          time  \n");
    for (const HandFrame& frame : truth->frames) {
      const std::optional<DeviceFrame> device_frame = kinect.next_frame();
      check(device_frame.has_value(), "the device plays every frame of the trajectory");
      const auto start = std::chrono::steady_clock::now();
      const TrackResult& result = results.emplace_back(method->track(*device_frame, results));
      const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
      const std::string row =
          fmt::format("{:>5}  {:<12}{:>8.1f} ms  ", results.size() - 1, to_string(result.status), spent.count());
      fmt::print("{}{}", row, reports::wrapped(result.reason, terminal_columns(), row.size()));
      note(result, frame);
    }
  }

  void note(const TrackResult& result, const HandFrame& truth) {
    if (result.status == TrackStatus::missing) faults.push_back(result.reason);
    if (result.status != TrackStatus::tracked) return;
    HandFrame frame = truth;
    frame.posture = result.posture;
    frame.T_camera_hand = result.T_camera_hand;
    tracked.frames.push_back(frame);
    distances_mm.push_back(1000 * (result.T_camera_hand.translation() - truth.T_camera_hand.translation()).norm());
  }

  void judge() {
    if (tracked.frames.empty())
      return faults.push_back("no frame was tracked, although the hand is in all of them");
    for (const std::string& doubt : trajectories::unit_doubts(tracked, {})) faults.push_back(doubt);
    judge_angles();
    fmt::print("{} of 10 frames tracked; the hand's origin is {:.1f} mm (median) from the true one.\n",
               tracked.frames.size(), *quantile_of(distances_mm, 0.5));
  }

  void judge_angles() {
    constexpr double kTolerance_deg = 0.01;
    constexpr size_t kMost = 3;
    std::vector<std::string> beyond;
    for (int a = 0; a < kAngleCount; ++a) {
      const auto [least, most] =
          std::ranges::minmax(tracked.frames | std::views::transform([&](const HandFrame& f) {
                                return degrees_from_radians(f.posture[a]);
                              }));
      const AngleInfo& info = angle_infos()[a];
      if (least < info.min_deg - kTolerance_deg || most > info.max_deg + kTolerance_deg)
        beyond.push_back(fmt::format("{}: found {:.1f} to {:.1f} deg, expected {:g} to {:g}", info.name, least,
                                     most, info.min_deg, info.max_deg));
    }
    if (beyond.size() > kMost) {
      const std::string rest = reports::counted(beyond.size() - kMost, "other angle");
      beyond.resize(kMost);
      beyond.push_back(rest + " beyond its limits, too (`glovebench list angles`)");
    }
    faults.insert(faults.end(), beyond.begin(), beyond.end());
  }
};

}  // namespace

void add_method(Command program) {
  const Command method = program.subcommand("method", "Try a tracker of your own.");
  const Command test = method.subcommand(
      "test",
      "Send 10 frames of a hand to a tracker that is a program, and say what is wrong with its answers.\n"
      "Exit code 1: something is.");
  const auto state = std::make_shared<MethodTest>();
  test.option("method", state->common.method, "exec:COMMAND, as of --method (eval/guides/tracker.md)").required();
  state->common.add_machine(test);
  test.runs([state] { return state->run(); });
}

}  // namespace glovebench::eval
