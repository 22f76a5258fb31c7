#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/input_file.h"
#include "eval/command_test.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ExplainLong : public CommandTest {};

TEST_F(ExplainLong, ShowsAFrame) {
  run_trajectory("good.json", "out");
  const auto explain = [&](const std::string& frame, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"explain", path("out"), frame, "--trajectory", path("good.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  };
  expect_fine(explain("2", {"-o", path("frame.png")}));
  EXPECT_THAT(read_file(path("frame.png")), StartsWith("\x89PNG"));
  expect_fine(explain("2"));
  EXPECT_TRUE(fs::exists(path("out/explain_good_DB_open_power_source_subject1_gradient_1_2.png")));
  EXPECT_THAT(refusal(explain("2", {"-o", path("frame.jpg")})), HasSubstr("expected the ending .png"));
  EXPECT_THAT(refusal(explain("4")), HasSubstr("frame: found 4, expected one of the run's, 0 to 3"));
  EXPECT_THAT(refusal(explain("-1")), HasSubstr("0 to 3"));
  EXPECT_THAT(refusal(explain("2", {"--experiment", "other"})), HasSubstr("good_DB_open_power"));
  expect_fine(explain("2", {"--seed", "1"}));
  expect_fine(explain("2", {"--experiment", "good_*_source_*"}));
  EXPECT_THAT(refusal(explain("two")), HasSubstr("expected a number, worst or worst:METRIC"));
  for (const char* metric : {"worst:fingertip_eror_mm", "worst:fingertip"})
    EXPECT_THAT(refusal(explain(metric)), HasSubstr("did you mean fingertip_error_mm?"));
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "2", "--trajectory", "Tr4"})),
              HasSubstr("none of Tr4"));
  EXPECT_THAT(refusal(explain("2", {"--seed", "7"})), HasSubstr("one of 1"));
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "2", "--trajectory", path("left.json")})),
              HasSubstr("hash"))
      << "not the truth of that run";
  EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), "2"})), HasSubstr("--trajectory"));
}

TEST_F(ExplainLong, ShowsTheWorstFrame) {
  const json results = run_trajectory("good.json", "out");
  const json& columns = results.at("frame_columns");
  const auto column = std::ranges::find(columns, "fingertip_error_mm") - columns.begin();
  const json& frames = results.at("experiments").at(0).at("runs").at(0).at("frames");
  const auto worst =
      std::ranges::max_element(frames, {}, [&](const json& row) { return row.at(column).get<double>(); });
  const ProgramRun run =
      run_glovebench({"explain", path("out"), "worst:fingertip_error_mm", "--trajectory", path("good.json")});
  expect_fine(run);
  const int number = worst->at(0);
  EXPECT_THAT(run.out, HasSubstr(fmt::format("frame {}, seed 1, fingertip_error_mm {:.1f} in the run", number,
                                             worst->at(column).get<double>())));
  EXPECT_TRUE(
      fs::exists(path(fmt::format("out/explain_good_DB_open_power_source_subject1_gradient_1_{}.png", number))));
  expect_fine(run_glovebench({"explain", path("out"), "worst", "--trajectory", path("good.json")}));
}

TEST_F(ExplainLong, ShowsMethodsThatSeeDepth) {
  const auto explain = [&](const std::string& method) {
    run_trajectory("good.json", method, {"--method", method});
    return run_glovebench({"explain", path(method), "2", "--trajectory", path("good.json")});
  };
  expect_fine(explain("articulated"));
  EXPECT_THAT(read_file(path("articulated/index.html")),
              AllOf(HasSubstr("The worst frames</h2>"), HasSubstr("glovebench explain . ")));
  EXPECT_THAT(refusal(explain("monocular_bbox")),
              HasSubstr("method: found monocular_bbox, expected one that sees"));
  EXPECT_THAT(read_file(path("monocular_bbox/index.html")), testing::Not(HasSubstr("glovebench explain")));
}

TEST_F(ExplainLong, ShowsAFrameThatIsLostWithoutEarlierOnes) {
  json leaving = make_trajectory_json("leaving", kFrames);
  for (int i = 0; i < kFrames; ++i) leaving["frames"][i]["position_mm"] = {260 + 30 * i, 20, 700};
  write_file(path("leaving.json"), leaving.dump());
  for (const auto& [method, lost] : {std::pair("articulated", 0), std::pair("schroeder2012", 1)}) {
    const json results = run_trajectory("leaving.json", method, {"--method", method});
    EXPECT_EQ(results.at("experiments").at(0).at("coverage").at("lost"), lost) << method;
    expect_fine(run_glovebench({"explain", path(method), "3", "--trajectory", path("leaving.json")}));
  }
}

TEST_F(ExplainLong, ShowsFramesOfTheRunAlone) {
  write_file(path("some.json"), json{{"format", "glovebench-suite"},
                                     {"version", 1},
                                     {"name", "some"},
                                     {"description", "frames 10 to 12"},
                                     {"seeds", {1}},
                                     {"experiments",
                                      {{{"trajectory", "Tr4"},
                                        {"truth", "source"},
                                        {"databases", {"DB_open_power"}},
                                        {"frames", {{"first", 10}, {"count", 3}}}}}}}
                                    .dump());
  expect_fine(run_glovebench({"run", "--suite", path("some.json"), "-o", path("out")}));
  expect_fine(run_glovebench({"explain", path("out"), "12"}));
  for (const char* number : {"9", "13"})
    EXPECT_THAT(refusal(run_glovebench({"explain", path("out"), number})), HasSubstr("one of the run's, 10 to 12"));
}

}  // namespace
}  // namespace glovebench::eval
