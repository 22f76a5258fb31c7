// The stand-ins of libraries that a build may lack, in every build: this program links them instead of the
// libraries.
#include <gmock/gmock.h>

#include "core/adapters/dds/dds_server.h"
#include "core/adapters/dds/robot_bus.h"
#include "core/adapters/freenect/live_kinect.h"
#include "core/adapters/kdl/make_arm_solver.h"
#include "core/adapters/openni2/oni_player.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

using testing::AllOf, testing::HasSubstr, testing::ThrowsMessage;

TEST(StandIns, NameCycloneDds) {
  const auto is_named = ThrowsMessage<Error>(
      AllOf(HasSubstr("domain 0"), HasSubstr("without Cyclone DDS"), HasSubstr("cyclonedds-dev")));
  EXPECT_FALSE(kHasDds);
  EXPECT_THAT([] { join_robot_bus({}); }, is_named);
  EXPECT_THAT([] { serve({}); }, is_named);
}

TEST(StandIns, NameLibfreenect) {
  EXPECT_FALSE(kHasFreenect);
  EXPECT_THAT([] { open_kinect(nominal_kinect_calibration()); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr("device 0"), HasSubstr("without libfreenect"), HasSubstr("libfreenect-dev"))));
}

TEST(StandIns, NameOpenNi2) {
  EXPECT_FALSE(kHasOpenNi2);
  EXPECT_THAT(
      [] { open_oni("a.oni"); },
      ThrowsMessage<Error>(AllOf(HasSubstr("a.oni"), HasSubstr("without OpenNI2"), HasSubstr("libopenni2-dev"))));
}

TEST(StandIns, SolveForNoArm) { EXPECT_EQ(make_arm_solver(), nullptr); }

}  // namespace
}  // namespace glovebench
