#include "eval/commands/help.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace fs = std::filesystem;

std::string said(const std::vector<std::string>& arguments) {
  const ProgramRun run = run_glovebench(arguments);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  return run.out;
}

std::string said_by(const std::string& shell, const std::string& script) {
  const ProgramRun run = run_program({"/usr/bin/env", shell, "-c", script});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return run.out;
}

const CommandText kProgram = {
    "walker",
    "Walks.",
    {{{"-h", "--help"}, false, "", "Help", {}}},
    {{"walk",
      "Goes\nthere.",
      {{{"-s", "--speed"}, true, "TEXT:{slow,fast}=slow", "the `speed`", {"slow", "fast"}},
       {{"--log"}, true, "TEXT", ".hidden", {}},
       {{"where"}, true, "TEXT:{home}", "to", {"home"}}},
      {}},
     {"rest", "Stays.", {}, {{"on", "As it is.", {}, {}}}}}};

TEST(Completions, OfTheProgramAndOfACommand) {
  EXPECT_EQ(completions(kProgram, {}), "walk\tGoes there.\nrest\tStays.\n-h\tHelp\n--help\tHelp\n");
  EXPECT_EQ(completions(kProgram, {"walk"}), "-s\tthe `speed`\n--speed\tthe `speed`\n--log\t.hidden\nhome\tto\n");
  EXPECT_EQ(completions(kProgram, {"rest"}), "on\tAs it is.\n");
  EXPECT_EQ(completions(kProgram, {"rest", "on"}), "");
}

TEST(Completions, OfAValue) {
  EXPECT_EQ(completions(kProgram, {"walk", "-s"}), "slow\t\nfast\t\n");
  EXPECT_EQ(completions(kProgram, {"walk", "--log"}), "") << "the shell completes file names";
  EXPECT_EQ(completions(kProgram, {"walk", "--log", "rest"}), completions(kProgram, {"walk"}))
      << "a value that is called like a command of the program";
}

TEST(Completions, KnowEveryCommandOfTheProgram) {
  EXPECT_THAT(said({"completion", "words", "--"}), AllOf(HasSubstr("\nrun\t"), HasSubstr("\ncalibrate\t")));
  EXPECT_THAT(said({"completion", "words", "--", "calibrate"}), HasSubstr("colors\t"));
  EXPECT_EQ(said({"completion", "words", "--", "track", "--robot-coupling"}), "series\t\neven\t\n");
}

TEST(Completions, Bash) {
  const std::string program = build_paths::program("glovebench");
  const auto complete = [&](const std::string& words, const std::string& position) {
    return said_by("bash", "source <('" + program + "' completion bash); COMP_WORDS=('" + program + "' " + words +
                               "); COMP_CWORD=" + position + "; _glovebench; printf '%s\\n' \"${COMPREPLY[@]}\"");
  };
  EXPECT_EQ(complete("calib", "1"), "calibrate\n");
  EXPECT_EQ(complete("list tra", "2"), "trajectories\n");
  EXPECT_EQ(complete("track --robot-c", "2"), "--robot-coupling\n");
  EXPECT_EQ(complete("track --robot-coupling ''", "3"), "series\neven\n");
}

TEST(Completions, Zsh) {
  const std::string program = build_paths::program("glovebench");
  // Prints what zsh's functions receive, since there is no line editor.
  const std::string zsh =
      "compdef() {}; _describe() { print -l -- \"${(@P)2}\" }; _files() { print a file }; "
      "source <('" +
      program + "' completion zsh); ";
  const auto complete = [&](const std::string& words, const std::string& position) {
    return said_by("zsh", zsh + "words=('" + program + "' " + words + "); CURRENT=" + position + "; _glovebench");
  };
  EXPECT_THAT(complete("calibrate c", "3"), HasSubstr("\ncolors:"));
  EXPECT_EQ(complete("track --robot-coupling ''", "4"), "series:\neven:\n");
  EXPECT_EQ(complete("track --output ''", "4"), "a file\n");
}

TEST(Completions, Fish) {
  const std::string folder = fs::path(build_paths::program("glovebench")).parent_path();
  const auto complete = [&](const std::string& line) {
    return said_by(
        "fish", "set PATH '" + folder + "' $PATH; glovebench completion fish | source; complete -C '" + line + "'");
  };
  EXPECT_THAT(complete("glovebench calibrate col"), StartsWith("colors\t"));
  EXPECT_EQ(complete("glovebench track --robot-coupling "), "even\nseries\n");
  EXPECT_THAT(complete("glovebench track --output /us"), StartsWith("/usr/")) << "the names of files";
}

TEST(ManPage, HasEveryCommandAndEscapesWhatTheLanguageTakesForItsOwn) {
  const std::string page = man_page(kProgram, "1.2");
  EXPECT_THAT(page, HasSubstr("glovebench 1.2"));
  EXPECT_THAT(page, HasSubstr(".SS walker walk\nGoes there.\n"));
  EXPECT_THAT(page, HasSubstr(".TP\n\\fB\\-s, \\-\\-speed\\fR TEXT:{slow,\\:fast}=slow\nthe \\fBspeed\\fR\n"));
  EXPECT_THAT(page, HasSubstr("\n\\&.hidden\n"));
  EXPECT_THAT(page, HasSubstr(".SS walker rest on\nAs it is.\n"));
  EXPECT_THAT(page, Not(HasSubstr(".SS walker rest\n"))) << "it does nothing by itself";
}

TEST(ManPage, IsReadWithoutWarnings) {
  const std::string page = said({"manual"});
  EXPECT_THAT(page, AllOf(HasSubstr(".SS glovebench calibrate colors"), HasSubstr("\\-\\-robot\\-coupling")));
  EXPECT_THAT(said_by("sh", "'" + build_paths::program("glovebench") + "' manual | groff -man -ww -z"), "");
}

TEST(Help, OfAllCommandsFitsATerminal) {
  std::istringstream lines(said({"--help-all"}));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_GT(count, 300);
}

TEST(Help, OfEveryCommandNamesItsFlags) {
  const std::vector<std::string> tracker = {"--profile", "--config", "--method", "--cascade"};
  const std::vector<std::string> machine = {"--threads", "--cache", "--low-memory", "--quiet"};
  const std::vector<std::string> random = {"--seed"};
  const auto expect_flags = [](std::vector<std::string> command, const std::vector<std::vector<std::string>>& all) {
    command.push_back("--help-all");
    const ProgramRun run = run_glovebench(command);
    EXPECT_EQ(run.exit_code, 0) << command[0];
    EXPECT_EQ(run.err, "");
    for (const auto& flags : all)
      for (const std::string& flag : flags) EXPECT_THAT(run.out, HasSubstr(flag)) << command[0];
  };
  expect_flags({}, {{"reproduce", "run", "record", "render", "track", "explain", "db", "list", "--version"}});
  expect_flags({"reproduce"}, {tracker, machine, random, {"--output", "--trajectory", "--seeds", "--robot-out"}});
  expect_flags({"run"},
               {tracker,
                machine,
                random,
                {"--output", "--trajectory", "--database", "--truth", "--noise", "--gain", "--subject", "--seeds",
                 "--robot-out", "--suite", "--filter", "--list", "--dry-run", "--mcap", "--appearance"}});
  expect_flags({"record"}, {tracker, machine, random, {"--output", "--trajectory", "--database"}});
  expect_flags({"render"}, {tracker,
                            machine,
                            random,
                            {"--output", "--trajectory", "--format", "--appearance", "bop", "exr", "mcap", "tum"}});
  expect_flags({"track"}, {tracker,
                           machine,
                           {"--source", "fakenect:", "freenect", "bag:", "mcap:", "oni:", "tum:", "--topics",
                            "--database", "--output", "--left", "--calibration", "--frames", "--every-frame",
                            "--format", "--overlay", "--page", "--as-fast-as-possible"}});
  expect_flags({"explain"}, {machine, {"run", "frame", "--experiment", "--trajectory", "--output"}});
  expect_flags({"db"}, {{"build", "info"}});
  expect_flags({"db", "build"}, {machine, {"--postures", "--output", "--left"}});
  expect_flags({"list"}, {{"trajectories", "databases", "suites", "methods", "angles", "config"}});
}

}  // namespace
}  // namespace glovebench::eval
