// The tracker gives identical estimates in a process that cannot read trajectories.
#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/kinect/recording.h"
#include "core/tracker/track_result.h"
#include "eval/program.h"
#include "eval/run.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

constexpr int kRecordedFrames = 20;

/// The first frames of Tr4, as the command runs them.
RunSpec make_spec() {
  trajectories::Trajectory truth = trajectories::source_trajectory(trajectory_folder(), "Tr4");
  truth.frames.resize(kRecordedFrames);
  RunSpec spec;
  spec.trajectory = std::make_shared<const trajectories::Trajectory>(std::move(truth));
  spec.database = "DB_open_power";
  return spec;
}

TEST(TrackerIsolationLong, EqualsTheRun) {
  const std::string folder = test_folder();
  Workbench workbench(test_workbench());
  const RunSpec spec = make_spec();
  std::string expected;
  int tracked = 0;
  const std::vector<eval::Run> runs = execute(workbench, {&spec, 1}, {});
  for (const TrackResult& result : runs.front().answers) {
    expected += estimate_line(tracked, result) + "\n";
    tracked += result.status == TrackStatus::tracked;
  }
  ASSERT_EQ(tracked, kRecordedFrames) << "nothing is shown by lost frames";

  workbench.database("DB_open_power")->save(folder + "/open_power.glovedb");
  workbench.color_table()->save(folder + "/colors.table");
  RecordingWriter recording(folder + "/recording", workbench.calibration());
  render::SyntheticKinect kinect = make_kinect(workbench, spec);
  while (const std::optional<DeviceFrame> frame = kinect.next_frame()) recording.write(*frame);
  recording.finish();

  const ProgramRun run =
      run_program({build_paths::program("tracker_isolation"), hand_mesh_path(), folder + "/open_power.glovedb",
                   folder + "/colors.table", folder + "/recording"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_TRUE(run.out == expected) << run.out.substr(0, 600) << "...\n" << expected.substr(0, 600) << "...";
}

}  // namespace
}  // namespace glovebench::eval
