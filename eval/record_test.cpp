// Recorded truths are frozen: their hashes are part of the protocol, and recording again gives the same.
#include <gmock/gmock.h>

#include <sstream>

#include "core/base/math.h"
#include "core/test_error.h"
#include "eval/program.h"
#include "eval/record.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using trajectories::Trajectory;

/// The lines "NAME HASH" of hashes.txt.
std::map<std::string, std::string> frozen_hashes() {
  std::istringstream lines(read_file(trajectory_folder() + "/recorded/hashes.txt"));
  std::map<std::string, std::string> hashes;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with("#")) continue;
    hashes[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
  }
  return hashes;
}

TEST(RecordedTruths, AreTheFrozenOnes) {
  std::map<std::string, std::string> found;
  for (const std::string& name : trajectories::ground_truth_names())
    found[name] = trajectories::hash(trajectories::recorded_trajectory(trajectory_folder(), name));
  EXPECT_EQ(found, frozen_hashes());
}

TEST(RecordedTruths, ComeFromTheSourcesThatThereAre) {
  for (const std::string& name : trajectories::ground_truth_names()) {
    const Trajectory recorded = trajectories::recorded_trajectory(trajectory_folder(), name);
    const Trajectory source = trajectories::source_trajectory(trajectory_folder(), name);
    EXPECT_EQ(recorded.provenance->source_hash, trajectories::hash(source)) << name;
    EXPECT_EQ(recorded.provenance->database, trajectories::databases_of(name).front()) << name;
    EXPECT_EQ(recorded.frames.size(), source.frames.size()) << name;
  }
}

TEST(RecordTruthLong, RecordsTr4Again) {
  const Trajectory frozen = trajectories::recorded_trajectory(trajectory_folder(), "Tr4");
  const Trajectory source = trajectories::source_trajectory(trajectory_folder(), "Tr4");
  Workbench workbench(test_workbench());
  const Trajectory again = record_truth(workbench, source, frozen.provenance->database, profile("paper"), 1);

  // A new field changes the profile's hash even if it changes no estimate; the frames tell.
  EXPECT_EQ(again.provenance->source_hash, frozen.provenance->source_hash);
  EXPECT_EQ(again.provenance->database_hash, frozen.provenance->database_hash);
  ASSERT_EQ(again.frames.size(), frozen.frames.size());
  double position_mm = 0, rotation_deg = 0, angle_deg = 0;  // largest over all frames
  for (size_t f = 0; f < frozen.frames.size(); ++f) {
    const auto &a = again.frames[f], &b = frozen.frames[f];
    ASSERT_EQ(a.timestamp_us, b.timestamp_us);
    position_mm =
        std::max(position_mm, 1000 * (a.T_camera_hand.translation() - b.T_camera_hand.translation()).norm());
    rotation_deg = std::max(
        rotation_deg, degrees_from_radians(angle_between(a.T_camera_hand.linear(), b.T_camera_hand.linear())));
    angle_deg = std::max(angle_deg, degrees_from_radians((a.posture - b.posture).cwiseAbs().maxCoeff()));
  }
  // The bound that the project promises between machines; the file is rounded to a tenth of it.
  EXPECT_LT(position_mm, 0.01);
  EXPECT_LT(rotation_deg, 0.01);
  EXPECT_LT(angle_deg, 0.01);
}

TEST(RecordTruthLong, ATruthHasNoGaps) {
  trajectories::Trajectory source = trajectories::parse_trajectory(make_trajectory_json("away", 3).dump(), "test");
  source.frames[1].T_camera_hand.translation() = Eigen::Vector3d(2, 0, 0.7);  // out of view
  Workbench workbench(test_workbench());
  const std::string error =
      thrown_by([&] { record_truth(workbench, source, "DB_open_power", profile("paper"), 1); });
  EXPECT_THAT(error, testing::StartsWith("away: frame 1: found "));
  EXPECT_THAT(error, testing::EndsWith("expected a tracked frame: a truth has no gaps"));
}

}  // namespace
}  // namespace glovebench::eval
