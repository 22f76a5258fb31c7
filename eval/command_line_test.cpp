// Bad input gives one clear line on stderr and exit code 2, and leaves earlier results untouched.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "ci/build_paths.h"
#include "core/base/file_set.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Returns the one line of a refusal; fails the test if the program does anything else.
std::string refusal(const std::vector<std::string>& arguments, const ProgramSetting& setting = {}) {
  const ProgramRun run = run_glovebench(arguments, setting);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, testing::StartsWith("glovebench: "));
  EXPECT_THAT(run.err, testing::EndsWith("\n"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_THAT(run.err, testing::Not(HasSubstr("internal error")));
  return run.err;
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test_folder();
    output_ = path("out");
    WholeFiles files(output_);
    files.add("results.json", "earlier");
    files.commit();
    earlier_ = read_folder(output_);
  }
  void TearDown() override {
    EXPECT_EQ(read_folder(output_), earlier_) << "earlier results are untouched";
    fs::remove_all(folder_);
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string write(const std::string& name, const json& content) const {
    write_file(path(name), content.dump());
    return path(name);
  }
  /// `run` of a trajectory file, with more arguments.
  std::vector<std::string> run_of(const std::string& trajectory, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run",           "--trajectory", trajectory, "--database",
                                          "DB_open_power", "--output",     output_,    "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::string good_trajectory() const { return write("good.json", make_trajectory_json("good", 2)); }
  std::string refused_configuration(const json& configuration) const {
    return refusal(run_of(good_trajectory(), {"--config", write("config.json", configuration)}));
  }

  std::string folder_, output_;
  std::map<std::string, std::string> earlier_;
};

TEST_F(CommandLine, MissingOrUnknownWords) {
  EXPECT_THAT(refusal(std::vector<std::string>{}), HasSubstr("A command is required"));
  EXPECT_THAT(refusal({"--bogus"}), HasSubstr("--bogus"));
  EXPECT_THAT(refusal({"bogus"}), HasSubstr("bogus"));
  EXPECT_THAT(refusal({"run", "--bogus"}), HasSubstr("--bogus"));
  EXPECT_THAT(refusal({"track", "--databse", "x"}),
              HasSubstr("did you mean --database? (see glovebench track --help)"));
  EXPECT_THAT(refusal({"list", "metric"}), HasSubstr("did you mean metrics? (see glovebench list --help)"));
  EXPECT_THAT(refusal({"db"}), HasSubstr("A command is required"));
  EXPECT_THAT(refusal({"run", "--trajectory", "Tr4", "--database", "DB_open_power"}), HasSubstr("--output"));
}

TEST_F(CommandLine, EndsLikeOtherProgramsIfNobodyReadsOn) {
  constexpr int kBySigpipe = 128 + 13;  // as a shell counts
  EXPECT_EQ(run_glovebench({"list", "metrics"}, {.unheard = true}).exit_code, kBySigpipe);
}

TEST_F(CommandLine, FlagsOutOfRange) {
  const std::string trajectory = good_trajectory();
  EXPECT_THAT(refusal(run_of(trajectory, {"--seed", "-1"})), HasSubstr("--seed"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--seed", "18446744073709551615", "--seeds", "2"})),
              HasSubstr("--seed: value: found 18446744073709551615, expected at most 18446744073709551614"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--threads", "5000"})), HasSubstr("--threads"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--subject", "23"})),
              AllOf(HasSubstr("--subject"), HasSubstr("found 23, expected a number from 1 to 22")));
  EXPECT_THAT(refusal(run_of(trajectory, {"--noise", "loud"})), HasSubstr("--noise"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--gain", "-1"})), HasSubstr("--gain"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--gain", "nan"})), HasSubstr("--gain"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--seeds", "0"})), HasSubstr("--seeds"));
  EXPECT_THAT(refusal(run_of(trajectory, {"--profile", "none"})), AllOf(HasSubstr("none"), HasSubstr("paper")));
  EXPECT_THAT(refusal({"reproduce", "-o", output_, "--trajectory", "Tr9"}), HasSubstr("Tr9"));
}

TEST_F(CommandLine, StandardOutputIsNoFileWhereSomethingElseIsPrinted) {
  const std::vector<std::vector<std::string>> commands = {
      {"run", "--suite", "quick", "-o", "-"},
      {"run", "--suite", "quick", "-o", "out", "--robot-out", "-"},
      {"reproduce", "-o", "-"},
      {"reproduce", "--robot-out", "-"},
      {"render", "--trajectory", "Tr4", "-o", "-"},
      {"record", "--trajectory", "Tr4", "--database", "DB_open_power", "-o", "-"},
      {"generate", "--family", "side", "-o", "-"},
      {"explain", ".", "0", "-o", "-"},
      {"db", "build", "--postures", "DB_open_power", "-o", "-"},
      {"compare", ".", ".", "-o", "-"},
      {"gate", ".", "-o", "-"},
      {"gate", ".", "--baseline", "-", "--update"},
      {"calibrate", "noise", "--suite", "quick", "-o", "-"},
      {"calibrate", "cameras", "--ir", "a", "--rgb", "b", "-o", "-"},
      {"calibrate", "colors", "--source", "fakenect:a", "-o", "-"},
      {"robot-server", "keys", "-"},
      {"robot-server", "run", "--hand", "--robot", "dds", "--log", "-"}};
  for (const std::vector<std::string>& command : commands)
    EXPECT_THAT(refusal(command), HasSubstr("found -, expected the name of a file or folder")) << command[0];
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST_F(CommandLine, OneFileIsNotWrittenTwice) {
  fs::create_symlink("x.jsonl", path("link.jsonl"));
  const auto track = [&](const std::string& output, const std::string& robot) {
    return refusal(
        {"track", "--source", "fakenect:none", "--database", "DB_open_power", "-o", output, "--robot-out", robot});
  };
  for (const char* other : {"x.jsonl", "./x.jsonl", "link.jsonl", "x.jsonl.partial", "x.jsonl.partial-2"}) {
    const std::string expected = "expected another than that of --output";
    EXPECT_THAT(track(path("x.jsonl"), path(other)),
                AllOf(HasSubstr("--robot-out: file: found"), HasSubstr(expected)));
    EXPECT_THAT(track(path(other), path("x.jsonl")), HasSubstr(expected));
  }
  EXPECT_THAT(track("-", "/dev/stdout"), HasSubstr("--robot-out: file"));
  EXPECT_THAT(track(path("x.jsonl"), path("y.jsonl")), HasSubstr("none")) << "two files may be";
  EXPECT_THAT(refusal({"calibrate", "colors", "--source", "fakenect:none", "-o", path("c.json"), "--report",
                       path("./c.json")}),
              HasSubstr("--report: file"));
  EXPECT_THAT(refusal({"calibrate", "cameras", "--ir", "none", "--rgb", "none", "-o", path("c.json"), "--report",
                       path("./c.json")}),
              HasSubstr("--report: file"));
}

TEST_F(CommandLine, WhatIsReadIsNotReplaced) {
  const std::string trajectory = good_trajectory(), movement = read_file(trajectory);
  EXPECT_THAT(refusal({"record", "--trajectory", trajectory, "--database", "DB_open_power", "-o",
                       path("./" + fs::path(trajectory).filename().string())}),
              HasSubstr("--output: file"));
  EXPECT_EQ(read_file(trajectory), movement);
  write_file(path("in.json"), "{}");
  EXPECT_THAT(refusal({"import", "markers", path("in.json"), "--format", "handpose", "-o", path("./in.json")}),
              HasSubstr("--output: file: found"));
}

TEST_F(CommandLine, NamesThatDoNotExist) {
  EXPECT_THAT(refusal({"list", "config", "mood"}), HasSubstr("found mood"));
  EXPECT_THAT(refusal(run_of("Tr9")), AllOf(HasSubstr("Tr9"), HasSubstr("Tr5")));
  EXPECT_THAT(refusal({"run", "--trajectory", good_trajectory(), "--database", "DB_none", "-o", output_}),
              AllOf(HasSubstr("DB_none"), HasSubstr("DB_open_power")));
  EXPECT_THAT(refusal(run_of("Tr9")), Not(HasSubstr("share/glovebench"))) << "the installation's path says nothing";
  EXPECT_THAT(refusal({"run", "--trajectory", "Tr4", "--database", "DB_20_posture", "-o", output_}),
              HasSubstr("databases: name: found \"DB_20_posture\", expected one of DB_20_postures, DB_open"));
  EXPECT_THAT(refusal(run_of("Tr9")),
              AllOf(HasSubstr("a movement of a family as side_3 (`glovebench list families`)"),
                    HasSubstr("or a file (*.json)")));
  EXPECT_THAT(refusal(run_of("sied_3")), HasSubstr("; did you mean side_3?"));
  EXPECT_THAT(refusal({"run", "fig10", "-o", output_}), HasSubstr("expected one of fig7"));
  EXPECT_EQ(refusal({"run", "fig8", "--dry-run"}), "glovebench: run fig8: --dry-run does not go with a study\n");
  EXPECT_EQ(refusal({"run", "limits", "--profile", "paper"}),
            "glovebench: run limits: --profile does not go with this study, which has its own settings\n");
  EXPECT_THAT(refusal({"run", "--suite", "quik", "-o", output_}), HasSubstr("; did you mean quick?"));
  EXPECT_THAT(refusal({"explain", path("nothing"), "3"}), HasSubstr("nothing"));
  EXPECT_THAT(refusal({"explain", folder_, "3"}), HasSubstr("found a folder of runs, expected one of " + output_));
  fs::create_directory(path("empty"));
  EXPECT_THAT(refusal({"explain", path("empty"), "3"}), HasSubstr("results.json"));
  EXPECT_THAT(refusal({"db", "info", path("none.glovedb")}), HasSubstr("none.glovedb"));
  EXPECT_THAT(refusal({"db", "build", "--postures", path("none.csv"), "-o", path("x.glovedb")}),
              HasSubstr("none.csv"));
  EXPECT_THAT(refusal({"track", "--source", "live", "--database", "DB_open_power", "-o", path("x.jsonl")}),
              HasSubstr("fakenect:FOLDER"));
  EXPECT_THAT(refusal({"track", "--source", "fakenect:" + path("none"), "--database", "DB_open_power", "-o",
                       path("x.jsonl")}),
              HasSubstr("none"));
  EXPECT_THAT(refusal({"track", "--source", "fakenect:" + folder_, "--database", "DB_open_power", "-o",
                       path("x.jsonl"), "--calibration", path("none.json")}),
              HasSubstr("none.json"));
  EXPECT_THAT(refusal({"track", "--source", "fakenect:" + folder_, "--database", "DB_open_power", "-o",
                       path("x.jsonl"), "--frames", "-1"}),
              HasSubstr("--frames"));
  EXPECT_THAT(
      refusal({"track", "--source", "fakenect:" + folder_, "--database", "DB_open_power", "-o", path("x.cvs")}),
      HasSubstr("--output: file name: found"));
  EXPECT_THAT(refusal({"track", "--source", "fakenect:" + folder_, "--database", "DB_open_power", "-o",
                       path("x.jsonl"), "--page", path("x.pdf")}),
              HasSubstr("--page: file name: found"));
  EXPECT_THAT(refusal({"record", "--trajectory", good_trajectory(), "-o", path("x.json")}),
              HasSubstr("--database"));
  EXPECT_THAT(refusal({"record", "--trajectory", "Tr4", "--database", "DB_open_power", "-o", path("x")}),
              AllOf(HasSubstr("--output"), HasSubstr("the ending .json")));
}

TEST_F(CommandLine, MissingTrajectoryFile) {
  EXPECT_THAT(refusal(run_of(path("none.json"))), AllOf(HasSubstr("none.json"), HasSubstr("No such file")));
}

TEST_F(CommandLine, TrajectoriesThatCannotBe) {
  const auto refused = [&](const auto& damage) {
    json trajectory = make_trajectory_json("bad", 4);
    damage(trajectory["frames"][2]);
    const std::string line = refusal(run_of(write("bad.json", trajectory)));
    EXPECT_THAT(line, HasSubstr("bad.json: frames[2]."));
    return line;
  };
  EXPECT_THAT(refused([](json& f) { f["angles_deg"][7] = std::nan(""); }), HasSubstr("angles_deg[7]"));
  EXPECT_THAT(refused([](json& f) { f["angles_deg"].erase(0); }),
              AllOf(HasSubstr("angles_deg"), HasSubstr("21"), HasSubstr("22")));
  EXPECT_THAT(refused([](json& f) { f["angles_deg"][7] = 300; }),
              AllOf(HasSubstr("angles_deg[7]"), HasSubstr("300"), HasSubstr("-45..100")));
  EXPECT_THAT(refused([](json& f) { f["timestamp_us"] = 66667; }), HasSubstr("timestamp_us: found 66667"));
  EXPECT_THAT(refused([](json& f) { f["timestamp_us"] = 5; }), HasSubstr("timestamp_us: found 5"));
  EXPECT_THAT(refused([](json& f) {
                f["quaternion_wxyz"] = {1, 1, 0, 0};
              }),
              AllOf(HasSubstr("quaternion_wxyz"), HasSubstr("length 1")));
  EXPECT_THAT(refused([](json& f) { f["position_mm"] = "here"; }), HasSubstr("position_mm"));
}

TEST_F(CommandLine, TrajectoryThatIsNoJson) {
  std::string text = make_trajectory_json("bad", 2).dump();
  text.replace(text.find("700"), 3, "NaN");
  write_file(path("nan.json"), text);
  EXPECT_THAT(refusal(run_of(path("nan.json"))), AllOf(HasSubstr("nan.json"), HasSubstr("expected JSON")));
}

TEST_F(CommandLine, ConfigurationsThatCannotBe) {
  EXPECT_THAT(refused_configuration({{"bogus", 1}}), AllOf(HasSubstr("config.json"), HasSubstr("bogus")));
  EXPECT_THAT(refused_configuration({{"volume", {{"z_near_m", 1}}}}),
              AllOf(HasSubstr("config.json"), HasSubstr("z_near_m")));
  EXPECT_THAT(refused_configuration({{"volume", {{"z_min_m", 2}}}}),
              AllOf(HasSubstr("config.json"), HasSubstr("z_min_m"), HasSubstr("z_max_m")));
  EXPECT_THAT(refused_configuration({{"lookup", {{"cascade", "16:3,64:500"}}}}),
              AllOf(HasSubstr("config.json"), HasSubstr("64:500")));
  EXPECT_THAT(refused_configuration({{"icp", {{"max_points", "many"}}}}), HasSubstr("max_points"));
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--method", "best"})),
              AllOf(HasSubstr("best"), HasSubstr("schroeder2012")));
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--cascade", "16:3,64:500"})), HasSubstr("64:500"));
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--cascade", "some"})), HasSubstr("SIZE:KEEP"));
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--config", path("none.json")})), HasSubstr("none.json"));
  write_file(path("broken.json"), "{\"volume\":");
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--config", path("broken.json")})), HasSubstr("broken.json"));
}

TEST_F(CommandLine, MissingOrAlteredMesh) {
  const fs::path share =
      fs::path(build_paths::program("glovebench")).parent_path().parent_path() / "share" / "glovebench";
  const std::string copy = path("share");
  fs::create_directories(copy);
  fs::create_directory_symlink(fs::canonical(share / "trajectories"), copy + "/trajectories");
  const ProgramSetting setting{.environment = {{"GLOVEBENCH_SHARE", copy}}};
  EXPECT_THAT(refusal(run_of(good_trajectory()), setting), HasSubstr("generic-hand-right.glb"));

  std::string mesh = read_file((share / "generic-hand-right.glb").string());
  mesh[mesh.size() / 2] ^= 1;
  write_file(copy + "/generic-hand-right.glb", mesh);
  EXPECT_THAT(refusal(run_of(good_trajectory()), setting),
              AllOf(HasSubstr("generic-hand-right.glb"), HasSubstr("expected")));

  const ProgramSetting nowhere{.environment = {{"GLOVEBENCH_SHARE", path("nowhere")}}};
  EXPECT_THAT(refusal(run_of(good_trajectory()), nowhere), HasSubstr("nowhere"));
}

TEST_F(CommandLine, OutputFolderWithAFileInTheWay) {
  write_file(path("taken"), "a file");
  const std::string line = refusal({"run", "--trajectory", good_trajectory(), "--database", "DB_open_power",
                                    "--output", path("taken"), "--cache", path("cache")});
  EXPECT_THAT(line, HasSubstr("taken"));
  EXPECT_EQ(read_file(path("taken")), "a file");
  EXPECT_FALSE(fs::exists(path("cache"))) << "told before any work";
  EXPECT_THAT(refusal({"reproduce", "-o", path("taken"), "--cache", path("cache")}), HasSubstr("taken"));
}

TEST_F(CommandLine, OpenGLContextRefused) {
  const ProgramSetting old_mesa{.environment = {{"MESA_GL_VERSION_OVERRIDE", "1.1"}}};
  EXPECT_THAT(refusal({"render", "--trajectory", good_trajectory(), "-o", path("frames")}, old_mesa),
              HasSubstr("OpenGL context"));
  EXPECT_FALSE(fs::exists(path("frames")));
}

TEST_F(CommandLine, DesktopSettingsDoNotReachTheRenderer) {
  const auto frame = [&](const std::map<std::string, std::string>& environment) {
    const ProgramRun run = run_glovebench({"render", "--trajectory", good_trajectory(), "-o", path("frames")},
                                          ProgramSetting{.environment = environment});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_file(path("frames/color_0001.png"));
  };
  const std::string expected = frame({});
  for (const char* driver : {"zink", "softpipe", "none"})
    EXPECT_TRUE(frame({{"GALLIUM_DRIVER", driver}}) == expected);
  EXPECT_TRUE(frame({{"MESA_GLSL_VERSION_OVERRIDE", "110"}}) == expected);
}

TEST_F(CommandLine, NothingCountsTwice) {
  // A run counted twice would narrow its interval.
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--trajectory", good_trajectory()})),
              HasSubstr("not yet in the run"));
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--database", "DB_open_power"})), HasSubstr("not yet in the run"));
  EXPECT_THAT(refusal({"reproduce", "--trajectory", "Tr4", "--trajectory", "Tr4", "-o", path("twice")}),
              HasSubstr("each once"));
}

TEST_F(CommandLine, NumbersBeyondDoubleInAConfiguration) {
  write_file(path("huge.json"), R"({"detection": {"min_pixels": 1e400}})");
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--config", path("huge.json")})),
              AllOf(HasSubstr("huge.json"), HasSubstr("no double can hold")));
}

TEST_F(CommandLine, TrajectoriesOfBothSides) {
  json left = make_trajectory_json("left", 2);
  left["side"] = "left";
  EXPECT_THAT(refusal(run_of(good_trajectory(), {"--trajectory", write("left.json", left)})),
              AllOf(HasSubstr("left.json"), HasSubstr("side")));
}

TEST_F(CommandLine, SuiteSaysAllThatIsRun) {
  for (const char* flag : {"--trajectory", "--database", "--truth", "--noise", "--gain", "--subject"}) {
    const std::string value = flag == std::string("--truth")   ? "source"
                              : flag == std::string("--noise") ? "kinect"
                                                               : "1";
    EXPECT_THAT(refusal({"run", "--suite", "quick", flag, value, "-o", output_}),
                AllOf(HasSubstr("--suite"), HasSubstr(flag)));
  }
  EXPECT_THAT(refusal({"run", "-o", output_}), AllOf(HasSubstr("--suite"), HasSubstr("--trajectory")));
  EXPECT_THAT(refusal({"run", "--suite", "bogus", "-o", output_}), AllOf(HasSubstr("bogus"), HasSubstr("quick")));
  EXPECT_THAT(refusal({"run", "--suite", path("none.json"), "-o", output_}), HasSubstr("none.json"));
  EXPECT_THAT(refusal({"run", "--suite", "quick", "--filter", "Tr9*", "-o", output_}), HasSubstr("Tr9*"));
  EXPECT_THAT(refusal({"run", "--suite", "quick"}), HasSubstr("--output"));
}

TEST_F(CommandLine, ListsAndRehearsesARun) {
  const auto said = [](const std::vector<std::string>& arguments) {
    const ProgramRun run = run_glovebench(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  EXPECT_THAT(said({"run", "--suite", "quick", "--list"}), HasSubstr("80 frames x 2 seeds"));
  EXPECT_THAT(said({"run", "--suite", "quick", "--list", "--seeds", "3"}), HasSubstr("80 frames x 3 seeds"));
  EXPECT_THAT(said({"run", "--suite", "quick", "--dry-run", "--seed", "7"}), HasSubstr("seeds 7, 8:"));
  EXPECT_EQ(said({"run", "--trajectory", "Tr4", "--database", "DB_open_power", "--list"}),
            "Tr4_DB_open_power_source_subject1_gradient_1   117 frames x 1 seed\n");
  const std::string text = said({"run", "--suite", "quick", "--filter", "Exit*", "--dry-run", "--cache",
                                 path("cache"), "--output", path("nothing")});
  EXPECT_THAT(text, AllOf(HasSubstr("seeds 1, 2: 160 frames to track"), HasSubstr("DB_open_power: to be built"),
                          HasSubstr("report: " + path("nothing"))));
  EXPECT_THAT(said({"reproduce", "--dry-run", "--cache", path("cache"), "--output", path("nothing")}),
              AllOf(HasSubstr("Figure 8: matching cascades"), HasSubstr(" min\n"),
                    HasSubstr("databases to be built: DB_open_pinch, "), HasSubstr("report: " + path("nothing"))));
  EXPECT_FALSE(fs::exists(path("cache")));
  EXPECT_FALSE(fs::exists(path("nothing")));
}

}  // namespace
}  // namespace glovebench::eval
