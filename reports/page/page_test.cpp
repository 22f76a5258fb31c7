#include "reports/page/page.h"

#include <gmock/gmock.h>

#include "reports/example_result.h"
#include "reports/page/section.h"

namespace glovebench::reports {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Made once, since its intervals take a while.
const RunResult& example_page() {
  static const RunResult result = full_result();
  return result;
}

RunResult without_studies(RunResult result) {
  result.studies.clear();
  return result;
}

TEST(Page, ShowsTablesAndPlacesForCharts) {
  const std::string page = html_page(example_page(), paper_numbers());
  EXPECT_THAT(page, HasSubstr("<td>3.88 / 2.60 / 2.70</td>"));
  EXPECT_THAT(page, HasSubstr("<h2>Figure 5: Tr4 with DB_open_power, recorded truth</h2>\n<p>Figure 5 (Tr4 with "
                              "DB_open_power) is a calibration, not evidence"));
  EXPECT_THAT(page, HasSubstr("<h2>Figure 6: Tr1 with DB_20_postures, recorded truth</h2>"));
  for (const char* chart : {"figure4-position", "figure5-rotation", "figure6-posture", "figure7-time", "figure8"})
    EXPECT_THAT(page, HasSubstr("data-chart=\"" + std::string(chart) + "\""));
  EXPECT_THAT(page, AllOf(HasSubstr("href=\"tables/figure5.csv\""), HasSubstr("href=\"tables/figure8.csv\"")));
  EXPECT_THAT(page, Not(HasSubstr("http"))) << "the page needs no other file";
  EXPECT_THAT(page, Not(HasSubstr("<script"))) << "and has no script if it was given none";
}

TEST(Page, LeavesOutWhatWasNotRun) {
  RunResult result = small_result();
  result.experiments.erase(result.experiments.begin());
  const std::string page = html_page(result, paper_numbers());
  for (const char* part : {"figure5", "figure6", "figure7", "id=\"worst\"", "id=\"environment\""})
    EXPECT_THAT(page, Not(HasSubstr(part)));
  result.experiments.clear();
  const std::string empty = html_page(result, paper_numbers());
  EXPECT_THAT(empty, AllOf(HasSubstr("</html>"), HasSubstr("id=\"configuration\"")));
  EXPECT_THAT(empty, Not(AnyOf(HasSubstr("id=\"figure4\""), HasSubstr("id=\"metrics\""))));
}

TEST(Page, LinksLeadToASectionOrAMetric) {
  const std::string page = html_page(example_page(), paper_numbers());
  size_t links = 0;
  for (size_t at = page.find("href=\"#"); at != std::string::npos; at = page.find("href=\"#", at + 1)) {
    const std::string id = page.substr(at + 7, page.find('"', at + 7) - at - 7);
    EXPECT_THAT(page, AnyOf(HasSubstr("<section id=\"" + id + "\">"), HasSubstr("<dt id=\"" + id + "\">")));
    ++links;
  }
  EXPECT_GE(links, 7U);
  EXPECT_THAT(page, HasSubstr("<a href=\"#metric-jitter_position_mm\">jitter mm</a></th>"));
}

TEST(Page, TimesAreShownWithStudiesAlone) {
  Timings timings, slower;
  timings.host = slower.host = "a <host>";
  slower.wall_s = 99;
  const RunResult plain = without_studies(example_page());
  EXPECT_EQ(html_page(plain, paper_numbers(), timings), html_page(plain, paper_numbers(), slower));
  const std::string page = html_page(example_page(), paper_numbers(), slower);
  EXPECT_THAT(page, AllOf(HasSubstr("a &lt;host&gt;"), HasSubstr("99 s")));
}

TEST(Page, NoTextEndsAScriptElement) {
  RunResult result = small_result();
  result.experiments[0].key.trajectory = "</script><b>";
  PageMaterial material;
  material.scripts = {"const a = '</script>', b = /<\\/SCRIPT>/, c = '</SCRIPT>';"};
  const std::string page = html_page(result, paper_numbers(), {}, material);
  EXPECT_THAT(page, HasSubstr("const a = '<\\/script>', b = /<\\/SCRIPT>/, c = '<\\/SCRIPT>';"));
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
  EXPECT_THAT(page, Not(HasSubstr("<b>"))) << "in the tables it is text as well";
}

TEST(Page, ShowsTheWorstFramesWithTheirCommands) {
  PageMaterial material;
  material.worst_frames = {{"Frame 60 <estimate>", "\x89PNG", "glovebench explain . 60 --seed 1"},
                           {"Frame 61", "\xff\xd8\xff", "glovebench explain . 61"}};
  const std::string page = html_page(small_result(), paper_numbers(), {}, material);
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,iVBORw==\"/>"));
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,/9j/\"/>"));
  EXPECT_THAT(page, HasSubstr("<figcaption>Frame 60 &lt;estimate&gt;</figcaption>"));
  EXPECT_THAT(page, HasSubstr("glovebench explain . 60 --seed 1</code>"));
}

TEST(Page, WarnsAndNamesTheFilesThatExplainNeeds) {
  PageMaterial material;
  const std::string plain = html_page(small_result(), paper_numbers(), {}, material);
  EXPECT_THAT(plain, Not(AnyOf(HasSubstr("Warning"), HasSubstr("PATH"))));
  material.warnings = {"wave: <no> hand"};
  material.from_files = {truth_name(small_result().experiments[0].key)};
  EXPECT_THAT(html_page(small_result(), paper_numbers(), {}, material), Not(HasSubstr("glovebench explain")));
  material.worst_frames = {{"Frame 60", "\xff\xd8\xff", ""}};
  const std::string page = html_page(small_result(), paper_numbers(), {}, material);
  EXPECT_LT(page.find("Warning:</strong> wave: &lt;no&gt; hand"), page.find("<nav"));
  EXPECT_THAT(page, AllOf(HasSubstr(" --trajectory PATH/Tr4.json"), HasSubstr("PATH stands for")));
}

TEST(Keyframes, AreWindowsOnTheSheet) {
  // 11 frames in 3 columns: 4 pairs of rows, 8 rows of tiles.
  const FrameSheet sheet{"figure5", "\xff\xd8\xff", 3, 40, 30, 100, 11};
  const std::string html = keyframes_html(sheet);
  for (const int frame : {0, 2, 4, 6, 8, 10})
    EXPECT_THAT(html, HasSubstr("<button type=\"button\" data-frame=\"" + std::to_string(frame) + "\">"));
  EXPECT_THAT(html, HasSubstr("frame 110</button>")) << "named by its number in the trajectory";
  // Frame 4 is in column 1 of 3 and rows 2 and 3 of 8.
  EXPECT_THAT(html, HasSubstr("background-position:50.0000% 28.5714%"));
  EXPECT_THAT(html, HasSubstr("background-position:50.0000% 42.8571%"));
  EXPECT_THAT(sheet_style({sheet}), HasSubstr(".sheet-figure5 { aspect-ratio: 40 / 30; background-size: 300% 800%; "
                                              "background-image: url(data:image/jpeg;base64,/9j/); }"));
  EXPECT_THAT(frame_viewer_html(sheet), HasSubstr("min=\"0\" max=\"10\""));
}

TEST(Keyframes, OfASingleFrameAreOne) {
  const std::string html = keyframes_html({"figure6", "\xff\xd8\xff", 16, 40, 30, 0, 1});
  EXPECT_EQ(html.find("<button"), html.rfind("<button"));
  EXPECT_THAT(html, HasSubstr("background-position:0.0000% 100.0000%"));
}

ExperimentResult experiment(const std::string& trajectory, TruthKind truth, std::vector<FrameRecord> frames) {
  return summarize({trajectory, "DB", truth, 1, {}}, {{7, std::move(frames)}}, pck_curve({}, 0), {},
                   {.resamples = 10});
}

std::vector<std::string> names(const std::vector<WorstFrame>& frames) {
  std::vector<std::string> names;
  for (const WorstFrame& worst : frames)
    names.push_back(worst.key.trajectory + ":" + std::to_string(worst.frame.frame));
  return names;
}

TEST(Gallery, TakesTheLargestOfEachErrorAtMostTwoOfAnExperiment) {
  RunResult result;
  // Frames are 1/15 s apart: 0, 10 and 20 may be chosen together, 11 is too close to 10.
  result.experiments = {
      experiment("A", TruthKind::source,
                 {example_frame(0, 30, 1, 1), example_lost_frame(5), example_frame(10, 40, 1, 1),
                  example_frame(11, 39, 1, 1), example_frame(20, 29, 50, 1)}),
      experiment("B", TruthKind::source, {example_frame(0, 5, 20, 1), example_frame(9, 6, 10, 1)}),
      experiment("C", TruthKind::recorded, {example_frame(0, 99, 99, 1)})};
  const std::vector<WorstFrame> worst = worst_frames(result, 4);
  EXPECT_THAT(names(worst), ElementsAre("A:10", "A:0", "B:0", "B:9"))
      << "A:20 has the largest posture error, but A has two frames already; C is not on source";
  EXPECT_EQ(worst[0].metric, "position_error_mm");
  EXPECT_EQ(worst[2].metric, "posture_rms_deg");
  EXPECT_EQ(worst[0].seed, 7U);
}

TEST(Gallery, TakesOtherExperimentsWhereNoneIsOnSource) {
  RunResult result;
  EXPECT_TRUE(worst_frames(result).empty());
  result.experiments = {experiment("C", TruthKind::recorded, {example_frame(3, 9, 9, 1)})};
  EXPECT_THAT(names(worst_frames(result)), ElementsAre("C:3"));
  result.experiments.push_back(experiment("A", TruthKind::source, {example_lost_frame(5)}));
  EXPECT_THAT(names(worst_frames(result)), ElementsAre("C:3")) << "every preferred frame is lost";
}

TEST(Gallery, CommandNamesExperimentAndSeedForTheShell) {
  WorstFrame worst{{"Tr4", "DB_open_power", TruthKind::source, 1, {}}, 3, example_frame(12, 4, 5, 6), ""};
  EXPECT_EQ(explain_command(worst),
            "glovebench explain . 12 --experiment Tr4_DB_open_power_source_subject1_gradient_1 --seed 3");
  EXPECT_THAT(
      explain_command(worst, {"recorded/Tr4", "DB_other"}, "out"),
      testing::EndsWith("explain out 12 --experiment Tr4_DB_open_power_source_subject1_gradient_1 --seed 3"));
  EXPECT_THAT(explain_command(worst, {"source/Tr4", "DB_open_power"}),
              testing::EndsWith(" --trajectory PATH/Tr4.json --database PATH/DB_open_power"));
  worst.key.trajectory = "it's";
  EXPECT_THAT(explain_command(worst), testing::HasSubstr("--experiment 'it'\\''s_DB_open_power"));
  EXPECT_EQ(caption(worst),
            "it's with DB_open_power, source truth, frame 12, noise seed 3: 4.0 mm, posture 5.0 deg, "
            "rotation 6.0 deg");
}

}  // namespace

}  // namespace glovebench::reports
