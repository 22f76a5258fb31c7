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

TEST(Chart, SignedTicksIncludeZero) {
  EXPECT_THAT(signed_axis_ticks(-4, 4, 4), ElementsAre(-4, -2, 0, 2, 4));
  EXPECT_THAT(signed_axis_ticks(-3, 0, 4), ElementsAre(-3, -2, -1, 0));
  EXPECT_THAT(signed_axis_ticks(1, 8, 4), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(signed_axis_ticks(-0.1, 7.9, 4), ElementsAre(-2, 0, 2, 4, 6, 8));
  EXPECT_THAT(signed_axis_ticks(0, 0, 4), ElementsAre(0, 1));
}

TEST(Chart, SignedValuesLieOnBothSidesOfZero) {
  LineChart chart{"title", "frame", "mm", {{"a", {-4, 0, 4}}}};
  chart.is_signed = true;
  const std::string svg = to_svg(chart);
  EXPECT_THAT(svg, HasSubstr("d=\"M52.0 156.0L401.0 91.0L750.0 26.0\""));
  EXPECT_THAT(svg, HasSubstr("class=\"axis\" x1=\"52.0\" y1=\"91.0\" x2=\"750.0\" y2=\"91.0\""));
  EXPECT_THAT(svg, HasSubstr("text-anchor=\"end\">-4</text>"));
}

TEST(Chart, PlacesAreNumberedFromTheFirst) {
  LineChart chart{"title", "frame", "mm", {{"a", std::vector<std::optional<double>>(11, 1)}}};
  chart.first_place = 95;
  const std::string svg = to_svg(chart);
  // 95..105 over 52..750: a tick every second frame, the first at 96.
  EXPECT_THAT(svg, HasSubstr("x=\"121.8\" y=\"173.0\" text-anchor=\"middle\">96</text>"));
  EXPECT_THAT(svg, HasSubstr(">104</text>"));
  EXPECT_THAT(svg, Not(HasSubstr(">95</text>")));
}

TEST(Chart, NothingToShowIsStillAChart) {
  const std::string svg = to_svg({"empty", "frame", "mm", {{"a", {}}, {"b", {std::nullopt}}}});
  EXPECT_THAT(svg, HasSubstr("class=\"line series-1\" d=\"\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Chart, RefusesWhatItCannotDraw) {
  EXPECT_THROW(to_svg({"", "", "", {{"a", {std::numeric_limits<double>::quiet_NaN()}}}}), std::logic_error);
  EXPECT_THROW(to_svg({"", "", "", {{"a", {-1.0}}}}), std::logic_error);
  LineChart chart{"", "", "", {{"a", {-std::numeric_limits<double>::infinity()}}}};
  chart.is_signed = true;
  EXPECT_THROW(to_svg(chart), std::logic_error);
}

TEST(Chart, TextsAreEscaped) {
  EXPECT_THAT(
      to_svg({"a < b", "x & y", "\"mm\"", {}}),
      testing::AllOf(HasSubstr("<title>a &lt; b</title>"), HasSubstr("x &amp; y"), HasSubstr("&quot;mm&quot;")));
}

}  // namespace
}  // namespace glovebench::reports
