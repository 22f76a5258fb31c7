#include "eval/label_errors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "eval/color_table_cache.h"

namespace glovebench::eval {
namespace {

TEST(LabelErrors, shares_are_of_the_glove_and_of_what_is_labeled) {
  LabelErrors errors;
  errors.glove = 200;
  errors.missed = 30;
  errors.labeled = 180;
  errors.wrong = 9;
  errors.glove_of[3] = 20;
  errors.missed_of[3] = 15;
  errors.glove_of[5] = 180;
  errors.missed_of[5] = 15;
  EXPECT_DOUBLE_EQ(errors.missed_share(), 0.15);
  EXPECT_DOUBLE_EQ(errors.wrong_share(), 0.05);
  EXPECT_DOUBLE_EQ(errors.missed_share_of(3), 0.75);
  EXPECT_DOUBLE_EQ(errors.missed_share_of(4), 0);
  EXPECT_EQ(errors.worst_color(), 3);

  LabelErrors sum = errors;
  sum += errors;
  EXPECT_EQ(sum.glove, 400);
  EXPECT_EQ(sum.missed_of[5], 30);
  EXPECT_DOUBLE_EQ(sum.wrong_share(), 0.05);
  EXPECT_EQ(LabelErrors{}.wrong_share(), 0) << "nothing is labeled";
  EXPECT_THROW(LabelErrors{}.missed_share(), std::logic_error);
}

TEST(LabelErrors, held_out_lightings_reach_beyond_the_calibration) {
  const auto held_out = held_out_lightings(), calibrated = calibration_lightings();
  EXPECT_EQ(held_out.size(), 16U);
  for (const auto field : {&render::Lighting::strength, &render::Lighting::temperature_k}) {
    const auto ends = [&](const std::vector<render::Lighting>& lightings) {
      const auto [low, high] = std::ranges::minmax(lightings, {}, field);
      return std::pair(low.*field, high.*field);
    };
    EXPECT_LT(ends(held_out).first, ends(calibrated).first);
    EXPECT_GT(ends(held_out).second, ends(calibrated).second);
  }
  for (const render::Lighting& lighting : held_out)
    for (const render::Lighting& seen : calibrated)
      EXPECT_GT((lighting.direction_to_light.normalized() - seen.direction_to_light.normalized()).norm(), 0.2);
}

}  // namespace
}  // namespace glovebench::eval
