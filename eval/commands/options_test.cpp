#include "eval/commands/options.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <optional>
#include <sstream>

#include "core/base/error.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A program with commands: `walk`, which has every kind of option, `rest on`, which has none, and `look`, which
/// may stand alone or before `up`.
class Options : public testing::Test {
 protected:
  /// Returns the exit code.
  int run(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "program");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int exit_code =
        run_program(static_cast<int>(arguments.size()), arguments.data(), [this](Command program) {
          const Command walk = program.subcommand("walk", "Goes.");
          walk.option("where", where, "to").required();
          walk.option("--steps", steps, "whole").in(0, 10);
          walk.option("--seed", seed, "whole").not_negative();
          walk.option("--speed", speed, "a share").in(0, 1);
          walk.option("--gait", gait, "how").one_of({"slow", "fast"});
          const Command clothes = walk.group("Clothes");
          clothes.option("--shoes", shoes, "which").needs("--gait");
          clothes.option("--hat", hat, "which").rare();
          walk.option("--log", log, "file").named_file();
          walk.option("--limit", limit, "whole");
          walk.option("--stops", stops, "several").comma_separated();
          walk.option("--offset", offset, "two").count(2);
          walk.option("--pose", T_world_start, "seven");
          walk.option("--back", back, "as a flag");
          walk.runs([this, walk] {
            is_seed_given = walk.given("--seed");
            return 7;
          });
          program.subcommand("rest", "Stays.\nNot for long.").subcommand("on", "As it is.").runs([this] {
            rested = true;
          });
          const Command look = program.subcommand("look", "Sees.");
          look.subcommand("up", "The sky.").runs([this] { seen = "sky"; });
          look.runs([this] { seen = "all"; });
        });
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return exit_code;
  }
  /// The message for `walk home` with wrong arguments.
  std::string refusal(std::vector<const char*> more) {
    more.insert(more.begin(), {"walk", "home"});
    EXPECT_EQ(run(more), 2);
    EXPECT_EQ(out, "");
    return err;
  }

  std::string where = "nowhere", gait = "slow", shoes, hat, log, seen;
  int steps = 3;
  uint64_t seed = 1;
  double speed = 0.5;
  std::optional<int> limit;
  std::vector<std::string> stops;
  std::vector<double> offset = {1, 2};
  std::optional<Eigen::Isometry3d> T_world_start;
  bool back = false;
  bool is_seed_given = false, rested = false;
  std::string out, err;
};

TEST_F(Options, HelpShowsDefaultsUnlessEmptyOrRequired) {
  EXPECT_EQ(run({"walk", "--help"}), 0);
  EXPECT_THAT(out, AllOf(HasSubstr("where TEXT REQUIRED "), HasSubstr("--steps INT:[0 - 10]=3 "),
                         HasSubstr("--seed UINT:NONNEGATIVE=1 "), HasSubstr("--speed FLOAT:[0 - 1]=0.5 "),
                         HasSubstr("--gait TEXT:{slow,fast}=slow ")));
  EXPECT_THAT(out, AllOf(HasSubstr("--shoes TEXT Needs: --gait "), HasSubstr("--limit INT "),
                         HasSubstr("--stops TEXT[,...] "), HasSubstr("--offset FLOAT=[1,2] x 2"),
                         HasSubstr("--pose FLOAT x 7 "), HasSubstr("--back ")));
}

TEST_F(Options, HelpHasGroupsAndFits80Columns) {
  EXPECT_EQ(run({"walk", "--help"}), 0);
  EXPECT_THAT(out,
              testing::StartsWith("Goes.\nUsage: glovebench walk [OPTIONS] where\n\nArguments:\n  where TEXT"));
  EXPECT_THAT(out, HasSubstr("\nClothes:\n  --shoes TEXT Needs: --gait    which\n"));
  EXPECT_THAT(out, Not(HasSubstr("--hat"))) << "rare";
  EXPECT_EQ(run({"walk", "--help-all"}), 0);
  EXPECT_THAT(out, HasSubstr("\n  --hat TEXT                    which\n"));
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(out, HasSubstr("\nCommands:\n  walk  Goes.\n  rest  Stays.\n  look  Sees.\n"));
  EXPECT_EQ(run({"--help-all"}), 0);
  EXPECT_THAT(out, AllOf(HasSubstr("--hat"), HasSubstr("Usage: glovebench rest on"))) << "all commands";
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST_F(Options, SuggestTheNearestWordAndTheHelpOfTheCommand) {
  EXPECT_EQ(run({"wakl", "home"}), 2);
  EXPECT_EQ(err, "glovebench: unknown command wakl; did you mean walk? (see glovebench --help)\n");
  EXPECT_EQ(run({"rest", "no"}), 2);
  EXPECT_EQ(err, "glovebench: unknown command no (see glovebench rest --help)\n");
  EXPECT_EQ(run({"rest", "on", "here"}), 2);
  EXPECT_EQ(err, "glovebench: unexpected argument here (see glovebench rest on --help)\n");
  EXPECT_EQ(run({"walk", "--setps=3"}), 2);
  EXPECT_EQ(err, "glovebench: unknown flag --setps; did you mean --steps? (see glovebench walk --help)\n")
      << "although `where` is missing, too";
  EXPECT_EQ(run({"--steps", "3", "walk", "home"}), 2);
  EXPECT_EQ(err, "glovebench: unknown flag --steps (see glovebench --help)\n") << "it is the program's place";
  EXPECT_EQ(refusal({"--gait", "fats"}),
            "glovebench: --gait: found fats, expected one of slow, fast; did you mean fast? (see glovebench walk "
            "--help)\n");
}

TEST_F(Options, CommandsThatMayStandAlone) {
  EXPECT_EQ(run({"look"}), 0);
  EXPECT_EQ(seen, "all");
  EXPECT_EQ(run({"look", "up"}), 0);
  EXPECT_EQ(seen, "sky");
  EXPECT_EQ(run({"look", "ap"}), 2);
  EXPECT_EQ(err, "glovebench: unknown command ap (see glovebench look --help)\n");
}

TEST_F(Options, RefuseAnEmptyValue) {
  for (const char* name : {"--steps", "--seed", "--speed", "--gait", "--log", "--limit", "--stops"})
    EXPECT_THAT(refusal({name, ""}), AllOf(HasSubstr(name), HasSubstr("found nothing, expected a value")));
  EXPECT_THAT(refusal({"--gait", "slow", "--shoes", ""}), HasSubstr("--shoes: found nothing, expected a value"));
  EXPECT_THAT(refusal({"--offset", "1", ""}), HasSubstr("--offset: found nothing, expected a value"));
  EXPECT_EQ(run({"walk", ""}), 2);
  EXPECT_THAT(err, HasSubstr("where: found nothing, expected a value"));
}

TEST_F(Options, ReadsAllKinds) {
  EXPECT_EQ(run({"walk",    "home", "--steps",  "10",   "--seed",  "18446744073709551615",
                 "--speed", "0.25", "--gait",   "fast", "--shoes", "red",
                 "--log",   "a",    "--limit",  "5",    "--stops", "a,b",
                 "--stops", "c",    "--offset", "3",    "-4",      "--back"}),
            7)
      << err;
  EXPECT_EQ(where + gait + shoes + log, "homefastreda");
  EXPECT_EQ(steps, 10);
  EXPECT_EQ(seed, 18446744073709551615U);
  EXPECT_EQ(speed, 0.25);
  EXPECT_EQ(limit, 5);
  EXPECT_THAT(stops, ElementsAre("a", "b", "c"));
  EXPECT_THAT(offset, ElementsAre(3, -4));
  EXPECT_TRUE(back);
  EXPECT_TRUE(is_seed_given);
  EXPECT_FALSE(T_world_start);
}

TEST_F(Options, KeepsDefaultsOfWhatIsNotGiven) {
  EXPECT_EQ(run({"walk", "home"}), 7);
  EXPECT_EQ(steps, 3);
  EXPECT_THAT(offset, ElementsAre(1, 2));
  EXPECT_FALSE(back);
  EXPECT_FALSE(is_seed_given);
}

TEST_F(Options, RefusesValuesOutOfBounds) {
  EXPECT_THAT(refusal({"--steps", "11"}), HasSubstr("--steps: found 11, expected a number from 0 to 10"));
  EXPECT_THAT(refusal({"--steps", "1.5"}), HasSubstr("--steps: found 1.5, expected a whole number"));
  EXPECT_THAT(refusal({"--speed", "nan"}), HasSubstr("--speed: found nan, expected a number from 0 to 1"));
  EXPECT_THAT(refusal({"--speed", "1.5"}), HasSubstr("--speed: found 1.5, expected"));
  for (const char* seed_text : {"-1", "18446744073709551616", "010", "0x10", "1e3", "1.0", "+1", " 1", "1'000", ""})
    EXPECT_THAT(refusal({"--seed", seed_text}), HasSubstr("--seed: ")) << seed_text;
  EXPECT_THAT(refusal({"--seed", "010"}), HasSubstr("found 010, expected a whole number"));
  EXPECT_THAT(refusal({"--limit", "2147483648"}), HasSubstr("--limit: found 2147483648"));
  EXPECT_THAT(refusal({"--limit", "-010"}), HasSubstr("--limit: found -010"));
  EXPECT_THAT(refusal({"--limit", "-2147483649"}), HasSubstr("--limit: found"));
  EXPECT_THAT(refusal({"--gait", "odd"}), HasSubstr("--gait: found odd, expected one of slow, fast (see"));
  EXPECT_THAT(refusal({"--log", "-"}), HasSubstr("--log: found -, expected the name of a file or folder"));
  EXPECT_THAT(refusal({"--offset", "1"}), HasSubstr("--offset"));
  EXPECT_THAT(refusal({"--shoes", "red"}), HasSubstr("--gait"));
  EXPECT_THAT(refusal({"--limit", "many"}), HasSubstr("--limit"));
}

TEST_F(Options, TransformsAreRigid) {
  EXPECT_EQ(run({"walk", "home", "--pose", "1", "2", "3", "0.6", "0", "0", "0.8"}), 7) << err;
  ASSERT_TRUE(T_world_start);
  EXPECT_EQ(T_world_start->translation(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Quaterniond q(T_world_start->linear());
  EXPECT_NEAR(q.angularDistance(Eigen::Quaterniond(0.6, 0, 0, 0.8)), 0, 1e-12) << "rad, rounding of the matrix";

  EXPECT_THAT(refusal({"--pose", "1", "2", "3", "1", "0", "0"}), HasSubstr("--pose"));
  const auto error = [&](const char* x, const char* qw) -> std::string {
    try {
      run({"walk", "home", "--pose", x, "2", "3", qw, "0", "0", "0"});
    } catch (const Error& e) {
      testing::internal::GetCapturedStdout();
      testing::internal::GetCapturedStderr();
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error("1", "2"), "--pose: length of the quaternion: found 2, expected 1");
  EXPECT_EQ(error("inf", "1"), "--pose: transform: found inf, expected finite numbers");
  EXPECT_EQ(error("1", "nan"), "--pose: transform: found nan, expected finite numbers");
}

TEST_F(Options, DoesWhatIsChosenOnceAllIsRead) {
  EXPECT_EQ(run({"rest", "on"}), 0) << "an action that returns nothing";
  EXPECT_TRUE(rested);
  rested = false;
  EXPECT_EQ(run({"rest"}), 2);
  EXPECT_THAT(err, HasSubstr("A command is required"));
  EXPECT_EQ(run({"rest", "on", "--bogus"}), 2);
  EXPECT_THAT(err, HasSubstr("--bogus"));
  EXPECT_EQ(run({"rest", "on", "--help"}), 0);
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_THAT(out, HasSubstr("glovebench "));
  EXPECT_FALSE(rested);
}

}  // namespace
}  // namespace glovebench::eval
