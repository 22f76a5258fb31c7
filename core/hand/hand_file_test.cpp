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
  hand.shape.sizes = second_subject().sizes;
  hand.deviation.fill(0.01);
  hand.seen.fill(true);
  hand.seen[kPalmThickness] = false;
  hand.shape.heights.assign(kRiggedMeshVertices, 0);
  hand.shape.heights[7] = -0.0025;
  hand.shape.patch_votes = {{3, kIndexProximal, 12}, {9, kIndexProximal, 1}, {3, kCuff, 2}};
  hand.views = 120;
  hand.residual_before = 0.0012;
  hand.residual = 0.0004;
  return hand;
}

/// The message about a file in which the value at that JSON pointer is another; null: is not there.
std::string refusal(const std::string& pointer, const json& value) {
  json file = json::parse(to_json(some_hand()).dump());
  const json::json_pointer at(pointer);
  if (value.is_null()) file.at(at.parent_pointer()).erase(at.back());
  if (!value.is_null()) file[at] = value;
  return thrown_by([&] { parse_hand(file.dump(), "mine.json"); });
}

TEST(HandFile, a_hand_returns) {
  const MeasuredHand hand = some_hand(), again = parse_hand(to_json(hand).dump(), "mine.json");
  EXPECT_EQ(again.side, hand.side);
  EXPECT_EQ(again.shape.sizes, hand.shape.sizes);
  EXPECT_EQ(again.shape.heights, hand.shape.heights);
  EXPECT_EQ(again.shape.patch_votes, hand.shape.patch_votes);
  EXPECT_EQ(again.deviation, hand.deviation);
  EXPECT_EQ(again.seen, hand.seen);
  EXPECT_EQ(again.views, hand.views);
  EXPECT_EQ(to_json(again), to_json(hand));
}

TEST(HandFile, refuses_what_is_no_hand_of_this_mesh) {
  EXPECT_THAT(refusal("/version", 1), HasSubstr("mine.json: version: found 1"));
  EXPECT_THAT(refusal("/format", "glovebench-trajectory"), HasSubstr("mine.json: format"));
  EXPECT_THAT(refusal("/mesh_hash", "0"), HasSubstr("mine.json: mesh_hash: found \"0\""));
  EXPECT_THAT(refusal("/side", "both"), AllOf(HasSubstr("mine.json: side"), HasSubstr("right or left")));
  EXPECT_THAT(refusal("/sizes/scale/factor", 3), HasSubstr("mine.json: sizes.scale.factor: found 3"));
  EXPECT_THAT(refusal("/sizes/scale/seen", 1), HasSubstr("mine.json: sizes.scale.seen"));
  EXPECT_THAT(refusal("/sizes/index_distal_width", json()), HasSubstr("index_distal_width"));
  EXPECT_THAT(refusal("/sizes/sixth_finger_length", 1), HasSubstr("sixth_finger_length"));
  EXPECT_THAT(refusal("/heights_mm/7", 11), HasSubstr("mine.json: heights_mm[7]: found 11"));
  EXPECT_THAT(refusal("/heights_mm", json({1, 2})),
              HasSubstr("mine.json: heights_mm: found 2 elements, expected 1260"));
  EXPECT_THAT(refusal("/patch_votes/cuff/vertices/0", 1260), HasSubstr("patch_votes.cuff.vertices[0]: found 1260"));
  EXPECT_THAT(refusal("/patch_votes/index_proximal/vertices/1", 3),
              HasSubstr("patch_votes.index_proximal.vertices[1]: found 3"));
  EXPECT_THAT(refusal("/patch_votes/index_proximal/points/1", 0), HasSubstr("index_proximal.points[1]: found 0"));
  EXPECT_THAT(refusal("/patch_votes/cuff/points", json({1, 2})), HasSubstr("cuff.points: found 2 elements"));
  EXPECT_THAT(refusal("/patch_votes/cuff", json()), HasSubstr("cuff"));
}

}  // namespace
}  // namespace glovebench
