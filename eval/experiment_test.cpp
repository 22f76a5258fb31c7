// The same plan twice, on one thread and two: files that depend on the results are equal byte for byte.
#include "eval/experiment.h"

#include <gmock/gmock.h>

#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

/// Six frames, two databases, two noise seeds.
Plan make_plan() {
  const auto trajectory = std::make_shared<const trajectories::Trajectory>(
      trajectories::parse_trajectory(make_trajectory_json("six", 6).dump(), "test"));
  Plan plan{profile("paper"), {}};
  for (const uint64_t seed : {1, 2})
    for (const char* database : {"DB_open_pinch", "DB_open_power"})
      plan.specs.push_back({.trajectory = trajectory, .seed = seed, .database = database, .tracker = plan.tracker});
  return plan;
}

struct PlanRun {
  reports::RunResult result;
  std::map<std::string, std::string> files;  ///< report and robot commands, without times
};
PlanRun run_plan(const std::string& folder, int threads) {
  Workbench workbench(test_workbench(threads));
  const Outcome outcome = carry_out(workbench, make_plan(), {folder + "/robot"}, folder);
  return {outcome.result, read_timeless(folder)};
}

TEST(ExperimentsLong, ReportsDependOnNeitherThreadsNorTheDay) {
  const std::string folder = test_folder();
  const PlanRun one = run_plan(folder + "/one", 1);
  const PlanRun two = run_plan(folder + "/two", 2);
  const PlanRun again = run_plan(folder + "/again", 2);
  EXPECT_TRUE(one.result == two.result);
  for (const PlanRun* other : {&two, &again}) {
    ASSERT_EQ(one.files.size(), other->files.size());
    for (const auto& [name, content] : one.files) {
      ASSERT_TRUE(other->files.contains(name)) << name;
      EXPECT_TRUE(content == other->files.at(name)) << name;
    }
  }
}

TEST(ExperimentsLong, HoldWhatWasPlanned) {
  const std::string folder = test_folder();
  const PlanRun run = run_plan(folder, 2);
  ASSERT_EQ(run.result.experiments.size(), 2U) << "one a database; the seeds are runs of it";
  for (const reports::ExperimentResult& experiment : run.result.experiments) {
    EXPECT_EQ(experiment.key.trajectory, "six");
    EXPECT_EQ(experiment.coverage.frames, 12);
    EXPECT_EQ(experiment.coverage.covered, 12) << experiment.key.database;
    ASSERT_EQ(experiment.runs.size(), 2U);
    EXPECT_EQ(experiment.runs[0].seed, 1U);
    EXPECT_EQ(experiment.runs[1].seed, 2U);
    EXPECT_FALSE(experiment.runs[0].frames == experiment.runs[1].frames) << "other seed, other noise";
    EXPECT_EQ(run.files.count("tables/frames_" + to_string(experiment.key) + ".csv"), 1U);
    ASSERT_TRUE(experiment.commands.has_value());
    EXPECT_EQ(experiment.commands->frames, 12);
    EXPECT_EQ(experiment.commands->sent, (std::array<int, kCountOf<CommandState>>{12, 0, 0}));
    EXPECT_NEAR(*experiment.commands->rate_hz, 15, 1e-3);
    EXPECT_EQ(experiment.commands->errors.joints_deg.count, 12);
    EXPECT_GT(*experiment.commands->errors.position_mm.mean, 0) << "the tracker is not that good";
    EXPECT_LT(*experiment.commands->errors.position_mm.mean, 20);
    for (const char* seed : {"1", "2"}) {
      const std::string robot = "robot/" + to_string(experiment.key) + "_seed" + seed + ".jsonl";
      ASSERT_EQ(run.files.count(robot), 1U) << robot;
      EXPECT_EQ(std::count(run.files.at(robot).begin(), run.files.at(robot).end(), '\n'), 6) << "one a frame";
    }
  }
}

TEST(PlanFigure4, Holds15ExperimentsAgainstEachTruthAndSubject) {
  const Plan plan = plan_figure4(profile("paper"), {});
  std::map<std::pair<trajectories::TrajectoryKind, int>, size_t> experiments;
  for (const RunSpec& spec : plan.specs) ++experiments[{spec.trajectory->kind, spec.subject}];
  using enum trajectories::TrajectoryKind;
  const std::map<std::pair<trajectories::TrajectoryKind, int>, size_t> expected = {
      {{recorded, 1}, 15}, {{source, 1}, 15}, {{source, 2}, 15}};
  EXPECT_EQ(experiments, expected);
}

}  // namespace
}  // namespace glovebench::eval
