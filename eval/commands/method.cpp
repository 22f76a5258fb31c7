#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ranges>
#include <set>

#include "core/base/error.h"
#include "core/base/math.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/run.h"
#include "eval/terminal.h"
#include "reports/statistics.h"
#include "reports/text.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

using trajectories::Trajectory;

constexpr size_t kTriedFrames = 10;
constexpr int kFaulty = 1;  // exit code

/// "angles, pose, 21 joints"
std::string parts_of(const TrackResult& result) {
  std::vector<std::string> parts;
  if (result.has.posture) parts.push_back("angles");
  if (result.has.pose) parts.push_back("pose");
  const auto joints = std::ranges::count_if(result.joints, [](const auto& joint) { return joint.has_value(); });
  if (joints > 0) parts.push_back(reports::counted(static_cast<size_t>(joints), "joint"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Error of the hand's origin, mm. Without a pose: mean error of the joints. Empty if the answer has only angles.
std::optional<double> distance_mm(const TrackResult& result, const HandFrame& truth, const HandModel& hand) {
  if (result.has.pose)
    return 1000 * (result.T_camera_hand.translation() - truth.T_camera_hand.translation()).norm();
  const JointPoses T_hand_joint = hand.pose(truth.posture).T_hand_joint;
  std::vector<double> distances_mm;
  for (size_t j = 0; j < result.joints.size(); ++j)
    if (const auto& joint = result.joints[j])
      distances_mm.push_back(1000 * (*joint - truth.T_camera_hand * T_hand_joint[j].translation()).norm());
  return reports::mean(distances_mm);
}

/// The answer as a pose and angles. Those that it lacks are true, but a place is the first joint's.
HandFrame completed(const TrackResult& result, const HandFrame& truth) {
  HandFrame frame = truth;
  if (result.has.posture) frame.posture = result.posture;
  if (result.has.pose) frame.T_camera_hand = result.T_camera_hand;
  const auto joint = std::ranges::find_if(result.joints, [](const auto& each) { return each.has_value(); });
  if (!result.has.pose && joint != result.joints.end()) frame.T_camera_hand.translation() = **joint;
  return frame;
}

/// The angles that lie beyond a hand's limits, at most four sentences.
std::vector<std::string> angle_faults(const Trajectory& answers) {
  constexpr double kTolerance_deg = 0.01;
  constexpr size_t kMost = 3;
  std::vector<std::string> faults;
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[a];
    std::vector<double> values_deg;
    for (const HandFrame& frame : answers.frames) values_deg.push_back(degrees_from_radians(frame.posture[a]));
    const auto [least, most] = std::ranges::minmax(values_deg);
    if (least >= info.min_deg - kTolerance_deg && most <= info.max_deg + kTolerance_deg) continue;
    faults.push_back(fmt::format("{}: found {:.1f} to {:.1f} degrees, expected {:g} to {:g}", info.name, least,
                                 most, info.min_deg, info.max_deg));
  }
  if (faults.size() <= kMost) return faults;
  const std::string others = reports::counted(faults.size() - kMost, "other angle");
  faults.resize(kMost);
  faults.push_back(others + " beyond the limits (`glovebench list angles`)");
  return faults;
}

/// Tries a program on a few frames and says what is wrong with its answers.
struct MethodTest {
  CommonFlags common;

  /// Returns the exit code.
  int run() const {
    if (!is_program(common.method)) throw Error("method test", "method", common.method, "exec:COMMAND");
    Workbench workbench = common.workbench();
    Trajectory truth = load_truth("Tr4", reports::TruthKind::source);
    truth.frames.resize(kTriedFrames);
    const std::vector<TrackResult> results = try_on(workbench, truth);
    const std::vector<std::string> faults = faults_of(results, truth, *workbench.model());
    for (const std::string& fault : faults) fmt::print("- {}", reports::wrapped(fault, terminal_columns(), 2));
    if (faults.empty()) fmt::print("The answers are as they should be.\n");
    return faults.empty() ? 0 : kFaulty;
  }

  std::vector<TrackResult> try_on(Workbench& workbench, const Trajectory& truth) const {
    const std::unique_ptr<Method> method =
        make_method({common.tracker_config(), workbench.calibration(), workbench.model(), nullptr, nullptr});
    RunSpec spec;
    spec.trajectory = std::make_shared<const Trajectory>(truth);
    render::SyntheticKinect kinect = make_kinect(workbench, spec);
    std::vector<TrackResult> results;
    fmt::print("frame  status                time  answer\n");
    for (size_t f = 0; f < truth.frames.size(); ++f) {
      const std::optional<DeviceFrame> frame = kinect.next_frame();
      check(frame.has_value(), "the device plays every frame of the trajectory");
      const auto start = std::chrono::steady_clock::now();
      const TrackResult& result = results.emplace_back(method->track(*frame, results));
      const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
      const std::string row = fmt::format("{:>5}  {:<16}{:>7.1f} ms  ", f, to_string(result.status), spent.count());
      const std::string answer = result.status == TrackStatus::tracked ? parts_of(result) : result.reason;
      fmt::print("{}{}", row, answer.empty() ? "\n" : reports::wrapped(answer, terminal_columns(), row.size()));
      std::fflush(stdout);
    }
    return results;
  }

  /// Also prints how far the answers are from the truth.
  static std::vector<std::string> faults_of(const std::vector<TrackResult>& results, const Trajectory& truth,
                                            const HandModel& hand) {
    std::set<std::string> reasons;
    Trajectory answers;
    std::vector<double> distances_mm;
    for (size_t f = 0; f < results.size(); ++f) {
      if (!results[f].reason.empty()) reasons.insert(results[f].reason);
      if (results[f].status != TrackStatus::tracked) continue;
      answers.frames.push_back(completed(results[f], truth.frames[f]));
      if (const auto distance = distance_mm(results[f], truth.frames[f], hand)) distances_mm.push_back(*distance);
    }
    std::vector<std::string> faults(reasons.begin(), reasons.end());
    fmt::print("{} of {} frames tracked", answers.frames.size(), results.size());
    if (answers.frames.empty()) {
      fmt::print("\n");
      faults.push_back("no frame was tracked, although the hand is in all of them");
      return faults;
    }
    if (const auto median = quantile_of(distances_mm, 0.5))
      fmt::print(", {:.1f} mm from the true hand (median)", *median);
    fmt::print("\n");
    for (const auto& more : {trajectories::unit_doubts(answers, {}), angle_faults(answers)})
      faults.insert(faults.end(), more.begin(), more.end());
    return faults;
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
