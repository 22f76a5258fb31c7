#include "reports/tables.h"

#include <gmock/gmock.h>

#include "reports/example_result.h"
#include "reports/summary.h"
#include "reports/test_text.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;

TEST(Figure4Table, Golden) {
  EXPECT_EQ(figure4_table(small_result(), paper_numbers(), {}), R"(
Mean errors: position (mm), posture (RMS of 22 angles, deg), rotation (deg); coverage (%). Noise: gradient x 1
                     |     recorded truth      |      source truth       | source, second subject  |      paper
     database DB_    |    mm  post.   rot.  cov.|    mm  post.   rot.  cov.|    mm  post.   rot.  cov.|   mm post.  rot.
---------------------+-------------------------+-------------------------+-------------------------+------------------
Tr4  open_power      |  4.00   3.00   2.00  75.0|     -      -      -     -|     -      -      -   0.0| 3.88  2.60  2.70
---------------------+-------------------------+-------------------------+-------------------------+------------------
Tr1  20_postures     |     -      -      -     -|     -      -      -     -|     -      -      -     -| 7.33 18.01 11.68
)" + 1);
}

TEST(Figure4Table, FitsA120ColumnTerminal) {
  RunResult result = full_result();
  result.experiments[0].aggregates[metric_index("position_error_mm")].mean = 12345.678;
  for (const std::string& line : lines_of(figure4_table(result, paper_numbers(), {})))
    EXPECT_LE(line.size(), 120u) << line;
}

TEST(Figure4Table, BreaksIntoBlocksOnANarrowTerminal) {
  const std::string table = figure4_table(full_result(), paper_numbers(), {}, 80);
  size_t names = 0;
  for (const std::string& line : lines_of(table)) {
    EXPECT_LE(line.size(), 80u) << line;
    names += line.starts_with("Tr4");
  }
  EXPECT_EQ(names, 2U) << "two variants, then the third and the paper";
  for (const char* title : {"recorded truth", "source truth", "source, second subject", "paper"})
    EXPECT_THAT(table, HasSubstr(title));
}

TEST(StudyText, PutsATableThatIsTooWideIntoParts) {
  Table narrow = table_of({"a", "b"});
  narrow.title = "S";
  narrow.explanation = "Both columns.";
  narrow.rows = {{"c", "d"}};
  Table wide = table_of({"family", "truth"}, 2);
  wide.title = "S";
  const std::string heading(30, 'h');
  wide.columns.push_back({"first", heading});
  wide.columns.push_back({"first_low", "low"});
  wide.columns.push_back({"first_high", "high"});
  wide.columns.push_back({"second", heading});
  wide.columns.push_back({"third", heading});
  wide.rows = {{"side", "source", 1.0, 0.5, 1.5, 2.0, 3.0}, {"fast", "source", 4.0, 3.5, 4.5, 5.0, 6.0}};
  const std::string space(26, ' ');
  EXPECT_EQ(study_text({"s", "S", {narrow, wide}, {}}, 80),
            "S\n\nBoth columns.\n\na  b\nc  d\n\nAll: truth source.\n\n"
            "family  " +
                heading + "  " + heading + "\nside    " + space + "1.00  " + space + "2.00\nfast    " + space +
                "4.00  " + space + "5.00\n\nfamily  " + heading + "\nside    " + space + "3.00\nfast    " + space +
                "6.00\n\n");
}

TEST(StudyText, ShowsATableOfNamesAlone) {
  Table names = table_of({"one", "two"}, 2);
  names.rows = {{std::string(50, 'a'), std::string(50, 'b')}, {"c", "d"}};
  EXPECT_THAT(study_text({"s", "S", {names}, {}}, 80),
              AllOf(HasSubstr("one"), HasSubstr("\nc "), HasSubstr("d\n")));
}

TEST(Figure4Table, ShowsOtherNoiseOnRequest) {
  const std::string table = figure4_table(small_result(), paper_numbers(), {"kinect", 0.5});
  EXPECT_THAT(table, HasSubstr("Noise: kinect x 0.5"));
  EXPECT_THAT(table, HasSubstr("400.0"));
  EXPECT_THAT(table, testing::Not(HasSubstr("Tr1")));
}

TEST(Figure4Latex, HasThePapersNumbers) {
  const std::string latex = figure4_latex(small_result(), paper_numbers(), {});
  EXPECT_THAT(latex, testing::StartsWith("% glovebench run 0123456789-" + run_name(small_result()).substr(11) +
                                         ": Figure 4, depth noise gradient x 1\n\\begin{tabular}"));
  EXPECT_THAT(latex, HasSubstr("Tr4 & DB\\_open\\_power & 4.00 & 3.00 & 2.00 & 75.0 & -- & -- & -- & -- & "
                               "-- & -- & -- & 0.0 & 3.88 & 2.60 & 2.70 \\\\\n"));
  EXPECT_THAT(latex, HasSubstr("\\multicolumn{4}{c}{source, second subject} & \\multicolumn{3}{c}{paper} \\\\\n"
                               "\\cmidrule(lr){3-6}\\cmidrule(lr){7-10}\\cmidrule(lr){11-14}"
                               "\\cmidrule(lr){15-17}\n"));
}

TEST(Figure4Csv, OneLineAnExperiment) {
  const std::vector<std::string> lines = lines_of(figure4_csv(small_result(), paper_numbers(), {}));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0],
            "run,experiment,trajectory,database,truth,subject,noise,noise_factor,seeds,frames,coverage,"
            "visible_frames,found,usable,"
            "position_error_mm_mean,position_error_mm_interval_low,position_error_mm_interval_high,"
            "position_error_mm_paper,"
            "posture_rms_deg_mean,posture_rms_deg_interval_low,posture_rms_deg_interval_high,posture_rms_deg_paper,"
            "rotation_error_deg_mean,rotation_error_deg_interval_low,rotation_error_deg_interval_high,"
            "rotation_error_deg_paper,"
            "fingertip_error_mm_mean,fingertip_error_mm_interval_low,fingertip_error_mm_interval_high,"
            "vertex_error_mm_mean,vertex_error_mm_interval_low,vertex_error_mm_interval_high");
  const std::string run = run_name(small_result());
  EXPECT_THAT(lines[1],
              testing::StartsWith(run + ",Tr4_DB_open_power_recorded_subject1_gradient_1,Tr4,DB_open_power,"
                                        "recorded,1,gradient,1.0,2,4,0.75,4,0.75,0.75,4.0,"));
  EXPECT_THAT(lines[1], HasSubstr(",3.8814,3.0,"));
  EXPECT_EQ(lines[2], run +
                          ",Tr4_DB_open_power_source_subject2_gradient_1,Tr4,DB_open_power,source,2,gradient,1.0,"
                          "1,2,0.0,2,0.0,0.0,,,,3.8814,,,,2.6012,,,,2.6955,,,,,,");
  EXPECT_EQ(lines[3], run +
                          ",Tr1_DB_20_postures_source_subject1_gradient_1,Tr1,DB_20_postures,source,1,gradient,1.0,"
                          "0,0,,0,,,,,,7.3316,,,,18.0114,,,,11.6754,,,,,,");
}

/// As `small_result`, but the first experiment is of a user's movement.
RunResult own_result() {
  RunResult result = small_result();
  result.experiments.front().key.trajectory = "wave";
  return result;
}

TEST(Metrics, HaveATableWithTheirKeys) {
  const RunResult result = small_result();
  const std::vector<std::string> lines = lines_of(metrics_csv(result));
  ASSERT_EQ(lines.size(), 1 + result.experiments.size());
  const Table shown = detail_summary(result);
  for (size_t c = static_cast<size_t>(shown.name_columns) + 1; c < shown.columns.size(); ++c)
    EXPECT_THAT(lines[0], HasSubstr("," + shown.columns[c].key)) << "every column of More metrics";
  EXPECT_EQ(std::ranges::count(lines[1], ','), std::ranges::count(lines[0], ','));
  EXPECT_THAT(lines[1], HasSubstr(fmt::format(",{}", rounded(*result.experiments[0].sequence.jitter_position_mm))));
}

TEST(Summary, BeginsWithTheWarnings) {
  const std::string summary = summary_markdown(small_result(), paper_numbers(), {"wave: no hand * in view"});
  EXPECT_LT(summary.find("**Warning:** wave: no hand \\* in view\n"), summary.find("## "));
}

TEST(Errors, OfOnesOwnRunHaveNoNumbersOfThePaper) {
  EXPECT_TRUE(is_figure4(small_result()));
  EXPECT_FALSE(is_figure4(own_result()));
  RunResult other_hand = small_result();
  other_hand.experiments.front().key.subject = 5;
  EXPECT_FALSE(is_figure4(other_hand));
  EXPECT_FALSE(is_figure4({}));
  const std::vector<std::string> lines = lines_of(errors_csv(own_result()));
  ASSERT_EQ(lines.size(), 5u) << "of any noise";
  EXPECT_THAT(lines[0], testing::Not(HasSubstr("paper")));
  EXPECT_THAT(lines[1],
              HasSubstr(",wave_DB_open_power_recorded_subject1_gradient_1,wave,DB_open_power,recorded,1,"));
  const std::string summary = summary_markdown(own_result(), paper_numbers());
  EXPECT_THAT(summary, testing::AllOf(HasSubstr("## Mean errors"), testing::Not(HasSubstr("Figure 4"))));
  EXPECT_THAT(
      summary,
      HasSubstr(
          "| wave | DB_open_power | recorded | gradient x 1 | 4.00 | 3.00 | 2.00 | 6.00 | 5.00 | 75.0 | 75.0 |"));
  EXPECT_THAT(summary, testing::Not(testing::AnyOf(HasSubstr("3.88"), HasSubstr("7.33"))));
  EXPECT_THAT(errors_latex(own_result()), HasSubstr(": mean errors\n\\begin{tabular}{llllrrrrrrr}"));
}

TEST(HeadlineText, NamesWhatTheExperimentsShareAndFits80Columns) {
  RunResult result = own_result();
  result.experiments.resize(1);
  EXPECT_EQ(headline_text(result, 80), R"(
Mean errors of the tracked frames: position, posture (RMS over the 22 joint
angles), rotation, fingertips, vertices. Of the frames in which at least 30% of
the hand is visible, lost ones included: found within 50 mm and 30 degrees;
usable within 10 mm and 10 degrees, fingertips within 20 mm.
All: database DB_open_power, truth recorded, noise gradient x 1.

trajectory  pos. mm  post. deg  rot. deg  tips mm  vert. mm  found %  usable %
wave           4.00       3.00      2.00     6.00      5.00     75.0      75.0
)" + 1);
  for (const RunResult& each : {own_result(), full_result()})
    for (const std::string& line : lines_of(headline_text(each, 80))) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_THAT(headline_text(own_result(), 80), HasSubstr("\nTr1, DB_20_postures, source, gradient x 1\n"));
}

TEST(RunName, DiffersWithAnythingThatChangesTheResults) {
  const std::string name = run_name(small_result());
  EXPECT_EQ(name, run_name(small_result()));
  EXPECT_THAT(name, testing::MatchesRegex("0123456789-[0-9a-f]{8}"));
  RunResult other = small_result();
  other.configuration["profile"] = "other";
  EXPECT_NE(run_name(other), name);
  other = small_result();
  other.inputs.truths["source/Tr1"] = "00fe";
  EXPECT_NE(run_name(other), name);
  other = small_result();
  other.experiments[0].runs[0].seed = 7;
  EXPECT_NE(run_name(other), name);
}

TEST(FramesCsv, LostFramesHaveEmptyCells) {
  const std::vector<std::string> lines = lines_of(frames_csv("a-1", small_result().experiments[0]));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_THAT(lines[0], testing::StartsWith("run,experiment,seed,frame,timestamp_us,status,covered,"));
  EXPECT_THAT(lines[1], testing::StartsWith("a-1,Tr4_DB_open_power_recorded_subject1_gradient_1,1,0,0,tracked,true,"
                                            "false,false,false,true,20,3.0,1.0,2.0,1.0,1.0,1.0,1.0,,1.0,3.75,"
                                            "4.5,3.75,1.0,1.0"));
  const auto metrics = std::ssize(frame_metrics());
  const size_t visible = metric_index("visible_percent");
  EXPECT_EQ(
      lines[2],
      "a-1,Tr4_DB_open_power_recorded_subject1_gradient_1,1,1,66666,poor_match,false,false,true,false,false,0" +
          std::string(visible + 1, ',') + "100.0" + std::string(static_cast<size_t>(metrics) - visible - 1, ','));
  for (const std::string& line : lines) EXPECT_EQ(std::ranges::count(line, ','), 11 + metrics) << line;
}

TEST(CurveCsv, StandsBesideThePapersCurve) {
  PaperCurve paper = paper_numbers().figure_5;
  paper.frames.resize(1);
  const std::vector<std::string> lines = lines_of(curve_csv("a-1", small_result().experiments[0], paper));
  ASSERT_EQ(lines.size(), 5u);
  const std::string names = "a-1,Tr4_DB_open_power_recorded_subject1_gradient_1,";
  EXPECT_EQ(lines[1], names + "1,0,0,tracked,3.0,2.0,1.0,3.48071,1.47e-13,4.35094");
  EXPECT_EQ(lines[2], names + "1,1,66666,poor_match,,,,,,") << "lost, and the paper's curve has ended";
}

TEST(Summary, TablesInMarkdown) {
  const std::string markdown = summary_markdown(small_result(), paper_numbers());
  EXPECT_THAT(markdown, HasSubstr("| Tr4 | DB_open_power | 4.00 / 3.00 / 2.00, 75.0% | - | - / - / -, 0.0% | "
                                  "3.88 / 2.60 / 2.70 |\n"));
  EXPECT_THAT(markdown, HasSubstr("| Tr1 | DB_20_postures | - | - | - | 7.33 / 18.01 / 11.68 |\n"));
  EXPECT_THAT(markdown, HasSubstr("Noise: gradient x 1."));
  EXPECT_THAT(markdown, HasSubstr(small_result().protocol.id()));
  EXPECT_THAT(markdown, HasSubstr("| kinect x 0.5 | 400.00 |"));
}

}  // namespace
}  // namespace glovebench::reports
