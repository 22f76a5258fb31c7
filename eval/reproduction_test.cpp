#include "eval/reproduction.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <thread>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "eval/program.h"
#include "eval/run_bytes.h"
#include "eval/test_program.h"
#include "reports/results_json.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

ReproductionOptions only(std::vector<std::string> parts) {
  ReproductionOptions options;
  options.study.tracker = profile("paper");
  options.only = std::move(parts);
  return options;
}

TEST(Reproduction, RefusesUnknownParts) {
  EXPECT_THAT(
      [] {
        plan_reproduction(only({"fig8", "fig10"}));
      },
      testing::ThrowsMessage<Error>(AllOf(HasSubstr("fig10"), HasSubstr("fig4, fig5, fig6, fig7"))));
  EXPECT_THAT([] { study("fig4"); }, testing::ThrowsMessage<Error>(HasSubstr("fig7")));
}

TEST(Reproduction, FiguresFiveAndSixAreOneExperimentEach) {
  const Plan plan = plan_reproduction(only({"fig6", "fig5"}));
  ASSERT_EQ(plan.specs.size(), 2U);
  EXPECT_EQ(to_string(key_of(plan.specs[0])), "Tr4_DB_open_power_recorded_subject1_gradient_1");
  EXPECT_EQ(to_string(key_of(plan.specs[1])), "Tr1_DB_20_postures_recorded_subject1_gradient_1");
  EXPECT_EQ(plan_reproduction(only({"fig5", "fig4"})).specs.size(), 45U) << "Figure 4 contains Figure 5";
  EXPECT_TRUE(plan_reproduction(only({"fig7"})).specs.empty());
}

TEST(Reproduction, TheLiteralReadingIsThereOnRequestAlone) {
  Workbench workbench(test_workbench());
  EXPECT_THAT(describe_reproduction(workbench, only({})), testing::Not(HasSubstr("paper-literal")));
  const ReproductionOptions literal = only({"paper-literal"});
  EXPECT_THAT(describe_reproduction(workbench, literal), testing::StartsWith("paper-literal "));
  EXPECT_EQ(exit_code_of({.not_run = 3}, literal, true), 0) << "Figure 4 itself was not asked for";
}

TEST(Reproduction, DeviationsAreThereOnRequestAlone) {
  Workbench workbench(test_workbench());
  EXPECT_THAT(describe_reproduction(workbench, only({})), testing::Not(HasSubstr("deviations")));
  EXPECT_THAT(describe_reproduction(workbench, only({"deviations"})), testing::StartsWith("deviations "));
}

TEST(ReproductionLong, TheLiteralReadingStandsBesideThePapers) {
  Workbench workbench(test_workbench());
  ReproductionOptions options = only({"paper-literal"});
  options.study.quick = true;
  const Outcome outcome = reproduce(workbench, options, {}, test_folder() + "/out");
  ASSERT_EQ(outcome.result.studies.size(), 1U);
  EXPECT_TRUE(outcome.result.experiments.empty() && outcome.result.studies[0].measures.empty());
  const reports::Table& table = outcome.result.studies[0].tables.at(0);
  ASSERT_EQ(table.rows.size(), 18U) << "three databases of Tr4, against recorded and source truth and subject 2";
  const auto number = [&](size_t row, std::string_view key) {
    return std::get<double>(table.rows[row][column_index(table, key)]);
  };
  for (size_t paper = 0; paper < table.rows.size(); paper += 2) {
    const size_t literal = paper + 1;
    EXPECT_EQ(std::get<std::string>(table.rows[literal][column_index(table, "profile")]), "paper-literal");
    EXPECT_GT(number(literal, "position_error_mm"), number(paper, "position_error_mm")) << "it lags";
    EXPECT_NEAR(number(literal, "posture_rms_deg"), number(paper, "posture_rms_deg"), 1e-9) << "the same posture";
  }
}

TEST(Reproduction, QuickOnesAreAStretch) {
  ReproductionOptions options = only({});
  options.study.quick = true;
  const Plan plan = plan_reproduction(options);
  EXPECT_TRUE(plan.quick);
  for (const RunSpec& spec : plan.specs) EXPECT_LT(frames_of(spec).size(), 30U);
}

TEST(Reproduction, TrajectoriesAloneMeanFigure4) {
  Workbench workbench(test_workbench());
  ReproductionOptions options = only({});
  EXPECT_THAT(describe_reproduction(workbench, options),
              AllOf(HasSubstr("45 runs, 5904 frames"), HasSubstr("\nfig9 "), HasSubstr("\nmonocular "),
                    HasSubstr("\ntogether ")));
  options.trajectories = {"Tr4"};
  EXPECT_THAT(describe_reproduction(workbench, options),
              AllOf(HasSubstr("9 runs, 1053 frames"), testing::Not(HasSubstr("fig7"))));
  options.only = {"fig7"};
  EXPECT_THAT(describe_reproduction(workbench, options),
              AllOf(HasSubstr("fig7 "), HasSubstr("9 runs, 1053 frames")));
  options.only = {"fig5", "fig6"};
  EXPECT_EQ(plan_reproduction(options).specs.size(), 10U) << "Figure 5 is of Tr4, Figure 6 is not";
}

TEST(Reproduction, ExitCodes) {
  const ReproductionOptions all = only({}), figure4 = only({"fig4"}), figure7 = only({"fig7"});
  ReproductionOptions one_movement = all;
  one_movement.trajectories = {"Tr4"};
  EXPECT_EQ(exit_code_of({.hold = 3}, all, true), 0);
  EXPECT_EQ(exit_code_of({.hold = 2, .inconclusive = 1}, all, true), 0);
  EXPECT_EQ(exit_code_of({.hold = 1, .inconclusive = 1, .failed = 1}, all, true), 1);
  EXPECT_EQ(exit_code_of({.failed = 1, .not_run = 2}, one_movement, true), 1);
  EXPECT_EQ(exit_code_of({.hold = 2, .not_run = 1}, all, true), 3) << "an absent measure is not a pass";
  EXPECT_EQ(exit_code_of({.not_run = 3}, figure4, true), 3);
  EXPECT_EQ(exit_code_of({.not_run = 3}, figure7, true), 0) << "nobody asked for them";
  EXPECT_EQ(exit_code_of({.not_run = 3}, one_movement, true), 0);
  EXPECT_EQ(exit_code_of({.not_run = 3}, all, false), 0) << "quick, or another configuration";
}

reports::StudyResult example_study() {
  reports::StudyResult study{"fig0", "Figure 0", {}, {}};
  study.tables.push_back({"figure0",
                          "A table",
                          "Explained.",
                          {{"name", "name"}, {"count", "count", 0}, {"time_ms", "ms", 3, true}},
                          1,
                          {{"a", int64_t{3}, 1.0 / 3}, {"b", {}, -1e-300}}});
  study.measures = {{"fig0.value", "mm", 2.0 / 3, reports::ConfidenceInterval{0.1, 0.9, 0.95, 1, 4, 15, "frames"}},
                    {"fig0.nothing", "", {}, {}, true}};
  return study;
}

TEST(StoredStudy, ComesBackToTheLastBit) {
  const auto read = study_from_bytes(to_bytes(example_study()));
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(*read == example_study());
}

TEST(StoredStudy, EveryInputIsInItsKey) {
  const auto key_of_options = [](const std::function<void(StudyOptions&)>& change) {
    Workbench workbench(test_workbench());
    StudyOptions options = quick_options();
    change(options);
    return study_key(workbench, "fig7", options);
  };
  const auto key_of_workbench = [](const std::function<void(WorkbenchConfig&)>& change) {
    WorkbenchConfig config = test_workbench();
    change(config);
    Workbench workbench(config);
    return study_key(workbench, "fig7", quick_options());
  };
  Workbench workbench(test_workbench());
  const std::string key = study_key(workbench, "fig7", quick_options());
  EXPECT_EQ(key_of_workbench([](auto& config) { config.threads = 1; }), key) << "threads change nothing";
  std::set<std::string> keys = {
      key,
      study_key(workbench, "fig8", quick_options()),
      key_of_options([](auto& options) { options.tracker.icp.max_points = 500; }),
      key_of_options([](auto& options) { options.tracker.segmentation.color_space = ColorSpace::rgb; }),
      key_of_options([](auto& options) { options.seeds = {2}; }),
      key_of_options([](auto& options) { options.quick = false; }),
      key_of_options([](auto& options) { options.cascades = {parse_cascade("64:3")}; }),
      key_of_workbench([](auto& config) { config.side = Side::left; }),
      key_of_workbench([](auto& config) { config.hand = MeasuredHand{.shape = second_subject()}; }),
      key_of_workbench([](auto& config) { config.memory = DatabaseMemory::low; }),
      key_of_workbench([](auto& config) { config.views.distance += 0.01; }),
      key_of_workbench([](auto& config) { config.calibration = nominal_kinect_calibration(); }),
      key_of_workbench([](auto& config) { config.calibration.T_rgb_ir.translation().x() += 0.001; }),
  };
  EXPECT_EQ(keys.size(), 13U);

  const std::string share = test_folder() + "/share";
  fs::copy(share_folder(), share, fs::copy_options::recursive);
  setenv("GLOVEBENCH_SHARE", share.c_str(), 1);
  EXPECT_EQ(key_of_options([](auto&) {}), key) << "the same data elsewhere";
  for (const char* file : {"recorded/Tr1.json", "sources/Tr5.json", "gestures.csv"}) {
    write_file(share + "/trajectories/data/" + file, read_file(share + "/trajectories/data/" + file) + "\n");
    keys.insert(key_of_options([](auto&) {}));
  }
  unsetenv("GLOVEBENCH_SHARE");
  EXPECT_EQ(keys.size(), 16U);
}

TEST(StoredStudy, HalfOfOneIsNone) {
  const std::string bytes = to_bytes(example_study());
  for (size_t at = 0; at < bytes.size(); ++at)
    EXPECT_FALSE(study_from_bytes(bytes.substr(0, at)).has_value()) << at;
}

/// Quick Figure 7 and tracker without depth, in their own processes.
class KilledReproductionLong : public testing::Test {
 protected:
  std::vector<std::string> reproduce_into(const std::string& name) const {
    return {"reproduce", "--quick", "--only", "fig5,fig7,monocular", "--output", folder_ + "/" + name};
  }
  bool has_stored(const std::string& name) const {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ + "/" + name + "/.unfinished", ignored))
      if (entry.path().extension() == ".stored") return true;
    return false;
  }

  const std::string folder_ = test_folder();
};

TEST_F(KilledReproductionLong, JudgesNoClaimAndResumesToTheSameResults) {
  const ProgramRun undisturbed = run_glovebench(reproduce_into("undisturbed"));
  ASSERT_EQ(undisturbed.exit_code, 0);
  EXPECT_THAT(undisturbed.out, HasSubstr("no claim is judged"));
  EXPECT_LT(undisturbed.out.find("Figure 7"), undisturbed.out.find("no claim is judged"))
      << "shown when it is there";
  EXPECT_FALSE(fs::exists(folder_ + "/undisturbed/claims.json"));
  const reports::RunResult result = reports::read_results(folder_ + "/undisturbed/results.json");
  ASSERT_EQ(result.studies.size(), 2U);
  EXPECT_EQ(result.studies[0].name, "fig7");
  EXPECT_EQ(result.studies[1].name, "monocular");

  const StartedProgram started = start_glovebench(reproduce_into("out"));
  while (!has_stored("out") && !fs::exists(folder_ + "/out/results.json"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(started.process, SIGINT);
  finish_program(started);
  ASSERT_TRUE(has_stored("out")) << "it was interrupted in the middle";
  write_file(folder_ + "/out/.unfinished/other.stored", "of no use, and in nobody's way");
  const ProgramRun resumed = run_glovebench(reproduce_into("out"));
  EXPECT_EQ(resumed.exit_code, 0);
  EXPECT_EQ(read_file(folder_ + "/out/results.json"), read_file(folder_ + "/undisturbed/results.json"));
  EXPECT_FALSE(fs::exists(folder_ + "/out/.unfinished"));
}

}  // namespace
}  // namespace glovebench::eval
