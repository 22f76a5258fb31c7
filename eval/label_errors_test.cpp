#include "eval/label_errors.h"

#include <gtest/gtest.h>

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
  const auto lightings = held_out_lightings();
  EXPECT_EQ(lightings.size(), 16U);
  for (const render::Lighting& lighting : lightings) EXPECT_TRUE(lighting.problems().empty());
}

}  // namespace
}  // namespace glovebench::eval
