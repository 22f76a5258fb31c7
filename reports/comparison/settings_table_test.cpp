#include "reports/comparison/settings_table.h"

#include <gmock/gmock.h>

#include <sstream>

#include "core/tracker/tracker_config.h"
#include "reports/comparison/example_runs.h"

namespace glovebench::reports {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two movements with `shift_mm` in every frame. Equal `noise`: nothing else differs.
SettingRun setting(const std::string& name, double shift_mm, std::optional<double> time_ms, int frames = 128,
                   const std::string& noise = "a") {
  std::vector<ExperimentResult> experiments;
  for (const char* trajectory : {"Tr1", "Tr4"})
    experiments.push_back(noisy_experiment(trajectory, {1, 2}, frames, noise, shift_mm));
  SettingRun run{example_named(name, std::move(experiments)), time_ms};
  TrackerConfig tracker;
  if (name != "paper") tracker.icp.max_points = 500 + static_cast<int>(name.size());
  run.run.result.configuration = {{"tracker", glovebench::to_json(tracker)}};
  return run;
}

/// mean, difference, low, high and verdict of a row, as text.
std::vector<std::string> row_of(const SettingsTable& settings, const std::string& quantity,
                                const std::string& name) {
  std::vector<std::string> texts;
  for (const Row& row : settings.table.rows) {
    if (std::get<std::string>(row[0]) != quantity || std::get<std::string>(row[1]) != name) continue;
    for (size_t c = 2; c < row.size(); ++c) texts.push_back(cell_text(row[c], settings.table.columns[c]));
  }
  return texts;
}

const PairingOptions kHeadline = {.metrics = headline_metrics()};

TEST(SettingsTable, APersonsHandIsNotThePapers) {
  SettingRun with_hand = setting("paper", -0.5, 10);
  with_hand.run.name = "with_hand";
  with_hand.run.result.configuration["hand"] = {{"side", "right"}};
  EXPECT_EQ(compare_settings({with_hand, setting("paper", 0, 10)}, kHeadline).reference, "paper");
}

TEST(SettingsTable, ComparesEachWithThePaperWhereverItStands) {
  const SettingsTable settings =
      compare_settings({setting("good", -0.5, 8), setting("paper", 0, 10), setting("bad", 0.5, 9.5)}, kHeadline);
  EXPECT_EQ(settings.reference, "paper");
  EXPECT_TRUE(settings.is_paper);
  EXPECT_EQ(settings.table.rows.size(), 3 * (headline_metrics().size() + 1));
  const auto good = row_of(settings, "position_error_mm", "good"),
             bad = row_of(settings, "position_error_mm", "bad"),
             paper = row_of(settings, "position_error_mm", "paper");
  EXPECT_EQ(good[1], "-0.500");
  EXPECT_EQ(good[4], "better");
  EXPECT_EQ(bad[4], "worse");
  EXPECT_EQ(paper[1], "-");
  EXPECT_NEAR(std::stod(good[0]), std::stod(paper[0]) - 0.5, 0.002);
  EXPECT_THAT(row_of(settings, "time_ms", "good"), testing::ElementsAre("8.000", "-2.000", "-", "-", ""))
      << "times have no verdict";
  EXPECT_THAT(settings.recommendation,
              AllOf(HasSubstr("Recommended: good. It is better than paper in position_error_mm (-0.500), "
                              "fingertip_error_mm (-0.750) and worse in none."),
                    HasSubstr("512 frames of 2 movements with 2 noise seeds, in 5 metrics")));
  EXPECT_EQ(settings.changes.rows.size(), 2U);
}

TEST(SettingsTable, NamesTheFasterOfEqualsButJudgesNoTime) {
  SettingRun again = setting("again", 0, 6);
  const SettingRun paper = setting("paper", 0, 10);
  again.run.result.configuration = paper.run.result.configuration;
  const SettingsTable settings = compare_settings({paper, setting("quick", 0, 6), again}, kHeadline);
  EXPECT_THAT(settings.recommendation,
              AllOf(HasSubstr("Recommended: paper. No other setting is better in one quantity and worse in none. "
                              "quick took 40% less time, measured once: repeat that before you choose by time."),
                    Not(HasSubstr("again took"))))
      << "times of equal settings differ by chance";
  EXPECT_THAT(settings.explanation, HasSubstr("Times have no verdict"));
}

TEST(SettingsTable, KeepsTheReferenceWithoutAReason) {
  const SettingsTable settings =
      compare_settings({setting("paper", 0, std::nullopt), setting("bad", 0.5, std::nullopt)}, kHeadline);
  EXPECT_THAT(settings.recommendation, HasSubstr("Recommended: paper. No other setting is better"));
  EXPECT_THAT(settings.explanation, HasSubstr("No times"));
}

TEST(SettingsTable, WithoutThePaperTheFirstIsTheReference) {
  const SettingsTable settings = compare_settings({setting("a", 0, 1), setting("bb", 0, 1)}, kHeadline);
  EXPECT_EQ(settings.reference, "a");
  EXPECT_THAT(settings.explanation, HasSubstr("Differences are from a, the first run"));
}

TEST(SettingsTable, TooFewFramesAreSaidInWords) {
  const SettingsTable settings =
      compare_settings({setting("paper", 0, 1, 32), setting("near", 0.1, 1, 32, "b")}, kHeadline);
  EXPECT_THAT(row_of(settings, "position_error_mm", "near"),
              testing::ElementsAre(testing::_, testing::_, "-", "-", "not enough data"));
  const std::string text = settings_text(settings, 80);
  EXPECT_THAT(text, HasSubstr("near, position_error_mm: at least 80 frames of a movement; 32 now"));
  EXPECT_THAT(
      settings.recommendation,
      AllOf(testing::StartsWith("No recommendation: not enough data. near is undecided in position_error_mm ("),
            HasSubstr(". It needs at least 80 frames of a movement; 32 now. This rests on")));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(SettingsTable, RunsThatDoNotCompareAreRefused) {
  EXPECT_THROW(compare_settings({setting("paper", 0, 1)}, kHeadline), Error);
  EXPECT_THROW(compare_settings({setting("a", 0, 1), setting("a", 1, 1)}, kHeadline), Error);
  EXPECT_THROW(compare_settings({setting("a", 0, 1), setting("bb", 0, 1, 64)}, kHeadline), Incomparable);
}

TEST(SettingsTable, EveryFormatHasTheSameRows) {
  const SettingsTable settings =
      compare_settings({setting("paper", 0, 10), setting("bad", 0.5, 9)}, kHeadline, {.family_error = 0.05});
  for (const std::string& text :
       {settings_text(settings, 80), settings_markdown(settings), settings_html(settings), settings_csv(settings)})
    EXPECT_THAT(text, AllOf(HasSubstr("position_error_mm"), HasSubstr("worse"), HasSubstr("0.5")));
  EXPECT_THAT(settings_html(settings), AllOf(HasSubstr("<h2>Errors and times</h2>\n<div class=\"scroll\"><table>"),
                                             HasSubstr("</div>\n<h2>Differences from the reference</h2>\n<div")));
  EXPECT_THAT(settings_html(settings, {"a script"}),
              AllOf(HasSubstr("data-chart=\"settings\""), HasSubstr("a script"), HasSubstr(",time_ms,paper,")));
  const SettingsTable untimed = compare_settings({setting("paper", 0, {}), setting("bad", 0.5, {})}, kHeadline);
  EXPECT_THAT(settings_html(untimed, {"a script"}),
              AllOf(Not(HasSubstr("data-chart")), Not(HasSubstr("a script"))));
  const auto& [name, run] = *settings.runs.begin();
  EXPECT_EQ(name, "bad");
  EXPECT_THAT(settings_csv(settings), AllOf(HasSubstr("experiments,quantity,setting,run,mean"),
                                            HasSubstr(",verdict,confidence_percent,preselected_metrics\n"),
                                            HasSubstr(",worse,95.0,position_error_mm posture_rms_deg rotation"),
                                            HasSubstr(settings.experiments + ",position_error_mm,bad," + run)));
  EXPECT_THAT(settings_latex(settings),
              AllOf(HasSubstr("% " + settings.experiments),
                    HasSubstr("% intervals hold together with 95%; metrics chosen before: position_error_mm, "),
                    HasSubstr("% bad: run " + run), HasSubstr("\\toprule"), HasSubstr("position\\_error\\_mm")));
}

}  // namespace
}  // namespace glovebench::reports
