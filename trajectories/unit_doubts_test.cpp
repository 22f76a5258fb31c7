#include "trajectories/unit_doubts.h"

#include <gmock/gmock.h>

#include "core/base/math.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A hand that goes from one distance to another and bends its fingers.
Trajectory moving(double from_m, double to_m, double bend_deg) {
  Trajectory trajectory{.name = "t", .description = "", .provenance = {}, .frames = {}};
  for (int i = 0; i <= 10; ++i) {
    HandFrame& frame = trajectory.frames.emplace_back();
    frame.T_camera_hand.translation().z() = from_m + (to_m - from_m) * i / 10;
    frame.posture.setConstant(radians_from_degrees(bend_deg) * i / 10);
  }
  return trajectory;
}

std::vector<std::string> doubts(const Trajectory& trajectory) {
  return unit_doubts(trajectory, {});
}

TEST(UnitDoubts, none_of_what_can_be) {
  EXPECT_THAT(doubts(moving(0.6, 0.8, 60)), IsEmpty());
  EXPECT_THAT(doubts(moving(0.6, 0.8, 0)), IsEmpty()) << "a flat hand";
  EXPECT_THAT(doubts(moving(0.6, 0.8, 4)), IsEmpty()) << "nearly flat";
  EXPECT_THAT(doubts(moving(0.7, 1.15, 60)), IsEmpty()) << "leaves the volume for less than half of the time";
}

TEST(UnitDoubts, other_units_of_positions) {
  EXPECT_THAT(
      doubts(moving(0.6e-3, 0.8e-3, 60)),
      ElementsAre("most frames lie outside of the working volume, 400 to 950 mm from the camera (z of the hand: "
                  "0.6 to 0.8 mm): the positions look like meters, position_mm is in millimeters"));
  EXPECT_THAT(doubts(moving(0.06, 0.08, 60)), ElementsAre(HasSubstr("look like centimeters")));
  EXPECT_THAT(doubts(moving(-0.6, -0.8, 60)), ElementsAre(HasSubstr("looks along -z")));
  EXPECT_THAT(doubts(moving(1.2, 1.5, 60)),
              ElementsAre(AllOf(HasSubstr("1200 to 1500 mm"), HasSubstr("z forward"))));
}

TEST(UnitDoubts, radians) {
  EXPECT_THAT(doubts(moving(0.6, 0.8, 1.05)),
              ElementsAre("no angle exceeds 1.05 degrees: the angles look like radians, "
                          "angles_deg is in degrees"));
  EXPECT_THAT(doubts(moving(0.6e-3, 0.8e-3, 1.05)).size(), 2U);
}

}  // namespace
}  // namespace glovebench::trajectories
