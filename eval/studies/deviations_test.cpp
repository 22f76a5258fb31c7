#include "eval/studies/deviations.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Row;
using reports::Table;

TEST(Deviations, EachHasItsWordsAndChangesOneValidThing) {
  std::set<std::string_view> names;
  std::set<std::string> changes;
  int measured = 0;
  for (const Deviation& deviation : deviations()) {
    EXPECT_TRUE(names.insert(deviation.name).second) << deviation.name;
    EXPECT_LE(deviation.name.size(), 14U) << deviation.name;
    EXPECT_FALSE(deviation.paper.empty() || deviation.ours.empty() || deviation.instead.empty()) << deviation.name;
    EXPECT_EQ(deviation.instead.starts_with("not measured"), deviation.change == nullptr) << deviation.name;
    if (deviation.change == nullptr) continue;
    RunSpec spec;
    deviation.change(spec);
    EXPECT_THAT(spec.tracker.problems(), testing::IsEmpty()) << deviation.name;
    const std::string content = to_json(spec.tracker).dump() + std::to_string(spec.noise.factor);
    EXPECT_TRUE(changes.insert(content).second) << deviation.name;
    ++measured;
  }
  const RunSpec paper;
  EXPECT_TRUE(changes.insert(to_json(paper.tracker).dump() + std::to_string(paper.noise.factor)).second)
      << "a change changes nothing";
  EXPECT_EQ(measured, 11);
  for (const char* name : {"filter", "cap", "absent colors", "box's ray", "start", "points", "loss gates",
                           "patch layout", "dyes", "noise gain"})
    EXPECT_TRUE(names.contains(name)) << name;
}

/// A movement of two frames with this position error in the first; the second is lost.
MeasuredRun run_of(int movement, const std::string& setting, double position_mm) {
  trajectories::Trajectory trajectory{.name = "Tr" + std::to_string(movement),
                                      .description = "",
                                      .provenance = {},
                                      .frames = {HandFrame{}, HandFrame{1'000'000}}};
  MeasuredRun run;
  run.run.spec.trajectory = std::make_shared<const trajectories::Trajectory>(std::move(trajectory));
  run.run.spec.setting = setting;
  run.errors.resize(2);
  run.errors[0].record["position_error_mm"] = position_mm;
  run.errors[0].record.covered = true;
  return run;
}

const Row& row_of(const Table& table, const std::string& name) {
  const auto row = std::ranges::find(table.rows, Cell(name), [](const Row& each) { return each[0]; });
  EXPECT_NE(row, table.rows.end()) << name;
  return *row;
}
std::string text_of(const Table& table, const Row& row, std::string_view key) {
  const int c = column_index(table, key);
  return cell_text(row[c], table.columns[c]);
}

TEST(Deviations, ChangesAreMeansOverMovementsWithStudentsInterval) {
  Runs runs;
  for (int movement = 1; movement <= 5; ++movement) {
    runs.push_back(run_of(movement, "", 10));
    runs.push_back(run_of(movement, "start", 10 + movement));
    runs.push_back(run_of(movement, "points", 10));
  }
  const Table table = deviations_table(runs);
  ASSERT_EQ(table.rows.size(), deviations().size());
  const Row &start = row_of(table, "start"), &points = row_of(table, "points"), &dyes = row_of(table, "dyes");
  // Means 1 to 5: 3 +- 2.776 * sqrt(2.5 / 5).
  EXPECT_EQ(text_of(table, start, "position_change_mm"), "3.00");
  EXPECT_EQ(text_of(table, start, "position_change_mm_low"), "1.04");
  EXPECT_EQ(text_of(table, start, "position_change_mm_high"), "4.96");
  EXPECT_EQ(text_of(table, start, "rotation_change_deg"), "-") << "no frame has one";
  EXPECT_EQ(text_of(table, start, "covered_percent"), "50.0");
  EXPECT_EQ(text_of(table, points, "position_change_mm"), "0.00");
  EXPECT_EQ(text_of(table, points, "position_change_mm_low"), "-") << "nothing changes";
  for (size_t c = 4; c < dyes.size(); ++c) EXPECT_TRUE(std::holds_alternative<std::monostate>(dyes[c]));
}

TEST(DeviationsLong, AQuickRunMeasuresEachOnAStretch) {
  Workbench workbench(test_workbench());
  const StudyOptions options = quick_options();
  const reports::StudyResult result = run_deviations({workbench, options});
  EXPECT_TRUE(result.measures.empty());
  const Table& table = result.tables.at(0);
  const auto number = [&](const std::string& name, std::string_view key) {
    return std::get<double>(row_of(table, name)[column_index(table, key)]);
  };
  for (const Deviation& deviation : deviations()) {
    if (deviation.change == nullptr) continue;
    EXPECT_GT(number(std::string(deviation.name), "covered_percent"), 0) << deviation.name;
    EXPECT_EQ(text_of(table, row_of(table, std::string(deviation.name)), "position_change_mm_low"), "-")
        << "one movement has no interval";
  }
  EXPECT_GT(number("filter", "position_change_mm"), 0) << "it lags";
  EXPECT_EQ(number("filter", "posture_change_deg"), 0) << "the same posture";
  EXPECT_EQ(number("loss gates", "position_change_mm"), 0) << "no frame of the stretch is lost";
  for (const char* name : {"box's ray", "start", "points", "noise gain", "cap", "weights"})
    EXPECT_NE(number(name, "position_change_mm"), 0) << name;
}

}  // namespace
}  // namespace glovebench::eval
