// `glovebench generate`: what it writes, that `run` takes it, and what it refuses.
#include <gmock/gmock.h>

#include "eval/command_test.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class GenerateCommand : public CommandTest {
 protected:
  ProgramRun generate(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"generate", "--frames", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  std::string refused(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"-o", path("refused"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string line = refusal(generate(arguments));
    EXPECT_TRUE(!fs::exists(path("refused")) || fs::is_empty(path("refused")));
    return line;
  }
};

TEST_F(GenerateCommand, WritesAFileForEachSeed) {
  const ProgramRun run = generate({"--family", "side", "--count", "3", "--seed", "5", "-o", path("many")});
  expect_fine(run);
  EXPECT_THAT(run.out, AllOf(HasSubstr("many/side_5.json: 3 frames, hash "), HasSubstr("many/side_7.json: ")));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3);
  expect_fine(generate({"--family", "side", "--count", "1", "--seed", "6", "-o", path("one")}));
  EXPECT_EQ(read_file(path("one/side_6.json")), read_file(path("many/side_6.json")))
      << "a movement does not depend on how many are made";
  expect_fine(generate({"--family", "side", "--count", "3", "--seed", "5", "-o", path("again")}));
  EXPECT_EQ(read_folder(path("again")), read_folder(path("many")));
}

TEST_F(GenerateCommand, GivesTrajectoriesThatRunTakes) {
  expect_fine(generate({"--family", "above", "--count", "1", "-o", path(".")}));
  const nlohmann::json results = run_trajectory("above_1.json", "out");
  EXPECT_EQ(results.at("experiments").at(0).at("trajectory"), "above_1");
}

TEST_F(GenerateCommand, AllFilesOfItsFolderMayBeGivenToRun) {
  expect_fine(generate({"--family", "above", "--count", "2", "-o", path("gen")}));
  const ProgramRun run =
      run_glovebench({"run", "--trajectory", path("gen/above_1.json"), "--trajectory", path("gen/above_2.json"),
                      "--trajectory", path("gen/manifest.json"), "--database", "DB_open_power", "--list"});
  expect_fine(run);
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2) << run.out;
  EXPECT_THAT(refusal(run_glovebench(
                  {"run", "--trajectory", path("gen/manifest.json"), "--database", "DB_open_power", "--list"})),
              HasSubstr("manifest.json"));
}

TEST_F(GenerateCommand, IsDescribedByTheListOfFamilies) {
  const ProgramRun list = run_glovebench({"list", "families"});
  expect_fine(list);
  EXPECT_THAT(list.out,
              AllOf(HasSubstr("side "), HasSubstr("side      75-105 "), HasSubstr("DIP 0.5 to 0.9 of PIP")));
  EXPECT_THAT(run_glovebench({"generate", "--help"}).out,
              AllOf(HasSubstr("captured"), HasSubstr("families` prints the ranges")));
}

TEST_F(GenerateCommand, RefusesBadInput) {
  EXPECT_THAT(refused({"--family", "sideways"}), AllOf(HasSubstr("sideways"), HasSubstr("side,")));
  EXPECT_THAT(refused({}), HasSubstr("--family"));
  EXPECT_THAT(refusal(generate({"--family", "side"})), HasSubstr("--output"));
  EXPECT_THAT(refused({"--family", "side", "--count", "0"}), HasSubstr("--count"));
  EXPECT_THAT(refused({"--family", "side", "--frames", "0"}), HasSubstr("--frames"));
  EXPECT_THAT(refused({"--family", "side", "--seed", "-1"}), HasSubstr("--seed"));
  EXPECT_THAT(refused({"--family", "side", "--seed", "999999"}),
              HasSubstr("--seed: value: found 1000008 for the last movement, expected at most 1000000"));
  EXPECT_THAT(refused({"--family", "side", "--distance", "-1"}), HasSubstr("--distance"));
  EXPECT_THAT(
      refused({"--family", "side", "--distance", "90"}),
      AllOf(HasSubstr("side_1: ranges: found none of"), HasSubstr("expected postures 90 deg RMS from each")));
  write_file(path("file"), "");
  EXPECT_THAT(refusal(generate({"--family", "side", "-o", path("file")})), HasSubstr("file"));
}

}  // namespace
}  // namespace glovebench::eval
