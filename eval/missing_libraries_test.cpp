// What a program says that was built without a library that it can do without.
#include <gmock/gmock.h>

#include "core/adapters/dds/robot_bus.h"
#include "core/adapters/freenect/live_kinect.h"
#include "core/adapters/kdl/make_arm_solver.h"
#include "core/base/error.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using testing::AllOf, testing::HasSubstr;

TEST(MissingLibraries, CycloneDdsIsNamed) {
  if (kHasDds) GTEST_SKIP() << "this build has it";
  const ProgramRun run = run_glovebench({"robot-server", "run", "--hand"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("without Cyclone DDS"), HasSubstr("cyclonedds-dev")));
  EXPECT_THAT([] { join_robot_bus({}); }, testing::ThrowsMessage<Error>(HasSubstr("without Cyclone DDS")));
}

TEST(MissingLibraries, OrocosKdlIsNamed) {
  if (make_arm_solver()) GTEST_SKIP() << "this build has it";
  const ProgramRun run = run_glovebench({"robot-server", "run", "--arm"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("without Orocos KDL"), HasSubstr("liborocos-kdl-dev")));
}

TEST(MissingLibraries, LibfreenectIsNamed) {
  if (kHasFreenect) GTEST_SKIP() << "this build has it";
  const ProgramRun run =
      run_glovebench({"track", "--source", "freenect", "--database", "DB_open_power", "-o", "x"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("without libfreenect"), HasSubstr("libfreenect-dev")));
}

}  // namespace
}  // namespace glovebench::eval
