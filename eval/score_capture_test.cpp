// A recording against motion capture of the same hand, with a clock and a frame of its own.
#include "eval/score.h"

#include <gmock/gmock.h>

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/test_error.h"
#include "eval/command_test.h"
#include "eval/estimates/capture_alignment.h"
#include "eval/program.h"
#include "trajectories/capture/test_capture.h"
#include "trajectories/generation/motion_script.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using json = nlohmann::json;

constexpr double kStart_s = 0.812345;  ///< of the recording, on the capture's clock

/// A hand that moves, turns and bends smoothly.
HandFrame hand_at(double time_s) {
  HandFrame frame;
  frame.timestamp_us = std::llround(1e6 * time_s);
  frame.posture[kIndexMcpFlexion] = 0.4 + 0.3 * std::sin(2 * time_s);
  frame.T_camera_hand.linear() =
      (trajectories::hand_rotation(0, 0, 0) *
       Eigen::AngleAxisd(0.3 * std::sin(1.7 * time_s), Eigen::Vector3d(1, 2, 1).normalized()))
          .toRotationMatrix();
  frame.T_camera_hand.translation() = Eigen::Vector3d(0.05 * std::sin(2.3 * time_s), 0.04 * std::cos(3.1 * time_s),
                                                      0.7 + 0.03 * std::sin(1.3 * time_s));
  return frame;
}

/// Frames from 0 on; the first shows the hand at `start_s`.
std::vector<HandFrame> frames_of_hand(double start_s, double rate_hz, int count) {
  std::vector<HandFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(hand_at(start_s + i / rate_hz));
    frames.back().timestamp_us = std::llround(1e6 * i / rate_hz);
  }
  return frames;
}

std::vector<HandFrame> in_capture(std::vector<HandFrame> frames) {
  for (HandFrame& frame : frames) frame.T_camera_hand = trajectories::test_T_capture_camera() * frame.T_camera_hand;
  return frames;
}

/// True hands with noise as answers, on a clock that began an hour before.
std::vector<TrackResult> noisy_answers(const std::vector<HandFrame>& frames, double noise) {
  std::vector<TrackResult> answers;
  for (size_t f = 0; f < frames.size(); ++f) {
    RandomStream random(1, "answers", static_cast<int>(f), "noise");
    TrackResult& answer = answers.emplace_back();
    answer.status = TrackStatus::tracked;
    answer.timestamp_us = 3'600'000'000 + frames[f].timestamp_us;
    answer.posture = frames[f].posture;
    answer.T_camera_hand = frames[f].T_camera_hand;
    for (int axis = 0; axis < 3; ++axis) answer.T_camera_hand.translation()[axis] += noise * random.normal();
  }
  return answers;
}

class CaptureAlignmentOf : public testing::Test {
 protected:
  static Workbench& workbench() {
    static Workbench shared(test_workbench());
    return shared;
  }
  static CaptureAlignment align(const std::vector<HandFrame>& capture, const std::vector<TrackResult>& answers) {
    return align_to_capture(capture, answers, workbench().subject(1), *workbench().model(), "test");
  }
  static std::string refusal(const std::vector<HandFrame>& capture, const std::vector<TrackResult>& answers) {
    return thrown_by([&] { align(capture, answers); });
  }
};

void expect_aligned(double start_s, const Eigen::Isometry3d& T_camera_capture) {
  EXPECT_NEAR(1000 * start_s, 1000 * kStart_s, 2) << "ms";
  const Eigen::Isometry3d error = T_camera_capture * trajectories::test_T_capture_camera();
  const Eigen::Vector3d hand(0, 0, 0.7);
  EXPECT_LT(1000 * (error * hand - hand).norm(), 0.5) << "mm, at the hand";
  EXPECT_LT(degrees_from_radians(angle_between(error.linear(), Eigen::Matrix3d::Identity())), 0.1) << "degrees";
}

TEST_F(CaptureAlignmentOf, NoisyAnswersIsTheirClockAndFrame) {
  const std::vector<HandFrame> capture = in_capture(frames_of_hand(0, 100, 500));
  std::vector<TrackResult> answers = noisy_answers(frames_of_hand(kStart_s, 30, 90), 0.001);
  answers[20].T_camera_hand.translation().x() += 0.2;
  answers[21].status = TrackStatus::no_hand;
  const CaptureAlignment alignment = align(capture, answers);
  const double hour_us = 3.6e9;
  expect_aligned((alignment.time.offset_us + hour_us) / 1e6, alignment.T_camera_capture);
  EXPECT_LE(alignment.time.low_us, alignment.time.offset_us);
  EXPECT_GE(alignment.time.high_us, alignment.time.offset_us);
  EXPECT_LT(alignment.time.high_us - alignment.time.low_us, 10'000);
  EXPECT_EQ(alignment.left_out, 1U);
  EXPECT_EQ(alignment.used, 88U);
  EXPECT_NEAR(1000 * alignment.residual, 1.7, 0.2) << "noise of 1 mm in three coordinates";

  const CapturedTruth truth = captured_truth(capture, answers, alignment, "test");
  ASSERT_EQ(truth.frames.size(), answers.size());
  EXPECT_EQ(truth.frames.front().timestamp_us, 0);
  EXPECT_LT(
      (truth.frames[50].T_camera_hand.translation() - hand_at(kStart_s + 50 / 30.0).T_camera_hand.translation())
          .norm(),
      0.0005);
}

TEST_F(CaptureAlignmentOf, AHandThatRestsIsRefused) {
  const std::vector<HandFrame> resting(300, hand_at(0));
  std::vector<HandFrame> capture = in_capture(resting);
  std::vector<HandFrame> seen(90, hand_at(0));
  for (size_t f = 0; f < capture.size(); ++f) capture[f].timestamp_us = 10'000 * static_cast<int64_t>(f);
  for (size_t f = 0; f < seen.size(); ++f) seen[f].timestamp_us = 33'333 * static_cast<int64_t>(f);
  EXPECT_THAT(refusal(capture, noisy_answers(seen, 0)), HasSubstr("alignment with the capture"));
  EXPECT_THAT(refusal(capture, noisy_answers({seen.begin(), seen.begin() + 9}, 0)),
              HasSubstr("test: tracked frames: found 9"));
}

class ScoreAgainstCaptureLong : public CommandTest {};

trajectories::Trajectory hand_movement(const std::string& name, std::vector<HandFrame> frames) {
  trajectories::Trajectory movement;
  movement.name = name;
  movement.frames = std::move(frames);
  return movement;
}

TEST_F(ScoreAgainstCaptureLong, FindsTheClockAndFrameOfARenderedRecording) {
  write_trajectory(hand_movement("seen", frames_of_hand(kStart_s, 30, 75)), path("seen.json"));
  render_recording("seen.json", "dump");
  const HandModel hand = HandModel::load(hand_mesh_path());
  write_file(path("markers.csv"),
             csv_markers(trajectories::captured(hand_movement("markers", frames_of_hand(0, 100, 400)), hand,
                                                trajectories::webxr_names(), {.noise = 0.0005})));
  const auto score = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "score", "--source", "fakenect:" + path("dump"), "--truth", path("markers.csv"), "-o", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  const ProgramRun run = score({"--method", "articulated", "--database", "DB_open_power"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("errors do not include a constant offset"));
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("75 of 75 frames lie in the capture."), HasSubstr("residual of its markers")));
  const json results = json::parse(read_file(path("out/results.json")));
  const json alignment = results.at("configuration").at("score").at("alignment");
  const auto T = alignment.at("camera_capture").get<std::vector<double>>();
  expect_aligned(alignment.at("start_in_capture_ms").get<double>() / 1000,
                 Eigen::Translation3d(T[0], T[1], T[2]) * Eigen::Quaterniond(T[3], T[4], T[5], T[6]).normalized());
  EXPECT_LT(results.at("experiments").at(0).at("aggregates").at("position_error_mm").at("mean").get<double>(), 1);
  EXPECT_THAT(read_file(path("out/summary.md")), HasSubstr("errors do not include a constant offset"));

  EXPECT_THAT(refusal(score({"--time-offset", "3"})), HasSubstr("--time-offset does not go with --source"));
  EXPECT_THAT(refusal(score({"--estimates", path("markers.csv")})), HasSubstr("one of these flags"));
  EXPECT_THAT(refusal(run_glovebench({"score", "--truth", "Tr4", "-o", path("none")})), HasSubstr("found none"));
}

}  // namespace
}  // namespace glovebench::eval
