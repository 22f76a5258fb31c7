#include "reports/chart.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

namespace glovebench::reports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(Chart, TicksAreRoundAndCoverTheValues) {
  EXPECT_THAT(axis_ticks(8, 4), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(axis_ticks(8.1, 4), ElementsAre(0, 5, 10));
  EXPECT_THAT(axis_ticks(33, 4), ElementsAre(0, 10, 20, 30, 40));
  EXPECT_THAT(axis_ticks(0, 4), ElementsAre(0, 1));
  for (const double max : {1e-7, 0.3, 0.99, 1.0, 57.2, 999.0, 1e6}) {
    const std::vector<double> ticks = axis_ticks(max, 4);
    EXPECT_GE(ticks.back(), max * (1 - 1e-9));
    EXPECT_LE(ticks.size(), 6u) << max;
    EXPECT_GE(ticks.size(), 3u) << max;
  }
}

TEST(Chart, LinesAreScaledAndBrokenAtGaps) {
  const std::string svg = to_svg({"title", "frame", "mm", {{"a", {0, 4, std::nullopt, 8, std::nullopt}}}});
  // The box is 52..750 by 156..26 and its largest tick 8: value 4 lies half way up, place 1 a quarter to the right.
  EXPECT_THAT(svg, HasSubstr("d=\"M52.0 156.0L226.5 91.0M575.5 26.0h0\""));
}

TEST(Chart, NothingToShowIsStillAChart) {
  const std::string svg = to_svg({"empty", "frame", "mm", {{"a", {}}, {"b", {std::nullopt}}}});
  EXPECT_THAT(svg, HasSubstr("class=\"line series-1\" d=\"\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Chart, RefusesWhatItCannotDraw) {
  EXPECT_THROW(to_svg({"", "", "", {{"a", {std::numeric_limits<double>::quiet_NaN()}}}}), std::logic_error);
  EXPECT_THROW(to_svg({"", "", "", {{"a", {-1.0}}}}), std::logic_error);
}

TEST(Chart, TextsAreEscaped) {
  EXPECT_THAT(
      to_svg({"a < b", "x & y", "\"mm\"", {}}),
      testing::AllOf(HasSubstr("<title>a &lt; b</title>"), HasSubstr("x &amp; y"), HasSubstr("&quot;mm&quot;")));
}

}  // namespace
}  // namespace glovebench::reports
