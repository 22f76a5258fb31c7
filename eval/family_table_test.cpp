#include "eval/family_table.h"

#include <gmock/gmock.h>

#include "eval/command_test.h"

namespace glovebench::eval {
namespace {

using testing::HasSubstr;

/// A movement of two frames, of which the first is tracked with that position error and the other lost.
MeasuredRun movement_of(const std::string& family, int seed, std::optional<double> position_mm) {
  trajectories::Trajectory movement{.name = fmt::format("{}_{}", family, seed),
                                    .description = "",
                                    .provenance = {},
                                    .frames = {HandFrame{}, HandFrame{1'000'000}}};
  MeasuredRun run;
  run.run.spec = {.trajectory = std::make_shared<const trajectories::Trajectory>(movement),
                  .database = "DB_open_power",
                  .setting = family};
  run.errors.resize(2);
  if (position_mm) {
    run.errors[0].record.status = TrackStatus::tracked;
    run.errors[0].record.covered = *position_mm < 50;
    run.errors[0].record["position_error_mm"] = *position_mm;
  }
  run.errors[1].record.false_lost = true;
  for (reports::FrameErrors& errors : run.errors) errors.record["visible_percent"] = 100;
  return run;
}

/// The cells of a column and its interval, in text.
std::vector<std::string> cells_of(const reports::Table& table, const reports::Row& row, std::string_view key) {
  std::vector<std::string> cells;
  for (int c = column_index(table, key); cells.size() < 3; ++c)
    cells.push_back(cell_text(row[c], table.columns[c]));
  return cells;
}

TEST(FamilyTable, HasMeansAndIntervalsOverMovements) {
  std::vector<MeasuredRun> runs;
  for (int i = 1; i <= 5; ++i) runs.push_back(movement_of("side", i, i));
  runs.push_back(movement_of("side", 6, std::nullopt));
  runs.push_back(movement_of("palm", 1, 60));
  runs.push_back(movement_of("", 1, 1));  // of no family
  const reports::Table table = family_table(runs).value().tables.at(0);
  ASSERT_EQ(table.rows.size(), 2U);
  const reports::Row &side = table.rows[0], &palm = table.rows[1];
  EXPECT_EQ(std::get<std::string>(side[0]), "side");
  EXPECT_EQ(std::get<int64_t>(side[column_index(table, "movements")]), 6);
  EXPECT_EQ(std::get<int64_t>(side[column_index(table, "frames")]), 12);
  // Means 1 to 5: 3 +- 2.776 * sqrt(2.5 / 5). The sixth movement has no tracked frame.
  EXPECT_THAT(cells_of(table, side, "position_error_mm"), testing::ElementsAre("3.00", "1.04", "4.96"));
  // Five movements with 50% and one with 0: 41.7 +- 2.571 * 20.41 / sqrt(6).
  EXPECT_THAT(cells_of(table, side, "found_percent"), testing::ElementsAre("41.7", "20.2", "63.1"));
  EXPECT_THAT(cells_of(table, side, "false_lost_percent"), testing::ElementsAre("50.0", "-", "-"))
      << "all are equal";
  EXPECT_THAT(cells_of(table, palm, "position_error_mm"), testing::ElementsAre("60.00", "-", "-"))
      << "one movement";
  EXPECT_THAT(cells_of(table, palm, "found_percent"), testing::ElementsAre("0.0", "-", "-"));
  EXPECT_THAT(cells_of(table, palm, "rotation_error_deg"), testing::ElementsAre("-", "-", "-"));
}

TEST(FamilyTable, PersonsShareARowInWhichAMovementCountsOnce) {
  std::vector<MeasuredRun> runs;
  const auto add = [&runs](int seed, int subject) {
    runs.push_back(movement_of("side", seed, seed));
    runs.back().run.spec.subject = subject;
  };
  add(1, 4), add(2, 3), add(3, 22);
  add(1, 5);             // again the first movement
  add(1, 1), add(2, 2);  // the tracker's mesh
  const reports::Table table = family_table(runs).value().tables.at(0);
  std::vector<std::pair<std::string, int64_t>> rows;
  for (const reports::Row& row : table.rows)
    rows.emplace_back(std::get<std::string>(row[column_index(table, "truth")]),
                      std::get<int64_t>(row[column_index(table, "movements")]));
  EXPECT_THAT(rows, testing::ElementsAre(testing::Pair("source, subjects 3 to 22", 3),
                                         testing::Pair("source, subject 5", 1), testing::Pair("source", 1),
                                         testing::Pair("source, second subject", 1)));
}

TEST(FamilyTable, SharesLieBetween0And100) {
  std::vector<MeasuredRun> runs;
  for (int i = 1; i <= 5; ++i) {
    runs.push_back(movement_of("side", i, i));
    runs.back().errors.resize(1);
  }
  runs.push_back(movement_of("side", 6, 1));
  // Five times 100% and once 50%: 91.7 +- 2.571 * 20.41 / sqrt(6) would reach 113.
  const reports::Table table = family_table(runs).value().tables.at(0);
  EXPECT_THAT(cells_of(table, table.rows[0], "found_percent"), testing::ElementsAre("91.7", "70.2", "100.0"));
}

TEST(FamilyTable, AnsweredCountsMovementsWithATrackedFrame) {
  const std::vector<MeasuredRun> runs = {movement_of("side", 1, 3), movement_of("side", 2, std::nullopt)};
  const reports::Table table = family_table(runs).value().tables.at(0);
  EXPECT_EQ(std::get<int64_t>(table.rows[0][column_index(table, "answered_movements")]), 1);
}

TEST(FamilyTable, IsNotThereWithoutFamilies) {
  const std::vector<MeasuredRun> runs = {movement_of("", 1, 1)};
  EXPECT_FALSE(family_table(runs));
}

class FamilyReportLong : public CommandTest {};

TEST_F(FamilyReportLong, StandsInTheReportOfGeneratedMovements) {
  write_file(path("mine.json"), nlohmann::json{{"format", "glovebench-suite"},
                                               {"version", 1},
                                               {"name", "mine"},
                                               {"description", ""},
                                               {"seeds", {1}},
                                               {"experiments",
                                                {{{"family", "above"},
                                                  {"movements", {{"first", 1}, {"count", 5}}},
                                                  {"frames", {{"first", 0}, {"count", 2}}},
                                                  {"databases", {"DB_open_power"}}}}}}
                                    .dump());
  const ProgramRun run = run_glovebench({"run", "--suite", path("mine.json"), "-o", path("out")});
  expect_fine(run);
  EXPECT_THAT(run.out, AllOf(HasSubstr("All: database DB_open_power, truth source, noise gradient x 1.\n"),
                             HasSubstr("\nabove           5      10         5 ")));
  EXPECT_THAT(read_file(path("out/tables/families.csv")), HasSubstr("position_error_mm,position_error_mm_low"));
  for (const char* file : {"out/summary.md", "out/index.html"})
    EXPECT_THAT(read_file(path(file)), HasSubstr("Movements by family")) << file;
  expect_fine(run_glovebench({"compare", path("out"), path("out")}));
  expect_fine(run_glovebench({"explain", path("out"), "1", "-o", path("frame.png")}));
  EXPECT_THAT(refusal(run_glovebench({"run", "--trajectory", "above_1", "--truth", "recorded", "--database",
                                      "DB_open_power", "-o", path("none")})),
              HasSubstr("above_1: truth: found recorded"));
}

}  // namespace
}  // namespace glovebench::eval
