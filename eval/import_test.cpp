// `glovebench import markers`: its files, their use by other commands, and what it refuses.
#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/file_set.h"
#include "eval/program.h"
#include "eval/test_program.h"
#include "trajectories/capture/test_capture.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ImportMarkers : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test_folder();
    trajectories::Trajectory truth = trajectories::source_trajectory(trajectory_folder(), "Tr4");
    truth.frames.resize(3);
    const HandModel model = HandModel::load(build_paths::hand_mesh());
    write_file(path("joints.csv"), trajectories::csv_markers(trajectories::captured(
                                       truth, model, trajectories::webxr_names(), {.noise = 0.0005})));
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  ProgramRun import(const std::vector<std::string>& more, const std::string& file = "joints.csv") const {
    std::vector<std::string> arguments = {"import", "markers", path(file)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_glovebench(arguments);
  }
  std::string refusal(const std::vector<std::string>& more, const std::string& file = "joints.csv") const {
    const ProgramRun run = import(more, file);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(path("out.json")));
    return run.err;
  }

  std::string folder_;
};

TEST_F(ImportMarkers, GivesATrajectoryThatRunTakes) {
  const ProgramRun run = import({"--format", "csv", "-o", path("wave.json")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("wave.json: 3 frames, 0 left out; residual 0."),
                             HasSubstr("not shown: wrist_flexion wrist_abduction")));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
  EXPECT_THAT(read_file(path("wave.residuals.csv")), HasSubstr("frame,timestamp_us,points,residual_median_mm"));
  EXPECT_EQ(import({"--format", "csv", "--postures", "2", "-o", path("postures.json")}).exit_code, 0);
  const FileSet files(folder_);
  for (const char* name : {"wave.json", "wave.residuals.csv", "postures.json"})
    EXPECT_EQ(files.read(name), read_file(path(name))) << "sets that share a folder";
  const ProgramRun tracked =
      run_glovebench({"run", "--trajectory", path("wave.json"), "--database", "DB_open_power", "-o", path("run")});
  EXPECT_EQ(tracked.exit_code, 0) << tracked.err;
  const auto results = nlohmann::json::parse(read_file(path("run/results.json")));
  EXPECT_EQ(results.at("experiments").at(0).at("coverage").at("covered"), 3);
}

TEST_F(ImportMarkers, GivesPosturesThatDbBuildTakes) {
  EXPECT_EQ(import({"--format", "csv", "--postures", "1", "-o", path("mine.json")}).exit_code, 0);
  const ProgramRun built =
      run_glovebench({"db", "build", "--postures", path("mine.json"), "-o", path("mine.glovedb")});
  EXPECT_EQ(built.exit_code, 0) << built.err;
  EXPECT_THAT(built.out, HasSubstr("1 postures"));
}

TEST_F(ImportMarkers, RefusesInOneLine) {
  const std::vector<std::string> good = {"--format", "csv", "-o", path("out.json")};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), good.begin(), good.end());
    return more;
  };
  EXPECT_THAT(refusal({"--format", "c3d", "-o", path("out.json")}), HasSubstr("csv, handpose, trc, webxr"));
  EXPECT_THAT(refusal({"--format", "csv", "-o", path("out.csv")}), HasSubstr("--output"));
  EXPECT_THAT(refusal({"-o", path("out.json")}), HasSubstr("--format"));
  EXPECT_THAT(refusal(good, "none.csv"), HasSubstr("none.csv"));
  EXPECT_THAT(refusal({"--format", "trc", "-o", path("out.json")}), HasSubstr("joints.csv: line 1, column 1"));
  EXPECT_THAT(refusal(with({path("joints.csv")})), HasSubstr("files: found 2"));
  EXPECT_THAT(refusal(with({"--camera", "0", "0", "0", "1", "1", "0", "0"})), HasSubstr("--camera"));
  EXPECT_THAT(refusal(with({"--camera", "inf", "0", "0", "1", "0", "0", "0"})), HasSubstr("--camera: transform"));
  EXPECT_THAT(refusal(with({"--layout", path("none.json")})), HasSubstr("none.json"));
  EXPECT_THAT(refusal(with({"--postures", "0"})), HasSubstr("--postures"));
  EXPECT_THAT(refusal(with({"--every", "0"})), HasSubstr("--every"));
  EXPECT_THAT(refusal(with({"--every", "2", "--postures", "3"})), HasSubstr("with a posture set"));
  EXPECT_THAT(refusal({"--format", "csv", "-o", path("un named!.json")}), HasSubstr("name"));
  write_file(path("elbow.csv"), "time_s,elbow_x_mm,elbow_y_mm,elbow_z_mm\n0,1,2,3\n");
  EXPECT_THAT(refusal(good, "elbow.csv"), AllOf(HasSubstr("elbow.csv"), HasSubstr("a place on the hand")));
}

}  // namespace
}  // namespace glovebench::eval
