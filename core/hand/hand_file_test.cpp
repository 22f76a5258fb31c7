#include "core/hand/hand_file.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/test_error.h"

namespace glovebench {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

MeasuredHand some_hand() {
  MeasuredHand hand;
  hand.side = Side::left;
  hand.shape = second_subject();
  hand.deviation.fill(0.01);
  hand.seen.fill(true);
  hand.seen[kPalmThickness] = false;
  hand.views = 120;
  hand.residual_before = 0.0012;
  hand.residual = 0.0004;
  return hand;
}

/// The message about a file in which the value at that JSON pointer is another; null: is not there.
std::string refusal(const std::string& pointer, const json& value) {
  json file = json::parse(hand_text(some_hand()));
  const json::json_pointer at(pointer);
  if (value.is_null()) file.at(at.parent_pointer()).erase(at.back());
  if (!value.is_null()) file[at] = value;
  return thrown_by([&] { parse_hand(file.dump(), "mine.json"); });
}

TEST(HandFile, a_hand_returns) {
  const MeasuredHand hand = some_hand(), again = parse_hand(hand_text(hand), "mine.json");
  EXPECT_EQ(again.side, hand.side);
  EXPECT_EQ(again.shape.sizes, hand.shape.sizes);
  EXPECT_DOUBLE_EQ(again.shape.patch_border_shift, hand.shape.patch_border_shift);
  EXPECT_EQ(again.deviation, hand.deviation);
  EXPECT_EQ(again.seen, hand.seen);
  EXPECT_EQ(again.views, hand.views);
  EXPECT_EQ(hand_text(again), hand_text(hand));
}

TEST(HandFile, refuses_what_is_no_hand_of_this_mesh) {
  EXPECT_THAT(refusal("/version", 2), HasSubstr("mine.json: version: found 2"));
  EXPECT_THAT(refusal("/format", "glovebench-trajectory"), HasSubstr("mine.json: format"));
  EXPECT_THAT(refusal("/mesh_hash", "0"), HasSubstr("mine.json: mesh_hash: found \"0\""));
  EXPECT_THAT(refusal("/side", "both"), AllOf(HasSubstr("mine.json: side"), HasSubstr("right or left")));
  EXPECT_THAT(refusal("/sizes/scale/factor", 3), HasSubstr("mine.json: sizes.scale.factor: found 3"));
  EXPECT_THAT(refusal("/sizes/scale/seen", 1), HasSubstr("mine.json: sizes.scale.seen"));
  EXPECT_THAT(refusal("/sizes/index_distal_width", json()), HasSubstr("index_distal_width"));
  EXPECT_THAT(refusal("/sizes/sixth_finger_length", 1), HasSubstr("sixth_finger_length"));
  EXPECT_THAT(refusal("/patch_border_shift_mm", 50), HasSubstr("mine.json: patch_border_shift_mm: found 50"));
}

}  // namespace
}  // namespace glovebench
