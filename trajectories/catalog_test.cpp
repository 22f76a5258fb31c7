#include "trajectories/catalog.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/test_error.h"
#include "core/test_folder.h"
#include "trajectories/posture_file.h"

namespace glovebench::trajectories {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A fresh, empty folder for one test.
std::string make_folder(const std::string& name) {
  std::string folder = test_folder() + "/" + name;
  std::filesystem::create_directories(folder);
  return folder;
}

Trajectory named(const std::string& name) {
  return {.name = name, .description = "", .provenance = {}, .frames = {HandFrame{}}};
}

TEST(Catalog, lists_the_databases_that_contain_the_grasp) {
  EXPECT_THAT(databases_of("Tr2"), ElementsAre("DB_open_pinch", "DB_open_pinch_power", "DB_20_postures"));
  EXPECT_THAT(databases_of("Tr3"), ElementsAre("DB_open_power", "DB_open_pinch_power", "DB_20_postures"));
  EXPECT_THROW(databases_of("Tr6"), Error);
}

TEST(Catalog, lists_sources_then_recorded_by_name) {
  const std::string folder = make_folder("lists");
  EXPECT_THROW(list_trajectories(folder), Error);
  write_trajectory(named("b"), trajectory_path(folder, TrajectoryKind::source, "b"));
  write_trajectory(named("a"), trajectory_path(folder, TrajectoryKind::source, "a"));
  write_trajectory(named("a"), trajectory_path(folder, TrajectoryKind::recorded, "a"));
  std::vector<std::string> listed;
  for (const TrajectoryListing& listing : list_trajectories(folder))
    listed.push_back(std::string(to_string(listing.kind)) + " " + listing.name);
  EXPECT_THAT(listed, ElementsAre("source a", "source b", "recorded a"));
}

TEST(Catalog, lists_scripts_by_name) {
  const std::string folder = make_folder("scripts");
  EXPECT_THAT(script_names(folder), testing::IsEmpty());
  for (const std::string name : {"b.json", "a.json", "notes.txt"}) write_file(folder + "/scripts/" + name, "");
  EXPECT_THAT(script_names(folder), ElementsAre("a", "b"));
}

TEST(Catalog, says_which_trajectories_there_are) {
  const std::string folder = make_folder("says");
  write_trajectory(named("wave"), trajectory_path(folder, TrajectoryKind::source, "wave"));
  EXPECT_EQ(source_trajectory(folder, "wave").name, "wave");
  for (const std::string missing : {"wavy", "../sources/wave", ""}) {
    EXPECT_THAT(thrown_by([&] { source_trajectory(folder, missing); }), HasSubstr("expected one of wave"))
        << missing;
  }
}

TEST(Catalog, refuses_a_file_in_the_wrong_place) {
  const std::string folder = make_folder("wrong");
  write_trajectory(named("a"), trajectory_path(folder, TrajectoryKind::source, "b"));
  EXPECT_THROW(source_trajectory(folder, "b"), Error);
  write_trajectory(named("c"), trajectory_path(folder, TrajectoryKind::recorded, "c"));
  EXPECT_THROW(recorded_trajectory(folder, "c"), Error);
}

TEST(Catalog, finds_posture_sets) {
  const std::string folder = make_folder("sets");
  write_posture_set({"mine", {"flat"}, {Posture::Zero()}}, folder + "/postures/mine.json");
  EXPECT_EQ(posture_set(folder, "mine").postures.size(), 1u);
  EXPECT_THROW(posture_set(folder, "DB_open_pinch"), Error);
}

}  // namespace
}  // namespace glovebench::trajectories
