#include "eval/score.h"

#include <gmock/gmock.h>

#include "core/base/random.h"
#include "core/test_error.h"
#include "eval/command_test.h"
#include "eval/estimates/example_estimates.h"
#include "eval/measured_run.h"
#include "eval/program.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using reports::FrameRecord;
using testing::HasSubstr;

/// Files have six decimals at least.
constexpr double kPrinted = 1e-4;

JointOrder order_named(const std::string& name) { return load_joint_order(name); }

/// Scores texts against some frames of Tr4.
class ScoreOfText : public testing::Test {
 protected:
  static constexpr int kFirst = 30, kFrames = 20;

  static Workbench& workbench() {
    static Workbench shared(test_workbench());
    return shared;
  }
  ScoreOfText() : folder_(test_folder()) {
    request_.spec.trajectory = std::make_shared<const trajectories::Trajectory>(
        trajectories::source_trajectory(trajectory_folder(), "Tr4"));
    request_.spec.frames = {kFirst, kFrames};
    request_.spec.database = "theirs";
  }
  std::span<const HandFrame> frames() const { return frames_of(request_.spec); }
  render::Subject subject() const { return workbench().subject(1); }

  Score score_text(const std::string& name, const std::string& text) {
    request_.estimates = folder_ + "/" + name;
    write_file(request_.estimates, text);
    return score(workbench(), request_);
  }
  std::vector<FrameRecord> records(const std::string& name, const std::string& text) {
    std::vector<FrameRecord> records;
    const std::vector<MeasuredRun> runs = measure(workbench(), score_text(name, text).runs);
    for (const reports::FrameErrors& errors : runs.front().errors) records.push_back(errors.record);
    return records;
  }
  std::string warning_of(const std::string& name, const std::string& text) {
    const json warnings = score_text(name, text).plan.score.at("warnings");
    return warnings.empty() ? "" : warnings[0].get<std::string>();
  }
  std::string error_of(const std::string& name, const std::string& text) {
    return thrown_by([&] { score_text(name, text); });
  }

  std::string folder_;
  ScoreRequest request_;
};

void expect_no_errors(const std::vector<FrameRecord>& records, int metrics) {
  ASSERT_FALSE(records.empty());
  for (const FrameRecord& record : records) {
    ASSERT_EQ(record.status, TrackStatus::tracked);
    int given = 0;
    for (const reports::Metric& metric : reports::frame_metrics()) {
      if (!metric.of_tracked || metric.is_partial || !record[metric.key]) continue;
      ++given;
      EXPECT_NEAR(*record[metric.key], 0, kPrinted) << metric.key;
    }
    EXPECT_EQ(given, metrics);
  }
}

void expect_all_usable(const std::vector<FrameRecord>& records) {
  EXPECT_EQ(reports::count_coverage({{1, records}}).usable_share(), 1);
}

constexpr int kMetricsOfAHand = 15, kMetricsOfJoints = 6;

TEST_F(ScoreOfText, TheTruthItselfHasNoErrorsAndIsUsable) {
  for (const auto& [name, text] :
       {std::pair("run.csv", run_text(frames())), {"track.jsonl", track_text(frames())}}) {
    const std::vector<FrameRecord> found = records(name, text);
    expect_no_errors(found, kMetricsOfAHand);
    expect_all_usable(found);
  }
}

TEST_F(ScoreOfText, PosesWithAnglesBesideThemAreAHand) {
  request_.beside = folder_ + "/angles.csv";
  write_file(request_.beside, angles_text(frames()));
  const std::vector<FrameRecord> found = records("poses.tum", tum_text(frames()));
  expect_no_errors(found, kMetricsOfAHand);
  expect_all_usable(found);
  request_.beside.clear();
  expect_no_errors(records("poses.tum", tum_text(frames())), 2);
  expect_no_errors(records("angles.csv", angles_text(frames(), "rad", radians_from_degrees(1))), 4);
}

TEST_F(ScoreOfText, JointsOfEachOrderHaveNoErrors) {
  request_.spec.frames = {kFirst, 5};
  for (const JointOrder& order : joint_orders()) {
    const bool has_tips = order.name != "mano16";
    const int metrics = has_tips ? kMetricsOfJoints : kMetricsOfJoints - 1;
    request_.flags = {};
    expect_no_errors(records(order.name + ".json", joints_text(frames(), subject(), order)), metrics);
    request_.flags = {order, "", "camera", ""};
    expect_no_errors(records(order.name + ".csv", joint_columns_text(frames(), subject(), order)), metrics);
  }
}

TEST_F(ScoreOfText, JointsWithJoinedPosesAreUsable) {
  request_.beside = folder_ + "/joints.json";
  write_file(request_.beside, joints_text(frames(), subject(), order_named("mediapipe")));
  const std::vector<FrameRecord> found = records("poses.tum", tum_text(frames()));
  expect_no_errors(found, kMetricsOfJoints + 2);
  expect_all_usable(found);
}

TEST_F(ScoreOfText, JointsWithoutPlaceHaveNoAbsoluteErrors) {
  const auto to_hand = [](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p - Eigen::Vector3d(0.1, 2, 0.5); };
  const std::string text = joints_text(frames(), subject(), order_named("mediapipe"), to_hand, "wrist");
  expect_no_errors(records("wrist.json", text), 3);
  EXPECT_EQ(warning_of("wrist.json", text), "");
}

TEST_F(ScoreOfText, AMapNamesTheJointsOfAnyProgram) {
  request_.flags.order = parse_joint_map(
      R"({"format": "glovebench-joint-map", "version": 1, "joints": {"W": "wrist", "T": "thumb-tip",
          "I": "index-finger-tip", "M": "middle-finger-phalanx-proximal", "extra": null}})",
      "map.json");
  JointOrder named = request_.flags.order;
  expect_no_errors(records("mine.json", joints_text(frames(), subject(), named)), 4);
}

TEST_F(ScoreOfText, FramesWithoutAnEstimateAreMissing) {
  const std::vector<FrameRecord> found = records("run.csv", run_text(frames().subspan(3, 10)));
  EXPECT_EQ(std::ranges::count(found, TrackStatus::missing, &FrameRecord::status), kFrames - 10);
  EXPECT_EQ(reports::count_coverage({{1, found}}).usable_share(), 0.5);
}

TEST_F(ScoreOfText, TimesMatchWithinTheTolerance) {
  std::vector<HandFrame> late(frames().begin(), frames().end());
  for (HandFrame& frame : late) frame.timestamp_us += 20'000;
  const Score near = score_text("run.csv", run_text(late));
  EXPECT_EQ(near.plan.association, "by time stamp, nearest within 33.333 ms");
  request_.tolerance_ms = 10;
  EXPECT_THAT(error_of("run.csv", run_text(late)), HasSubstr("time stamps: found "));
  request_.offset_ms = -20;
  EXPECT_EQ(score_text("run.csv", run_text(late)).plan.association, "by time stamp, exact");
}

TEST_F(ScoreOfText, ATimeOffsetIsEstimatedWithItsInterval) {
  request_.spec.frames = {0, 60};
  for (const int64_t shift_us : {850'000L, 73'000L, 900'000'000'000L}) {
    std::vector<HandFrame> late(frames().begin(), frames().end());
    for (HandFrame& frame : late) frame.timestamp_us += shift_us;
    request_.estimates_offset = true;
    const Score found = score_text("run.csv", run_text(late));
    constexpr double kFewMs = 3;  // of 67 between frames
    EXPECT_NEAR(found.plan.score.at("offsets_ms").at(0).get<double>(), -static_cast<double>(shift_us) / 1000,
                kFewMs);
    EXPECT_THAT(found.matches.front(), HasSubstr("95% interval"));
    request_.estimates_offset = false;
  }
}

/// Position noise of 5 mm, 3 degrees of rotation and angles.
std::vector<HandFrame> with_noise(std::span<const HandFrame> frames) {
  std::vector<HandFrame> noisy(frames.begin(), frames.end());
  RandomStream random(1, "score_test", 0, "noise");
  for (HandFrame& frame : noisy) {
    for (double& angle : frame.posture) angle += radians_from_degrees(3 * random.normal());
    frame.T_camera_hand.rotate(
        Eigen::AngleAxisd(radians_from_degrees(3 * random.normal()), Eigen::Vector3d::UnitX()));
    frame.T_camera_hand.pretranslate(0.005 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  }
  return noisy;
}

TEST_F(ScoreOfText, TheTruthAndNoiseAreNoMistakes) {
  for (const std::vector<HandFrame>& fine :
       {std::vector<HandFrame>(frames().begin(), frames().end()), with_noise(frames())}) {
    EXPECT_EQ(warning_of("run.csv", run_text(fine)), "");
    EXPECT_EQ(warning_of("poses.tum", tum_text(fine)), "");
    EXPECT_EQ(warning_of("angles.csv", angles_text(fine)), "");
    EXPECT_EQ(warning_of("joints.json", joints_text(fine, subject(), order_named("mediapipe"))), "");
  }
}

TEST_F(ScoreOfText, PlantedMistakesOfJointsAreNamed) {
  using Eigen::Vector3d;
  const std::vector<HandFrame> noisy = with_noise(frames());
  const std::vector<std::pair<Move, const char*>> planted = {
      {[](const Vector3d& p) { return Vector3d(p.x(), -p.y(), -p.z()); }, "x, y, z should be x, -y, -z"},
      {[](const Vector3d& p) { return Vector3d(p.z(), p.x(), p.y()); }, "x, y, z should be y, z, x"},
      {[](const Vector3d& p) { return Vector3d(-p.x(), p.y(), p.z()); }, "x, y, z should be -x, y, z"},
      {[](const Vector3d& p) -> Vector3d { return p / 1000; }, "1000 times too small, as meters"},
      {[](const Vector3d& p) -> Vector3d { return 1000 * p; }, "1000 times too large, as millimeters"},
      {[](const Vector3d& p) -> Vector3d { return p + Vector3d(0, 0.08, 0); },
       "off by \\(-?[0-3], (7[7-9]|8[0-3]), "}};
  for (const auto& [move, sentence] : planted)
    EXPECT_THAT(warning_of("joints.json", joints_text(noisy, subject(), order_named("mediapipe"), move)),
                testing::ContainsRegex(sentence));
  json renamed = json::parse(joints_text(noisy, subject(), order_named("mano21")));
  renamed["order"] = "mediapipe";
  EXPECT_THAT(warning_of("joints.json", renamed.dump()), HasSubstr("in the order of mano21"));
}

TEST_F(ScoreOfText, AMirroredHandIsNamed) {
  json mirrored = json::parse(joints_text(frames(), subject(), order_named("webxr")));
  for (size_t f = 0; f < mirrored["frames"].size(); ++f) {
    const Eigen::Isometry3d T = frames()[f].T_camera_hand;
    for (json& point : mirrored["frames"][f]["joints_m"]) {
      Eigen::Vector3d p = T.inverse() * Eigen::Vector3d(point[0], point[1], point[2]);
      p.x() *= -1;
      p = T * p;
      point = {p.x(), p.y(), p.z()};
    }
  }
  EXPECT_THAT(warning_of("joints.json", mirrored.dump()), HasSubstr("the hand is mirrored"));
}

TEST_F(ScoreOfText, PlantedMistakesOfPosesAndAnglesAreNamed) {
  const std::vector<HandFrame> noisy = with_noise(frames());
  EXPECT_THAT(warning_of("poses.tum", tum_text(noisy, true)), HasSubstr("quaternions are in the order w, x, y, z"));
  EXPECT_THAT(warning_of("angles.csv", angles_text(noisy, "rad")), HasSubstr("degrees read as radians"));
  EXPECT_THAT(warning_of("angles.csv", angles_text(noisy, "deg", radians_from_degrees(1))),
              HasSubstr("radians read as degrees"));
}

TEST_F(ScoreOfText, ALagIsNamed) {
  request_.spec.frames = {0, {}};
  const std::vector<HandFrame> noisy = with_noise(frames());
  std::vector<HandFrame> late = noisy;
  for (size_t f = 6; f < late.size(); ++f) {
    late[f].posture = noisy[f - 6].posture;
    late[f].T_camera_hand = noisy[f - 6].T_camera_hand;
  }
  EXPECT_THAT(warning_of("run.csv", run_text(late)), HasSubstr("lag by 6 frames (400 ms"));
}

TEST_F(ScoreOfText, ErrorsNameTheFlagThatWouldHelp) {
  const std::string columns = joint_columns_text(frames(), subject(), order_named("mediapipe"));
  EXPECT_THAT(error_of("j.csv", columns), HasSubstr("or --joints with the order"));
  request_.flags.order = order_named("mediapipe");
  EXPECT_THAT(error_of("j.csv", columns),
              HasSubstr("frame of the joints: found nothing, expected camera, wrist in the "
                        "file or by --frame"));
  request_.flags.frame = "camera";
  std::string without_units = columns;
  while (without_units.find("_mm") != std::string::npos) without_units.erase(without_units.find("_mm"), 3);
  EXPECT_THAT(error_of("j.csv", without_units), HasSubstr("by --units"));
  request_.flags.units = "m";
  EXPECT_THAT(error_of("j.csv", columns), HasSubstr("found mm, expected m, as --units says"));
  EXPECT_THAT(warning_of("j.csv", without_units), HasSubstr("1000 times too large, as millimeters read as meters"));
  request_.flags = {order_named("mediapipe"), "", "", ""};
  EXPECT_THAT(error_of("poses.tum", tum_text(frames())), HasSubstr("found no joints"));
  request_.flags = {{}, "", "wrist", ""};
  EXPECT_THAT(error_of("poses.tum", tum_text(frames())), HasSubstr("found no joints"));
  request_.flags = {};
  json joints = json::parse(joints_text(frames(), subject(), order_named("mediapipe")));
  joints.erase("order");
  EXPECT_THAT(error_of("j.json", joints.dump()), HasSubstr("or --joints with a name or a map"));
  joints["order"] = "mediapipe";
  joints["frames"][1]["joints_m"][3] = nullptr;
  EXPECT_THAT(error_of("j.json", joints.dump()),
              HasSubstr("frames[1].joints_m: found 20 joints, expected those of"));
  EXPECT_THAT(error_of("x.bin", "?"), HasSubstr("--format with one of columns, joints, run, track, tum"));
}

class ScoreLong : public CommandTest {};

TEST_F(ScoreLong, OfARunsEstimatesEqualsTheRun) {
  const json run = run_trajectory("good.json", "run");
  const std::string estimates = path("run") + "/estimates/good_DB_open_power_source_subject1_gradient_1.csv";
  const ProgramRun scored = run_glovebench({"score", "--truth", path("good.json"), "--estimates", estimates,
                                            "--name", "DB_open_power", "-o", path("score")});
  expect_fine(scored);
  EXPECT_THAT(scored.out, HasSubstr("4 of 4 frames have an estimate.\n"));
  const json own = json::parse(read_file(path("score") + "/results.json"));
  const json &before = run["experiments"][0]["runs"][0]["frames"],
             &after = own["experiments"][0]["runs"][0]["frames"];
  ASSERT_EQ(before.size(), after.size());
  const std::vector<std::string> columns = run["frame_columns"];
  // The file has six decimals of a millimeter and of a degree.
  constexpr double kWritten = 1e-5;
  int compared = 0;
  for (size_t f = 0; f < before.size(); ++f) {
    for (size_t c = 0; c < columns.size(); ++c) {
      if (columns[c] == "converged" || columns[c] == "ambiguous" || columns[c] == "icp_iterations") continue;
      if (after[f][c].is_null()) continue;
      ++compared;
      if (before[f][c].is_number())
        EXPECT_NEAR(before[f][c].get<double>(), after[f][c].get<double>(), kWritten) << columns[c];
      else
        EXPECT_EQ(before[f][c], after[f][c]) << columns[c];
    }
    for (const char* internal : {"icp_residual_mm", "matching_error_px", "posture_rms_unfiltered_deg"})
      EXPECT_TRUE(after[f][std::ranges::find(columns, internal) - columns.begin()].is_null()) << internal;
  }
  EXPECT_GT(compared, 4 * 20);
  EXPECT_EQ(run["experiments"][0]["coverage"], own["experiments"][0]["coverage"]);
  const std::string table = read_file(path("run") + "/tables/errors.tex");
  EXPECT_EQ(table.substr(table.find('\n')), [&] {
    const std::string other = read_file(path("score") + "/tables/errors.tex");
    return other.substr(other.find('\n'));
  }());
}

TEST_F(ScoreLong, AreComparedAndGatedAndNotExplained) {
  auto truth = trajectories::parse_trajectory(read_file(path("good.json")), "good.json");
  write_file(path("a.csv"), run_text(truth.frames));
  for (const char* output : {"one", "two"})
    expect_fine(run_glovebench({"score", "--truth", path("good.json"), "--estimates", path("a.csv"), "--name",
                                "theirs", "-o", path(output), "-q"}));
  EXPECT_EQ(run_glovebench({"compare", path("one"), path("two")}).exit_code, 0);
  EXPECT_EQ(run_glovebench({"gate", path("one"), "--baseline", path("base"), "--update"}).exit_code, 0);
  EXPECT_EQ(run_glovebench({"gate", path("two"), "--baseline", path("base")}).exit_code, 0);
  for (HandFrame& frame : truth.frames) frame.T_camera_hand.pretranslate(Eigen::Vector3d(0.005, 0, 0));
  write_file(path("worse.csv"), run_text(truth.frames));
  expect_fine(run_glovebench({"score", "--truth", path("good.json"), "--estimates", path("worse.csv"), "--name",
                              "theirs", "-o", path("worse"), "-q"}));
  EXPECT_EQ(run_glovebench({"gate", path("worse"), "--baseline", path("base")}).exit_code, 1);
  EXPECT_THAT(refusal(run_glovebench({"explain", path("one"), "0", "--trajectory", path("good.json")})),
              HasSubstr("a run of a tracker"));
}

}  // namespace
}  // namespace glovebench::eval
