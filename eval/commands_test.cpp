// Runs the commands on short trajectories and checks their files.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ci/build_paths.h"
#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/database/test_damaged_database.h"
#include "eval/command_test.h"
#include "eval/test_program.h"
#include "render/test_exr.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CommandsLong : public CommandTest {};

TEST_F(CommandsLong, LeftHandRunsFromEndToEnd) {
  const json results = run_trajectory("left.json", "out");
  const json& experiment = results.at("experiments").at(0);
  EXPECT_EQ(experiment.at("coverage").at("covered"), kFrames) << experiment.at("coverage");
}

TEST_F(CommandsLong, LeftHandWithARightDatabase) {
  expect_fine(run_glovebench({"db", "build", "--postures", "DB_open_power", "-o", path("right.glovedb")}));
  expect_fine(run_glovebench({"db", "build", "--postures", "DB_open_power", "--left", "-o", path("left.glovedb")}));
  EXPECT_THAT(run_glovebench({"db", "info", path("left.glovedb")}).out, HasSubstr("left hand"));
  render_recording("left.json", "dump");
  EXPECT_THAT(refusal(track("dump", path("right.glovedb"), "x.jsonl", {"--left"})),
              AllOf(HasSubstr("DB_open_power"), HasSubstr("right"), HasSubstr("left")));
  EXPECT_FALSE(fs::exists(path("x.jsonl")));
  const ProgramRun tracked = track("dump", path("left.glovedb"), "x.jsonl", {"--left"});
  expect_fine(tracked);
  EXPECT_THAT(tracked.out, HasSubstr("4 of 4 frames tracked"));
}

TEST_F(CommandsLong, WrongUnitsAreNoticed) {
  json meters = make_trajectory_json("meters", kFrames), radians = make_trajectory_json("radians", kFrames);
  for (json& frame : meters["frames"])
    for (json& coordinate : frame["position_mm"]) coordinate = coordinate.get<double>() / 1000;
  for (json& frame : radians["frames"])
    for (json& angle : frame["angles_deg"]) angle = angle.get<double>() / 20;
  write_file(path("meters.json"), meters.dump());
  write_file(path("radians.json"), radians.dump());
  const auto run = [&](const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run",           "--trajectory", path(name), "--database",
                                          "DB_open_power", "-o",           path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  const ProgramRun in_meters = run("meters.json");
  EXPECT_EQ(in_meters.exit_code, 0) << "a warning, no error";
  EXPECT_THAT(in_meters.err, AllOf(HasSubstr("warning: meters: most frames lie outside of the working volume"),
                                   HasSubstr("the positions look like meters")));
  EXPECT_THAT(in_meters.err,
              HasSubstr("warning: meters_DB_open_power_source_subject1_gradient_1: none of 4 frames"));
  EXPECT_THAT(in_meters.out, HasSubstr("meters            -"));
  const ProgramRun quiet = run("meters.json", {"--quiet"});
  EXPECT_EQ(quiet.err, in_meters.err);
  EXPECT_EQ(quiet.out, "");
  for (const char* file : {"out/summary.md", "out/index.html"})
    EXPECT_THAT(read_file(path(file)),
                AllOf(HasSubstr("the positions look like meters"), HasSubstr("none of 4 frames was tracked"),
                      HasSubstr("glovebench explain . 0 "), HasSubstr("--trajectory PATH/meters.json")));
  EXPECT_THAT(run("radians.json", {"--dry-run"}).err, HasSubstr("warning: radians: no angle exceeds 0.95 degrees"));
  expect_fine(run("good.json", {"--dry-run"}));
}

TEST_F(CommandsLong, LowMemoryChangesNoResult) {
  run_trajectory("good.json", "normal");
  run_trajectory("good.json", "low", {"--low-memory"});
  EXPECT_EQ(read_file(path("normal/results.json")), read_file(path("low/results.json")));
  EXPECT_EQ(read_folder(path("normal/tables")), read_folder(path("low/tables")));

  expect_fine(
      run_glovebench({"db", "build", "--postures", "DB_open_power", "--low-memory", "-o", path("low.glovedb")}));
  EXPECT_THAT(run_glovebench({"db", "info", path("low.glovedb")}).out, HasSubstr("low memory"));
  expect_fine(run_glovebench(
      {"run", "--trajectory", path("good.json"), "--database", path("low.glovedb"), "-o", path("file")}));
}

TEST_F(CommandsLong, DatabaseOfOnesOwnPostures) {
  write_file(path("gestures.csv"),
             read_file(fs::path(build_paths::program("glovebench")).parent_path().parent_path() /
                       "share/glovebench/trajectories/data/gestures.csv"));
  std::string csv = read_file(path("gestures.csv"));
  const size_t third_line = csv.find('\n', csv.find('\n', csv.find("name,")) + 1) + 1;
  write_file(path("mine.csv"), csv.substr(0, third_line));
  const ProgramRun built =
      run_glovebench({"db", "build", "--postures", path("mine.csv"), "-o", path("mine.glovedb")});
  expect_fine(built);
  EXPECT_THAT(built.out, AllOf(HasSubstr("1 postures"), HasSubstr("756 entries")));
  const ProgramRun info = run_glovebench({"db", "info", path("mine.glovedb")});
  expect_fine(info);
  EXPECT_THAT(info.out, AllOf(HasSubstr("mine, right hand, 756 entries"), HasSubstr("\n  ")));

  // Postures in a file and a built database give the same results. A database with other views is refused.
  const auto run_with = [&](const std::string& database, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run",          "--trajectory", path("good.json"),      "--database",
                                          path(database), "-o",           path("own-" + database)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  render_recording("good.json", "dump");
  expect_fine(run_with("mine.csv"));
  expect_fine(run_with("mine.glovedb"));
  EXPECT_EQ(read_file(path("own-mine.csv/results.json")), read_file(path("own-mine.glovedb/results.json")));
  write_file(path("views.json"), R"({"database": {"view_distance_m": 1.5}})");
  EXPECT_THAT(refusal(run_with("mine.glovedb", {"--config", path("views.json")})), HasSubstr("mine.glovedb: hash"));

  // A database with the same inputs and other content, as another builder makes it, gives results that do not
  // compare.
  std::string other = read_file(path("mine.glovedb"));
  const DatabaseLayout layout = layout_of(other);
  char& label = other[layout.sizes().at(64).labels.offset + 1000];
  label = static_cast<char>(label == 0x11 ? 0x22 : 0x11);
  write_file(path("other.glovedb"), with_right_hashes(other, layout));
  expect_fine(run_with("other.glovedb"));
  const ProgramRun compared = run_glovebench({"compare", path("own-mine.glovedb"), path("own-other.glovedb")});
  EXPECT_EQ(compared.exit_code, 3);
  EXPECT_THAT(compared.err, HasSubstr("inputs.databases.mine: found "));
  EXPECT_THAT(refusal(run_glovebench({"db", "info", path("other.glovedb")})), HasSubstr("those of its labels"));

  std::string damaged = read_file(path("mine.glovedb"));
  damaged[damaged.size() / 2] ^= 1;
  write_file(path("damaged.glovedb"), damaged);
  write_file(path("short.glovedb"), damaged.substr(0, damaged.size() / 3));
  for (const std::string name : {"damaged.glovedb", "short.glovedb"}) {
    EXPECT_THAT(refusal(track("dump", path(name), "x.jsonl")), HasSubstr(name));
    EXPECT_THAT(refusal(run_glovebench({"db", "info", path(name)})), HasSubstr(name));
  }
}

TEST_F(CommandsLong, AMovementOfOnesOwnMayHaveTheNameOfABuiltInOne) {
  write_file(path("any_2.json"), make_trajectory_json("any_2", kFrames).dump());
  run_trajectory("any_2.json", "out");
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "2"})), HasSubstr("give its file by --trajectory"));
  expect_fine(run_glovebench({"explain", path("out"), "2", "--trajectory", path("any_2.json")}));
  EXPECT_THAT(read_file(path("out/index.html")), HasSubstr(" --trajectory PATH/any_2.json"));
  expect_fine(run_glovebench(
      {"run", "--trajectory", "any_2", "--database", "DB_open_power", "--filter", "any*", "-o", path("named")}));
  EXPECT_THAT(read_file(path("named/index.html")), testing::Not(HasSubstr("--trajectory PATH")));
}

TEST_F(CommandsLong, AReportReplacesNothingElse) {
  for (const char* name : {"config.json", "index.html", "summary.md", "results.json"}) {
    const std::string folder = path(std::string("keep_") + name);
    write_file(folder + "/" + name, "mine");
    EXPECT_THAT(refusal(run_glovebench(
                    {"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o", folder})),
                HasSubstr(std::string(name) + ", which no report of this kind wrote, expected another folder"));
    EXPECT_EQ(read_folder(folder).size(), 1U);
  }
  run_trajectory("good.json", "out");
  run_trajectory("good.json", "out");
  expect_fine(run_glovebench({"compare", path("out"), path("out"), "-o", path("compared")}));
  EXPECT_THAT(refusal(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o",
                                      path("compared")})),
              HasSubstr("index.html, which no report of this kind wrote"));
  for (const char* name : {"index.html", "junit.xml"}) {
    const std::string folder = path(std::string("compared_") + name);
    write_file(folder + "/" + name, "mine");
    EXPECT_THAT(refusal(run_glovebench({"compare", path("out"), path("out"), "-o", folder})),
                HasSubstr(std::string(name) + ", which no report of this kind wrote, expected another folder"));
    EXPECT_EQ(read_folder(folder).size(), 1U);
  }
  expect_fine(run_glovebench({"compare", path("out"), path("out"), "-o", path("compared")}));
}

TEST_F(CommandsLong, SettingsAreComparedInATable) {
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run",           "--trajectory", path("good.json"), "--database",
                                          "DB_open_power", "-o",           path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  const ProgramRun several = run({"--cascade", "8:200,32:3", "--cascade", "16:500,64:1"});
  expect_fine(several);
  EXPECT_THAT(several.out, AllOf(HasSubstr("16-500_64-1"), HasSubstr("lookup.cascade"),
                                 HasSubstr("No recommendation: not enough data"),
                                 HasSubstr("Differences are from paper, the paper's")));
  for (const std::string name : {"paper", "8-200_32-3", "16-500_64-1"}) {
    const json timings = json::parse(read_file(path("out/" + name + "/timings.json")));
    EXPECT_EQ(timings.at("threads"), 1);
    EXPECT_EQ(timings.at("experiments").at(0).at("stages").at("look_up").at("count"), kFrames);
  }
  run_trajectory("good.json", "alone", {"--cascade", "8:200,32:3"});
  EXPECT_EQ(read_file(path("out/8-200_32-3/results.json")), read_file(path("alone/results.json")))
      << "as if it ran alone";

  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "worst"})),
              HasSubstr("found a folder of runs, expected one of " + path("out/16-500_64-1") + ", "));

  const std::vector<std::string> folders = {path("out/paper"), path("out/8-200_32-3/"), path("out/16-500_64-1")};
  const auto table = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"table"};
    arguments.insert(arguments.end(), folders.begin(), folders.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  const ProgramRun again = table({});
  expect_fine(again);
  EXPECT_THAT(several.out, StartsWith(again.out));
  EXPECT_EQ(table({"--format", "csv"}).out, read_file(path("out/table.csv")));
  EXPECT_EQ(table({"--format", "html"}).out, read_file(path("out/index.html")));
  EXPECT_THAT(again.out, StartsWith(table({"-q"}).out + "\n"));
  EXPECT_THAT(table({"--metrics", "joint_error_mm"}).err, HasSubstr("--metrics"));
  EXPECT_THAT(table({"--metrics", "posture"}).err, HasSubstr("did you mean posture_rms_deg?"));
  EXPECT_THAT(table({"--metrics", "posture_rms_deg,posture_rms_deg"}).err, HasSubstr("found one of them twice"));

  EXPECT_THAT(refusal(run({"--cascade", "8:9", "--cascade", "8:8", "--method", "a", "--method", "b"})),
              HasSubstr("--cascade: values: found several, as of --method, expected one"));
  EXPECT_THAT(refusal(run({"--cascade", "8:9", "--cascade", "8:9"})), HasSubstr("found 8-9 twice"));
  EXPECT_THAT(run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o",
                              path("alone"), "--cascade", "8:9", "--cascade", "8:8"})
                  .err,
              HasSubstr("which holds a run"));
}

TEST_F(CommandsLong, RendersPicturesAndLayers) {
  expect_fine(run_glovebench({"render", "--trajectory", path("good.json"), "--format", "png", "-o", path("png")}));
  EXPECT_EQ(read_folder(path("png")).size(), 2U * kFrames + 2) << "color and depth, manifest and README";
  EXPECT_THAT(FileSet(path("png")).read("depth_0003.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read_file(path("png/color_0003.png")), StartsWith("\x89PNG"));

  expect_fine(run_glovebench({"render", "--trajectory", path("good.json"), "--format", "exr", "--database",
                              "DB_open_power", "-o", path("exr")}));
  EXPECT_EQ(read_manifest(path("exr"))->size(), size_t{kFrames} + 1) << "with README.txt";
  const render::FrameLayers layers = render::read_exr(path("exr/frame_0003.exr"));
  EXPECT_EQ(layers.color.width(), 640);
  const auto glove = [](const LabelImage& labels) {
    return std::count_if(labels.begin(), labels.end(), [](uint8_t label) { return label != 0; });
  };
  EXPECT_GT(glove(layers.label), 1000);
  // The tracker's hand and the true one differ by a few percent of pixels.
  EXPECT_NEAR(glove(layers.tracker_label), glove(layers.label), 0.1 * glove(layers.label));
}

TEST_F(CommandsLong, RecordedTruthRuns) {
  expect_fine(run_glovebench(
      {"record", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o", path("again.json")}));
  const json results = run_trajectory("again.json", "out");
  EXPECT_EQ(results.at("experiments").at(0).at("truth"), "recorded");
}

TEST_F(CommandsLong, FullDiskLeavesTheOldReportButMarked) {
  run_trajectory("good.json", "out");
  const std::map<std::string, std::string> before = read_folder(path("out"));
  // Room for results.json and more, but not for the page.
  ProgramSetting full;
  full.max_file_bytes = before.at("index.html").size() / 2;
  ASSERT_LT(before.at("results.json").size(), full.max_file_bytes);
  const std::string line = refusal(run_glovebench(
      {"run", "--trajectory", path("good.json"), "--database", "DB_open_power", "-o", path("out"), "--seed", "7"},
      full));
  EXPECT_THAT(line, AllOf(HasSubstr("index.html"), HasSubstr("room")));
  std::map<std::string, std::string> after = read_folder(path("out"));
  std::erase_if(after, [](const auto& file) { return file.first.starts_with(".unfinished/"); });
  EXPECT_EQ(after, before) << "and nothing beside it";
  // The folder's report is of another run than the last one requested.
  EXPECT_EQ(run_glovebench({"explain", path("out"), "2", "--trajectory", path("good.json")}).exit_code, 3);
  EXPECT_NE(run_trajectory("good.json", "out", {"--seed", "7"}), json::parse(before.at("results.json")));
}

TEST_F(CommandsLong, FullDiskLeavesTheOldDatabase) {
  const std::string database = path("open_power.glovedb");
  write_file(database, "an older one");
  ProgramSetting full;
  full.max_file_bytes = 1'000'000;
  EXPECT_THAT(
      refusal(run_glovebench({"db", "build", "--postures", "DB_open_power", "-o", database, "--quiet"}, full)),
      AllOf(HasSubstr("open_power.glovedb"), HasSubstr("room")));
  EXPECT_EQ(read_file(database), "an older one");
  EXPECT_EQ(read_folder(folder_).size(), 3U) << "the two trajectories and the database";
}

TEST_F(CommandsLong, DamagedColorTableIsMadeAnew) {
  const std::string cache = path("cache");
  const json before = run_trajectory("good.json", "out", {"--cache", cache});
  for (const auto& entry : fs::directory_iterator(cache)) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".table")) continue;
    std::string content = read_file(file);
    content[content.size() / 2] ^= 1;
    write_file(file, content);
    EXPECT_EQ(run_trajectory("good.json", "out", {"--cache", cache}), before);
    EXPECT_NE(read_file(file), content) << "and kept";
    return;
  }
  FAIL() << "no color table in the cache";
}

TEST_F(CommandsLong, DamagedCachedDatabaseIsMadeAnew) {
  const std::string cache = path("cache");
  const json before = run_trajectory("good.json", "out", {"--cache", cache});
  for (const auto& entry : fs::directory_iterator(cache)) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".glovedb")) continue;
    fs::resize_file(file, fs::file_size(file) / 2);
    const ProgramRun run = run_glovebench({"run", "--trajectory", path("good.json"), "--database", "DB_open_power",
                                           "-o", path("out"), "--cache", cache});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_THAT(run.err, HasSubstr(entry.path().filename().string())) << "said, since it costs time";
    EXPECT_EQ(json::parse(read_file(path("out/results.json"))), before);
    return;
  }
  FAIL() << "no database in the cache";
}

}  // namespace
}  // namespace glovebench::eval
