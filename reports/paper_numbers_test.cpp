#include "reports/paper_numbers.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "reports/embedded.h"
#include "reports/statistics.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;

TEST(PaperNumbers, CurvesHaveThePrintedMeans) {
  for (const PaperCurve* curve : {&paper_numbers().figure_5, &paper_numbers().figure_6}) {
    std::vector<double> position, posture, rotation;
    for (const PaperErrors& frame : curve->frames) {
      position.push_back(frame.position_mm);
      posture.push_back(frame.posture_deg);
      rotation.push_back(frame.rotation_deg);
    }
    // The means are printed with four decimals.
    EXPECT_NEAR(*mean(position), curve->mean.position_mm, 1e-4) << curve->trajectory;
    EXPECT_NEAR(*mean(posture), curve->mean.posture_deg, 1e-4) << curve->trajectory;
    EXPECT_NEAR(*mean(rotation), curve->mean.rotation_deg, 1e-4) << curve->trajectory;
  }
  EXPECT_EQ(paper_numbers().figure_5.frames.size(), 117u);
  EXPECT_EQ(paper_numbers().figure_6.frames.size(), 137u);
}

TEST(PaperNumbers, PostureErrorOfFigure5DecaysAsARecursiveFilter) {
  // The program's smoothing uses this number: 0.75 per frame while the truth rests.
  const auto& frames = paper_numbers().figure_5.frames;
  for (size_t i = 61; i < 80; ++i)
    EXPECT_NEAR(frames[i].posture_deg / frames[i - 1].posture_deg, 0.75, 0.003) << i;  // printed with 5 digits
}

TEST(PaperNumbers, MeansOfTheTwoPrintedExperiments) {
  const PaperErrors* tr4 = paper_numbers().mean_of("Tr4", "DB_open_power");
  ASSERT_NE(tr4, nullptr);
  EXPECT_EQ(tr4->position_mm, 3.8814);
  const PaperErrors* tr1 = paper_numbers().mean_of("Tr1", "DB_20_postures");
  ASSERT_NE(tr1, nullptr);
  EXPECT_EQ(tr1->rotation_deg, 11.6754);
  EXPECT_EQ(paper_numbers().mean_of("Tr4", "DB_20_postures"), nullptr);
}

TEST(PaperNumbers, CascadesOfFigure8) {
  ASSERT_EQ(paper_numbers().figure_8.size(), 8u);
  EXPECT_EQ(paper_numbers().figure_8[1].cascade, (Cascade{{16, 500}, {64, 3}}));
  EXPECT_EQ(paper_numbers().figure_8[1].time_ms, 91.2);
}

TEST(PaperNumbers, LoaderIsStrict) {
  const json original = json::parse(embedded_paper_numbers());
  const auto refused = [&](const std::function<void(json&)>& change) {
    json changed = original;
    change(changed);
    EXPECT_THROW(parse_paper_numbers(changed.dump(), "test"), Error);
  };
  EXPECT_NO_THROW(parse_paper_numbers(original.dump(), "test"));
  refused([](json& j) { j["version"] = 2; });
  refused([](json& j) { j["figure_9"] = 1; });
  refused([](json& j) { j.erase("figure_6"); });
  refused([](json& j) { j["figure_5"]["frames"][3].erase(1); });
  refused([](json& j) { j["figure_5"]["frames"][3][0] = -1; });
  refused([](json& j) { j["figure_5"]["columns"][0] = "position_error_m"; });
  refused([](json& j) { j["figure_8"][0]["cascade"][0] = 16; });
  refused([](json& j) { j["text_claims"]["rate_hz"] = "15"; });
}

}  // namespace
}  // namespace glovebench::reports
