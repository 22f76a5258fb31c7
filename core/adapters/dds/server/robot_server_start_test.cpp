// Places at which a server of the hand may start, and others.
#include <gtest/gtest.h>

#include <limits>

#include "core/adapters/dds/server/robot_server.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

TEST(RobotServerStart, StartsWithAFingerThatTouchesSomething) {
  std::vector<double> start(kShadowJointCount, 0.0);
  start[kFFJ2] = 1;
  start[kFFJ1] = 0.5;
  RobotServer server({}, {}, {start});
  EXPECT_EQ(server.tick({1, 1}).position, start) << "what was measured stays until the finger moves";
}

TEST(RobotServerStart, StartsAtALimitWhateverALogHasRounded) {
  const double rounding = radians_from_degrees(5e-7);
  for (const double outwards : {-rounding, 0.0, rounding}) {
    std::vector<double> lowest, highest;
    for (const ShadowJointInfo& info : shadow_joint_infos()) {
      lowest.push_back(radians_from_degrees(info.min_deg) - outwards);
      highest.push_back(radians_from_degrees(info.max_deg) + outwards);
    }
    for (const std::vector<double>& start : {lowest, highest}) {
      const RobotState state = RobotServer({}, {}, {start}).tick({1, 1});
      for (size_t j = 0; j < start.size(); ++j) {
        EXPECT_NEAR(state.position[j], start[j], rounding * 1.001);
        EXPECT_GE(state.position[j], radians_from_degrees(shadow_joint_infos()[j].min_deg));
        EXPECT_LE(state.position[j], radians_from_degrees(shadow_joint_infos()[j].max_deg));
      }
    }
  }
  std::vector<double> start(kShadowJointCount, 0.0);
  start[kFFJ2] = 1;
  start[kFFJ1] = 1 + rounding;
  EXPECT_EQ(RobotServer({}, {}, {start}).tick({1, 1}).position[kFFJ1], 1) << "not above J2";
}

TEST(RobotServerStart, NamesWhatIsOutside) {
  std::vector<double> start(kShadowJointCount, 0.0);
  const auto error = [&] { return thrown_by([&] { RobotServer({}, {}, {start, "hand.jsonl"}); }); };
  start[kFFJ3] = radians_from_degrees(91);
  EXPECT_EQ(error(), "hand.jsonl: rh_FFJ3: found 91 degrees, expected -15 to 90");
  start[kFFJ3] = 0;
  start[kFFJ1] = radians_from_degrees(45);
  EXPECT_EQ(error(), "hand.jsonl: rh_FFJ1: found 45 degrees, expected at most the 0 of the joint before it");
}

TEST(RobotServerStart, StartsWhereTheJointsStandIfThatIsAPlace) {
  std::vector<double> start(kShadowJointCount, 0.0);
  start[kFFJ3] = 1;
  RobotServer server({}, {}, {start});
  EXPECT_EQ(server.tick({1, 1}).position, start);
  EXPECT_THROW(server.tick({1, 1}), std::logic_error);
  start[kFFJ3] = 4;
  EXPECT_THROW(RobotServer({}, {}, {start}), Error);
  start[kFFJ3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RobotServer({}, {}, {start}), Error);
  EXPECT_THROW(RobotServer({}, {}, StartPlace{}), Error);
}

}  // namespace
}  // namespace glovebench
