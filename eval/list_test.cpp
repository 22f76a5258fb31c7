// What `list` prints.
#include <gmock/gmock.h>

#include <sstream>

#include "eval/command_test.h"

namespace glovebench::eval {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using List = CommandTest;

TEST_F(List, FitsATerminalOf80Columns) {
  for (const char* list : {"trajectories", "families", "databases", "suites", "studies", "methods", "alignments",
                           "look-ups", "noises", "formats", "metrics", "subjects", "angles", "mapping"}) {
    const ProgramRun run = run_glovebench({"list", list});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    ASSERT_FALSE(run.out.empty()) << list;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 80U) << list << ": " << line;
  }
}

TEST_F(List, NamesWhatThereIs) {
  EXPECT_THAT(run_glovebench({"list"}).out,
              AllOf(HasSubstr("\n  subjects      The hands"), HasSubstr("\n  mapping "), HasSubstr("\n  config ")));
  EXPECT_THAT(run_glovebench({"list", "trajectories"}).out, AllOf(HasSubstr("Tr1"), HasSubstr("recorded")));
  EXPECT_THAT(run_glovebench({"list", "databases"}).out, HasSubstr("DB_20_postures"));
  EXPECT_THAT(run_glovebench({"list", "suites"}).out, AllOf(HasSubstr("quick"), HasSubstr("full")));
  EXPECT_THAT(run_glovebench({"list", "methods"}).out, AllOf(HasSubstr("schroeder2012"), HasSubstr("monocular")));
  EXPECT_THAT(run_glovebench({"list", "alignments"}).out, AllOf(HasSubstr("horn"), HasSubstr("robust")));
  EXPECT_THAT(run_glovebench({"list", "look-ups"}).out, AllOf(HasSubstr("plain"), HasSubstr("fast")));
  EXPECT_THAT(run_glovebench({"list", "subjects"}).out,
              AllOf(HasSubstr("\n 3 woman 181 mm long"), HasSubstr("\n22 "), Not(HasSubstr("\n23 "))));
  EXPECT_THAT(run_glovebench({"list", "angles"}).out, HasSubstr("little_dip_flexion"));
  const ProgramRun config = run_glovebench({"list", "config", "--cascade", "8:9"});
  EXPECT_EQ(json::parse(config.out).at("lookup").at("cascade"), "8:9");
  EXPECT_THAT(run_glovebench({"list", "config", "--explain"}).out,
              AllOf(HasSubstr("lookup.cascade = \"16:500,64:3\""), HasSubstr("[0.3, 10], unit m")));
  EXPECT_THAT(run_glovebench({"list", "config", "--explain", "--cascade", "8:9"}).out,
              HasSubstr("lookup.cascade = \"8:9\""));
  EXPECT_THAT(run_glovebench({"list", "config", "--explain", "k"}).out,
              AllOf(HasSubstr("lookup.cascade"), HasSubstr("section IV-B"), Not(HasSubstr("volume.z_min_m"))));
  EXPECT_THAT(run_glovebench({"list", "config", "K nearest neighbor"}).out, HasSubstr("lookup.cascade"));
  EXPECT_THAT(run_glovebench({"list", "config", "Sub-Sampling"}).out, HasSubstr("icp.subsampling_factor"));
  EXPECT_THAT(run_glovebench({"list", "metrics"}).out,
              AllOf(HasSubstr("position_error_mm, compared\n"), HasSubstr("lost ones are left out")));
  write_file(path("again.json"), config.out);
  EXPECT_EQ(run_glovebench({"list", "config", "--config", path("again.json")}).out, config.out);
}

}  // namespace
}  // namespace glovebench::eval
