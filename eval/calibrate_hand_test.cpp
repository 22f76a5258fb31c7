// Hands of persons, from the recording to the tracker.
#include "core/hand/hand_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "core/base/math.h"
#include "eval/command_test.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A hand that opens and closes, and turns, by so much.
json moving_hand(const std::string& name, int frames, double bend_deg, double turn_deg) {
  json trajectory = make_trajectory_json(name, frames);
  for (int i = 0; i < frames; ++i) {
    json& frame = trajectory["frames"][i];
    const double bend = bend_deg * 0.5 * (1 - std::cos(0.6 * i));
    const double half = radians_from_degrees(turn_deg * std::sin(0.35 * i)) / 2;
    frame["position_mm"] = {0, 20, 680};
    // About the hand's length.
    frame["quaternion_wxyz"] = {std::sqrt(0.5) * std::cos(half), -std::sqrt(0.5) * std::cos(half),
                                std::sqrt(0.5) * std::sin(half), std::sqrt(0.5) * std::sin(half)};
    for (int finger = 0; finger < 4; ++finger) {
      frame["angles_deg"][kIndexMcpFlexion + 4 * finger] = 5 + 0.8 * bend;
      frame["angles_deg"][kIndexPipFlexion + 4 * finger] = 6 + bend;
      frame["angles_deg"][kIndexDipFlexion + 4 * finger] = 4 + 0.6 * bend;
    }
  }
  return trajectory;
}

class CalibrateHandLong : public CommandTest {
 protected:
  void record(const std::string& name, int frames, double bend_deg, double turn_deg, int subject) const {
    write_file(path(name + ".json"), moving_hand(name, frames, bend_deg, turn_deg).dump());
    expect_fine(run_glovebench({"render", "--trajectory", path(name + ".json"), "--format", "fakenect", "--subject",
                                std::to_string(subject), "-o", path(name)}));
  }
  ProgramRun calibrate(const std::string& recording, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "calibrate",       "hand",       "--source",     "fakenect:" + path(recording), "-o",
        path("mine.json"), "--database", "DB_open_power"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
};

TEST_F(CalibrateHandLong, makes_a_hand_that_tracks_better) {
  record("moving", 40, 70, 40, 2);
  const ProgramRun run = calibrate("moving", {"--report", path("report.json")});
  expect_fine(run);
  EXPECT_THAT(run.out, AllOf(HasSubstr("mine.json: a right hand of 40 frames"), HasSubstr("| scale | +"),
                             HasSubstr("shows one side of the hand")));
  const MeasuredHand hand = load_hand(path("mine.json"));
  EXPECT_NEAR(hand.shape.sizes[kScale], 1.05, 0.02);
  EXPECT_LT(hand.residual, 0.9 * hand.residual_before) << "poses fitted as often to the hand of the mesh";
  const json report = json::parse(read_file(path("report.json")));
  EXPECT_EQ(report.at("frames"), 40);
  EXPECT_EQ(report.at("sizes").size(), size_t{kSizeCount});

  write_file(path("other.json"), moving_hand("other", 6, 50, 20).dump());
  const auto position_mm = [&](const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> flags = {"--subject", "2", "--method", "articulated"};
    flags.insert(flags.end(), more.begin(), more.end());
    const json results = run_trajectory("other.json", output, flags);
    return results.at("experiments").at(0).at("aggregates").at("position_error_mm").at("mean").get<double>();
  };
  EXPECT_LT(position_mm("with", {"--hand", path("mine.json")}), 0.4 * position_mm("without", {}));
  EXPECT_THAT(run_glovebench({"compare", path("without"), path("with")}).err,
              HasSubstr("glovebench compare --across hand"));
  const ProgramRun compared = run_glovebench({"compare", path("without"), path("with"), "--across", "hand"});
  EXPECT_EQ(compared.exit_code, 0);
  EXPECT_THAT(compared.out, HasSubstr("inputs.hand_model"));
  EXPECT_THAT(run_glovebench({"table", path("without"), path("with")}).out, HasSubstr("inputs.hand_model"));
  // The picture of a frame is of the run's hand: another one had another database.
  run_trajectory("other.json", "paper", {"--hand", path("mine.json")});
  expect_fine(run_glovebench({"explain", path("paper"), "1", "--trajectory", path("other.json")}));

  // The points lie off the mesh, but not off this person's hand.
  const auto fit = [&](std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--method", "articulated"});
    return track("moving", "DB_open_power", "estimates.jsonl", flags);
  };
  const ProgramRun without_hand = fit({});
  EXPECT_EQ(without_hand.exit_code, 0);
  EXPECT_THAT(without_hand.err, AllOf(HasSubstr("warning: "), HasSubstr("glovebench calibrate hand")));
  EXPECT_EQ(std::count(without_hand.err.begin(), without_hand.err.end(), '\n'), 1) << without_hand.err;
  expect_fine(fit({"--hand", path("mine.json")}));
  EXPECT_EQ(fit({"--quiet"}).err, without_hand.err) << "a warning, and nothing else";

  // A database of another hand is refused.
  for (const auto& [file, flags] : std::map<std::string, std::vector<std::string>>{
           {"own.glovedb", {"--hand", path("mine.json")}}, {"plain.glovedb", {}}}) {
    std::vector<std::string> build = {"db", "build", "--postures", "DB_open_power", "-o", path(file)};
    build.insert(build.end(), flags.begin(), flags.end());
    expect_fine(run_glovebench(build));
  }
  const auto track_with = [&](const std::string& database) {
    return track("moving", path(database), "estimates.jsonl", {"--hand", path("mine.json"), "--frames", "2"});
  };
  expect_fine(track_with("own.glovedb"));
  EXPECT_THAT(refusal(track_with("plain.glovedb")),
              AllOf(HasSubstr("plain.glovedb: hash of its inputs"), HasSubstr("this hand")));
}

TEST_F(CalibrateHandLong, refuses_a_recording_that_does_not_show_the_hand) {
  record("short", 12, 70, 40, 1);
  EXPECT_THAT(refusal(calibrate("short")), HasSubstr("short: tracked frames: found 12, expected at least 30"));
  record("still", 32, 5, 40, 1);
  EXPECT_THAT(refusal(calibrate("still")), HasSubstr("still: movement of the fingers: found"));
  record("unturned", 32, 70, 5, 1);
  EXPECT_THAT(refusal(calibrate("unturned")), HasSubstr("unturned: turn of the hand: found"));
  EXPECT_FALSE(fs::exists(path("mine.json")));

  // These recordings are of the mesh's own hand.
  const ProgramRun tracked = track("unturned", "DB_open_power", "estimates.jsonl", {"--method", "articulated"});
  expect_fine(tracked);
  EXPECT_THAT(tracked.out, testing::Not(HasSubstr("calibrate hand")));
}

TEST_F(CalibrateHandLong, refuses_a_file_that_is_no_hand_of_the_tracker) {
  const auto refused = [&](const MeasuredHand& hand, const std::string& key = "", const json& value = {}) {
    json file = json::parse(to_json(hand).dump());
    if (!key.empty()) file[key] = value;
    write_file(path("hand.json"), file.dump());
    return refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o",
                                   path("out"), "--hand", path("hand.json")}));
  };
  MeasuredHand hand;
  hand.views = 1;
  EXPECT_THAT(refused(hand, "version", 1), HasSubstr("hand.json: version: found 1"));
  EXPECT_THAT(refused(hand, "mesh_hash", "0"), HasSubstr("hand.json: mesh_hash: found"));
  hand.side = Side::left;
  EXPECT_THAT(refused(hand), HasSubstr("hand.json: side: found left, expected right"));
  EXPECT_THAT(refusal(calibrate("nothing")), HasSubstr("nothing"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--report", path("report.txt")})), HasSubstr("the ending .json"));
  EXPECT_THAT(refusal(calibrate("nothing", {"--frames", "5"})), HasSubstr("--frames"));
  EXPECT_THAT(refusal(run_glovebench({"run", "fig8", "--quick", "--hand", path("hand.json")})),
              HasSubstr("--hand"));
}

}  // namespace
}  // namespace glovebench::eval
