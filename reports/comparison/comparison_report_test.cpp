#include "reports/comparison/comparison_report.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/comparison/comparison_text.h"
#include "reports/comparison/example_comparison.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The small comparison with a name that has a special meaning in every format.
ComparisonReport hostile_comparison() {
  ComparisonReport report = small_comparison();
  Comparison& comparison = report.comparison;
  const std::string name = "a<b>&\"',|`*[x]\n\\x_$%{}\x01\xef\xbf\xbf";
  for (ComparisonRow& row : comparison.rows)
    if (row.experiment != kAllExperiments) row.experiment = name;
  comparison.frames[0].experiment = name;
  comparison.worst[0].key.trajectory = name;
  comparison.candidate.name = name + "\xff";
  comparison.configuration[0].candidate = name;
  comparison.only_in_baseline = {name};
  comparison.uncompared_metrics = {{name, name}};
  report.speed[0].name = name;
  report.pictures = {{name, "png"}};
  return report;
}

TEST(ComparisonText, ReadableNamesLeaveOutWhatGoesWithoutSaying) {
  EXPECT_EQ(readable_experiment("all"), "all experiments");
  EXPECT_EQ(readable_experiment("Tr4_DB_open_power_source_subject1_gradient_1"), "Tr4 open_power, source");
  EXPECT_EQ(readable_experiment("Tr5_DB_open_power_recorded_subject2_kinect_0.5"),
            "Tr5 open_power, recorded, subject 2, kinect x 0.5");
  EXPECT_EQ(readable_experiment("my_own_hands_source_subject1_gradient_1"), "my_own_hands, source");
  for (const char* other : {"", "_", "_____", "a_b_guessed_subject1_gradient_1", "a_b_source_left_gradient_1"})
    EXPECT_EQ(readable_experiment(other), other);
}

TEST(ComparisonText, NumbersFitTheirColumn) {
  EXPECT_EQ(number_text(2.98), "2.980");
  EXPECT_EQ(number_text(std::nullopt), "-");
  EXPECT_EQ(signed_number_text(0.42), "+0.420");
  EXPECT_EQ(signed_number_text(-0.0004), "+0.000");
  for (const double value : {0.0, 999.9994, 999.9996, -99999.4, 99999.6, -1e6, -1e300, 123456.7})
    EXPECT_LE(signed_number_text(value).size(), std::abs(value) < 1e100 ? 9u : 10u) << value;
}

TEST(ComparisonText, OutcomeCountsEveryVerdict) {
  ComparisonReport report = small_comparison();
  EXPECT_EQ(outcome_line(report),
            "2 worse, 1 worse in places, 1 better, 1 same, 1 not enough data; 1 of 2 speed ratios slower");
  report.speed.clear();
  EXPECT_EQ(outcome_line(report), "2 worse, 1 worse in places, 1 better, 1 same, 1 not enough data");
}

TEST(ComparisonText, RowsWorthReading) {
  std::vector<std::string> read;
  for (const ComparisonRow& row : small_comparison().comparison.rows)
    if (is_worth_reading(row)) read.emplace_back(row.metric->key);
  EXPECT_THAT(read, testing::ElementsAre("position_error_mm", "position_error_mm", "rotation_error_deg",
                                         "posture_rms_unfiltered_deg", "uncovered_percent"));
  ComparisonRow row = example_row("a", "position_error_mm", 3, 0, 1, Verdict::not_enough_data);
  EXPECT_FALSE(is_worth_reading(row)) << "unchanged";
  row.difference = 0.1;
  EXPECT_TRUE(is_worth_reading(row));
}

TEST(ComparisonTable, Golden) {
  ComparisonReport report = small_comparison();
  report.comparison.configuration.clear();
  report.speed.clear();
  const std::string table = comparison_table(report, false);
  EXPECT_THAT(table, StartsWith(R"(
baseline  ci/baselines/quick: suite quick, glovebench 0.1.0, commit 105ec9a
candidate out: suite quick, glovebench 0.1.0, commit 82ad045

  quantity                    baseline  candidate  difference          interval  minimum effect  verdict
all experiments
  position_error_mm              3.000      3.250      +0.250  [+0.125, +0.375]           0.100  worse
Tr4 open_power, source
  position_error_mm              3.000      3.500      +0.500  [+0.250, +0.750]           0.100  worse
  rotation_error_deg             4.000      3.500      -0.500  [-0.750, -0.250]           0.100  better
  posture_rms_unfiltered_deg         -          -           -                 -           0.000  not enough data
  uncovered_percent              1.000      3.000      +2.000  [-2.000, +6.000]           1.000  worse in places

)" + 1));
  EXPECT_THAT(table, testing::EndsWith("\n2 worse, 1 worse in places, 1 better, 1 same, 1 not enough data\n"));
  std::string words = table;
  std::ranges::replace(words, '\n', ' ');
  EXPECT_THAT(words, HasSubstr(comparison_explanation(report.comparison)));
  EXPECT_THAT(comparison_table(report, true), HasSubstr("  posture_rms_deg "));
}

TEST(ComparisonTable, FitsTheTerminal) {
  ComparisonReport report = full_comparison();
  ComparisonRow& row = report.comparison.rows[9];
  row.baseline = row.candidate = 123456.789;
  row.difference = row.low = -1e6;
  row.high = 1e6;
  row.verdict = Verdict::not_enough_data;
  report.comparison.candidate.name = std::string(300, 'x');
  report.comparison.rows[12].experiment = std::string(300, 'y');
  report.comparison.rows[12].verdict = Verdict::worse;
  report.comparison.configuration.push_back({std::string(99, 'k'), std::string(99, 'v'), "1"});
  for (const size_t columns : {80, 120})
    for (const std::string& line : lines_of(comparison_table(report, true, columns)))
      EXPECT_LE(line.size(), columns) << line;
}

TEST(ComparisonTable, WhatWouldBeEnoughIsNotCutOff) {
  ComparisonReport report = full_comparison();
  report.times = {true, {{"align", 3, 2}}};
  for (ComparisonRow& row : report.comparison.rows) {
    if (row.metric->key != "posture_rms_unfiltered_deg") continue;
    row.difference = 0.1;
    row.verdict = Verdict::not_enough_data;
    row.enough_frames = 23000;
  }
  EXPECT_THAT(comparison_table(report, false, 80),
              AllOf(HasSubstr("\nTr4 open_power, source\n"
                              "  posture_rms_unfiltered_deg  23000 frames of all seeds, or 99 movements\n"),
                    HasSubstr("\nProcessor times of the same")));
}

TEST(ComparisonTable, NothingToCompareIsStillATable) {
  EXPECT_THAT(comparison_table({}, false), HasSubstr("0 worse, 0 better, 0 same, 0 not enough data\n"));
}

TEST(ComparisonMarkdown, OutcomeFirstThenWhatIsWorthReading) {
  const std::string markdown = comparison_markdown(small_comparison());
  EXPECT_EQ(lines_of(markdown)[0],
            "**2 worse, 1 worse in places, 1 better, 1 same, 1 not enough data; 1 of 2 speed ratios slower**");
  EXPECT_THAT(markdown, HasSubstr("| Tr4 open_power, source | rotation_error_deg | 4.000 | 3.500 | -0.500 | "
                                  "[-0.750, -0.250] | 0.100 | **better** |\n"));
  EXPECT_THAT(markdown, HasSubstr("| segmentation.extra | - | \"a\\|b\" |\n"));
  EXPECT_THAT(markdown, HasSubstr("commit 82ad045"));
  EXPECT_THAT(markdown, HasSubstr("| align | 4.00 | 1.50 | 1.90 | 2.00 | **slower** |\n"));
  const size_t details = markdown.find("<details><summary>1 row without a change");
  ASSERT_NE(details, std::string::npos);
  EXPECT_LT(markdown.find("**worse in places**"), details);
  EXPECT_GT(markdown.find("posture_rms_deg"), details);
}

TEST(ComparisonMarkdown, NamesAreNoMarkup) {
  int rows = 0;
  for (const std::string& line : lines_of(comparison_markdown(hostile_comparison()))) {
    EXPECT_THAT(line, Not(HasSubstr("<b>")));
    if (!line.starts_with("| a&lt;b>") || line.find("_mm |") == std::string::npos) continue;
    ++rows;
    int separators = 0;
    for (size_t i = 0; i < line.size(); ++i) separators += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(separators, 9) << line;
  }
  EXPECT_EQ(rows, 1);
}

TEST(ComparisonJson, HoldsEveryRow) {
  const nlohmann::json json = nlohmann::json::parse(comparison_json(small_comparison()));
  EXPECT_EQ(json["format"], "glovebench-comparison");
  ASSERT_EQ(json["rows"].size(), 6u);
  EXPECT_EQ(json["rows"][1]["difference"], 0.5);
  EXPECT_EQ(json["rows"][1]["low"], 0.25);
  EXPECT_EQ(json["rows"][1]["stops"], true);
  EXPECT_TRUE(json["rows"][4]["difference"].is_null());
  EXPECT_TRUE(json["configuration_changes"][1]["baseline"].is_null());
  EXPECT_TRUE(json["worst_frames"][0]["candidate_vertex_error_mm"].is_null());
  EXPECT_EQ(json["frame_differences"][0]["differences"]["position_error_mm"],
            nlohmann::json::parse("[0.5, null, -0.25]"));
}

TEST(ComparisonJson, AnIntervalOfTooFewFramesIsInNoFile) {
  ComparisonReport report = small_comparison();
  report.comparison.config.family_error = 0.05;
  report.comparison.preselected = {"position_error_mm", "uncovered_percent"};
  report.comparison.rows.back().blocks = 2;
  const nlohmann::json row = nlohmann::json::parse(comparison_json(report))["rows"].back();
  EXPECT_TRUE(row["low"].is_null() && row["high"].is_null());
  EXPECT_EQ(row["difference"], 2);
  EXPECT_THAT(comparison_csv(report),
              testing::EndsWith(",2,1.0,3.0,2.0,,,1.0,,95.0,position_error_mm uncovered_percent\n"));
  EXPECT_THAT(
      comparison_latex(report),
      AllOf(HasSubstr("& too few frames &"),
            HasSubstr("% intervals hold together with 95%; metrics chosen before: position_error_mm, unc")));
}

TEST(ComparisonJson, WhatIsNotANumberIsRefused) {
  ComparisonReport report = small_comparison();
  report.comparison.rows[0].difference = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(comparison_json(report), std::logic_error);
}

TEST(ComparisonJson, NamesOfAnyBytes) {
  const nlohmann::json json = nlohmann::json::parse(comparison_json(hostile_comparison()));
  EXPECT_THAT(json["candidate"]["name"].get<std::string>(), testing::EndsWith("\xef\xbf\xbd"));
}

TEST(ComparisonCsv, OneLineARow) {
  const std::vector<std::string> lines = lines_of(comparison_csv(small_comparison()));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[1],
            "105ec9a-01234567,82ad045-89abcdef,all,position_error_mm,mm,worse,true,234,234,14,3.0,3.25,0.25,0.125,"
            "0.375,0.1,,99.0,");
  EXPECT_EQ(lines[5],
            "105ec9a-01234567,82ad045-89abcdef,Tr4_DB_open_power_source_subject1_gradient_1,posture_rms_unfiltered_"
            "deg,deg,not enough data,false,0,234,"
            "0,,,,,,0.0,,99.0,");
  EXPECT_EQ(std::ranges::count(lines[0], ','), 18);
  EXPECT_THAT(comparison_csv(hostile_comparison()), HasSubstr("89abcdef,\"a<b>&\"\"',|`"));
}

TEST(ComparisonLatex, Tabular) {
  EXPECT_THAT(
      comparison_latex(small_comparison()),
      AllOf(
          StartsWith("% baseline ci/baselines/quick: suite quick, glovebench 0.1.0, commit 105ec9a, run "
                     "105ec9a-01234567\n% candidate out: "),
          HasSubstr("\n% intervals hold together with 99%; metrics: all\n\\begin{tabular}{lllrrrrr}\n\\toprule\n"),
          HasSubstr("Tr4 open\\_power, source & rotation\\_error\\_deg & better & 4.000 & 3.500 & "
                    "$-$0.500 & {[}-0.750, -0.250{]} & 0.100 \\\\\n"),
          HasSubstr("not enough data & -- & -- & -- & -- & 0.000 \\\\\n")));
}

TEST(ComparisonJunit, FailuresSkippedAndPassed) {
  const std::string xml = comparison_junit(small_comparison());
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"glovebench\" tests=\"8\" failures=\"4\" errors=\"0\" "
                             "skipped=\"1\" time=\"0\">\n  <testsuite name=\"all\" tests=\"1\" failures=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"Tr4_DB_open_power_source_subject1_gradient_1\" tests=\"5\" "
                             "failures=\"2\" errors=\"0\" skipped=\"1\" time=\"0\">"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"worse: 3.000 -&gt; 3.500 mm, difference +0.500 [+0.250, +0.750], "
                             "minimum effect 0.100, 234 of 234 frames\"/>"));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"worse in places: 1.000 -&gt; 3.000 %"));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"not enough data: - -&gt; - deg"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"speed\" tests=\"2\" failures=\"1\""));
  EXPECT_THAT(
      xml,
      HasSubstr("<failure message=\"slower: 1.50 times faster than plain, 1.90 at best, was 4.00, limit 2.00\"/>"));
}

TEST(ComparisonJunit, HoldsNoCharacterThatXmlCannot) {
  for (const std::string& xml : {comparison_junit(hostile_comparison()), incomparable_junit("a\x01<\xff\n\"")}) {
    for (const char c : xml) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n');
    EXPECT_THAT(xml, AllOf(Not(HasSubstr("\xef\xbf\xbf")), Not(HasSubstr("\xff\"")), HasSubstr("&#10;")));
  }
  EXPECT_THAT(incomparable_junit("seeds differ"),
              HasSubstr("<testcase name=\"comparable\" classname=\"glovebench.comparison\" time=\"0\">\n"
                        "      <error message=\"seeds differ\"/>"));
}

TEST(ComparisonPage, ShowsVerdictsChartsAndPictures) {
  ComparisonReport report = full_comparison();
  report.pictures = {{"Frame 57 <lost>", "\x89PNG"}};
  const std::string page = comparison_page(report);
  EXPECT_THAT(page, HasSubstr("<span class=\"verdict worse\">worse</span>"));
  EXPECT_THAT(page, HasSubstr("<span class=\"verdict better\">better</span>"));
  EXPECT_THAT(page, HasSubstr("<svg class=\"interval worse\""));
  EXPECT_THAT(page, HasSubstr("<details open><summary>Tr4 open_power, source"));
  EXPECT_THAT(page, HasSubstr("data-chart=\"differences 0\""));
  EXPECT_THAT(page, HasSubstr("<figcaption>Frame 57 &lt;lost&gt;</figcaption>"));
  EXPECT_THAT(page, HasSubstr("<td>57</td><td>1</td><td>3.500</td><td>lost</td>"));
  EXPECT_THAT(page, HasSubstr("icp.max_iterations"));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("http")), Not(HasSubstr("\"nan")), Not(HasSubstr("inf\""))));
  EXPECT_THAT(comparison_page(hostile_comparison()), Not(HasSubstr("<b>&\"")));
  EXPECT_THAT(comparison_page({}), HasSubstr("</html>"));
}

TEST(ComparisonPage, ChartsAreDrawnFromTheDifferences) {
  ComparisonReport report = small_comparison();
  EXPECT_THAT(comparison_page(report), Not(HasSubstr("<script"))) << "none was given";
  report.scripts = {"vega"};
  EXPECT_THAT(comparison_page(report),
              AllOf(HasSubstr("<script>\nvega\n</script>"), HasSubstr("{\"differences\":\"experiment,frame,"),
                    HasSubstr("\\n0,5,0.5,"), HasSubstr("\\n0,6,,"), HasSubstr("\\n0,7,-0.25,")));
  report.comparison.frames[0].differences[0].values = {0, std::nullopt, 0};
  EXPECT_THAT(comparison_page(report), AllOf(Not(HasSubstr("<script")), Not(HasSubstr("data-chart"))));
}

TEST(WriteComparison, WritesEveryFileOrRefuses) {
  const std::string folder = test_folder();
  const std::vector<std::string> names = write_comparison(folder, hostile_comparison());
  EXPECT_THAT(names, testing::ElementsAre("comparison.json", "comparison.md", "comparison.csv", "comparison.tex",
                                          "junit.xml", "index.html"));
  for (const std::string& name : names) EXPECT_GT(fs::file_size(folder + "/" + name), 0u) << name;
  EXPECT_THROW(write_comparison(folder + "/index.html", small_comparison()), Error);
}

TEST(RemoveComparison, RemovesItsOwnFilesAlone) {
  const std::string folder = test_folder();
  write_comparison(folder, small_comparison());
  write_file(folder + "/notes", "the user's");
  remove_comparison(folder);
  EXPECT_FALSE(fs::exists(folder + "/comparison.json") || fs::exists(folder + "/index.html"));
  EXPECT_EQ(read_file(folder + "/notes"), "the user's");
  write_file(folder + "/comparison.json", "of before there were manifests");
  write_refusal(folder, "seeds differ");
  EXPECT_FALSE(fs::exists(folder + "/comparison.json"));
  EXPECT_TRUE(fs::exists(folder + "/comparison.md"));
}

TEST(WriteComparison, LeavesTheFolderOfARun) {
  const std::string folder = test_folder();
  write_file(folder + "/results.json", "results");
  write_file(folder + "/index.html", "the run's");
  EXPECT_THROW(write_comparison(folder, small_comparison()), Error);
  EXPECT_THROW(remove_comparison(folder), Error);
  EXPECT_THROW(write_refusal(folder, "seeds differ"), Error);
  EXPECT_EQ(read_file(folder + "/index.html"), "the run's");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace glovebench::reports
