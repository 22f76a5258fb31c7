#include "reports/command_tables.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "reports/example_result.h"
#include "reports/page/page.h"

namespace glovebench::reports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> headings_of_table(const Table& table) {
  std::vector<std::string> headings;
  for (const Column& column : table.columns) headings.push_back(column.heading);
  return headings;
}

std::vector<std::string> texts_of_row(const Table& table, size_t row) {
  std::vector<std::string> texts;
  for (size_t c = 0; c < table.columns.size(); ++c)
    texts.push_back(cell_text(table.rows[row][c], table.columns[c]));
  return texts;
}

TEST(CommandTables, HaveARowForEachExperimentWithCommands) {
  const RunResult result = small_result();
  const Table stream = command_stream_table(result), errors = command_error_table(result);
  ASSERT_EQ(stream.rows.size(), 1U) << "the other three have none";
  EXPECT_THAT(texts_of_row(stream, 0), ElementsAre("Tr4", "DB_open_power", "recorded", "gradient x 1", "4", "4",
                                                   "30.0", "33", "2", "2", "0"));
  const Table interventions = command_intervention_table(result);
  EXPECT_THAT(headings_of_table(interventions),
              ElementsAre("trajectory", "database", "truth", "noise", "arm_speed", "hold"));
  ASSERT_EQ(interventions.rows.size(), 1U);
  EXPECT_THAT(texts_of_row(interventions, 0),
              ElementsAre("Tr4", "DB_open_power", "recorded", "gradient x 1", "1", "2"));
  ASSERT_EQ(errors.rows.size(), 1U);
  EXPECT_THAT(texts_of_row(errors, 0),
              ElementsAre("Tr4", "DB_open_power", "recorded", "gradient x 1", "4.50 (5.85)", "4.50 (5.85)",
                          "4.50 (5.85)", "-", "2000000 (50000)", "150.5 (8.0)"));
  for (const Table* table : {&stream, &errors}) EXPECT_EQ(table->columns.size(), table->rows[0].size());
}

TEST(CommandTables, SayThatNothingIntervened) {
  RunResult result = small_result();
  result.experiments[0].commands->interventions = {};
  EXPECT_TRUE(command_intervention_table(result).rows.empty());
  EXPECT_THAT(summary_markdown(result, paper_numbers()), HasSubstr("Nothing intervened."));
  EXPECT_THAT(html_page(result, paper_numbers()), HasSubstr("<h3>Interventions</h3>\n<p>None.</p>"));
}

TEST(CommandTables, CsvHasEveryIntervention) {
  const std::string csv = commands_csv(small_result());
  const std::string heading = csv.substr(0, csv.find('\n')), row = csv.substr(csv.find('\n') + 1);
  EXPECT_EQ(std::ranges::count(heading, ','), std::ranges::count(row, ','));
  for (const Intervention kind : all_values<Intervention>())
    EXPECT_THAT(heading, HasSubstr(fmt::format("interventions_{}", to_string(kind))));
  EXPECT_THAT(row, HasSubstr("Tr4,DB_open_power,recorded,1,gradient,1.0,4,2,2,0,30.0,33.333,"));
}

TEST(CommandTables, LatencyIsOfTheExperimentsThatHaveOne) {
  const RunResult result = small_result();
  Timings timings;
  timings.experiments = {{result.experiments[0].key, 1, {}, {1, 2, 3}},
                         {result.experiments[1].key, 1, {}, {}},
                         {{"Tr9", "DB_open_power", TruthKind::source, 1, {}}, 1, {}, {1}}};
  const Table table = command_latency_table(result, timings);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_THAT(texts_of_row(table, 0),
              ElementsAre("Tr4", "DB_open_power", "recorded", "gradient x 1", "2.00", "2.98", "3.00"));
}

TEST(CommandTables, PageAndSummaryHaveASectionWhereThereAreCommands) {
  const RunResult with = small_result();
  RunResult without = with;
  without.experiments[0].commands.reset();
  Timings timings;
  timings.experiments = {{with.experiments[0].key, 1, {}, {1, 2, 3}}};
  EXPECT_THAT(html_page(with, paper_numbers(), timings), HasSubstr("From frame to command"));
  EXPECT_THAT(html_page(with, paper_numbers()), HasSubstr("<h2>Robot commands</h2>"));
  EXPECT_THAT(html_page(with, paper_numbers()), Not(HasSubstr("From frame to command")));
  EXPECT_THAT(html_page(without, paper_numbers(), timings), Not(HasSubstr("Robot commands")));
  EXPECT_THAT(summary_markdown(with, paper_numbers()), HasSubstr("## Robot commands"));
  EXPECT_THAT(summary_markdown(without, paper_numbers()), Not(HasSubstr("Robot commands")));
}

}  // namespace
}  // namespace glovebench::reports
