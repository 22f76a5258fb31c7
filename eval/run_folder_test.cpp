#include "eval/run_folder.h"

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/error.h"
#include "core/base/random.h"
#include "eval/stored_replay.h"
#include "eval/test_program.h"
#include "reports/comparison/pairing.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Two passes of two frames, one lost, with numbers that no short decimal is.
std::vector<TrackedReplay> example_replay() {
  RandomStream random(1, "run_folder_test", 0, "example");
  const auto pose = [&] {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (double& value : T.matrix().topRows<3>().reshaped()) value = random.normal();
    return T;
  };
  std::vector<TrackedReplay> passes;
  for (const char* database : {"DB_a", "DB_b"}) {
    TrackedReplay pass{database, {}, {}, {{"align", {0.1, 1.0 / 3}}, {"look_up", {}}}, {2.0 / 3, 7}};
    for (int frame = 0; frame < 2; ++frame) {
      TrackResult result;
      result.timestamp_us = int64_t{1} << (40 + frame);
      result.status = frame == 0 ? TrackStatus::tracked : TrackStatus::poor_match;
      for (double& angle : result.posture) angle = random.normal() * 1e-300;
      for (double& angle : result.posture_unfiltered) angle = random.normal();
      result.T_camera_hand = pose();
      result.T_camera_hand_unfiltered = pose();
      result.T_camera_hand_coarse = pose();
      result.matches = {{7, 0.1F}, {frame, 2.5F}};
      result.ambiguous = frame == 1;
      result.converged = frame == 0;
      result.cloud_points = 1234;
      result.icp_points = 999;
      result.icp_iterations = 13;
      result.icp_residual = -0.0;
      if (frame == 1) result.certainty = {result.posture, 0x2aaaaa};
      reports::FrameErrors errors;
      errors.record.frame = frame;
      errors.record.timestamp_us = result.timestamp_us;
      errors.record.status = result.status;
      errors.record.covered = frame == 0;
      errors.record.false_lost = errors.record.ambiguous = frame == 1;
      errors.record.icp_iterations = 5;
      errors.record["position_error_mm"] = random.normal();
      if (frame == 0) errors.joint_errors_mm = {random.uniform(), std::nextafter(1.0, 2.0)};
      pass.results.push_back(result);
      pass.errors.push_back(errors);
    }
    passes.push_back(pass);
  }
  return passes;
}

void expect_same_bits(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_TRUE(a.matrix() == b.matrix());
}

TEST(StoredReplay, ComesBackToTheLastBit) {
  const std::vector<TrackedReplay> stored = example_replay();
  const auto read = replay_from_bytes(to_bytes(stored));
  ASSERT_TRUE(read.has_value());
  ASSERT_EQ(read->size(), 2U);
  for (size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(read->at(p).database, stored[p].database);
    EXPECT_EQ(read->at(p).stages[0].frame_ms, stored[p].stages[0].frame_ms);
    EXPECT_EQ(read->at(p).stages[1].stage, "look_up");
    EXPECT_EQ(read->at(p).frame_ms, stored[p].frame_ms);
    for (size_t f = 0; f < 2; ++f) {
      const TrackResult &r = read->at(p).results[f], &s = stored[p].results[f];
      EXPECT_EQ(std::tie(r.timestamp_us, r.status, r.ambiguous, r.converged, r.cloud_points, r.icp_points),
                std::tie(s.timestamp_us, s.status, s.ambiguous, s.converged, s.cloud_points, s.icp_points));
      EXPECT_EQ(r.icp_iterations, s.icp_iterations);
      EXPECT_TRUE(std::signbit(r.icp_residual)) << "minus zero";
      ASSERT_EQ(r.certainty.has_value(), f == 1);
      if (r.certainty) {
        EXPECT_EQ(r.certainty->deviation, s.certainty->deviation);
        EXPECT_EQ(r.certainty->hidden, 0x2aaaaaU);
      }
      EXPECT_TRUE(r.posture == s.posture && r.posture_unfiltered == s.posture_unfiltered);
      expect_same_bits(r.T_camera_hand, s.T_camera_hand);
      expect_same_bits(r.T_camera_hand_unfiltered, s.T_camera_hand_unfiltered);
      expect_same_bits(r.T_camera_hand_coarse, s.T_camera_hand_coarse);
      ASSERT_EQ(r.matches.size(), 2U);
      EXPECT_EQ(r.matches[1].entry, s.matches[1].entry);
      EXPECT_EQ(r.matches[0].error, 0.1F);
      EXPECT_TRUE(read->at(p).errors[f].record == stored[p].errors[f].record);
      EXPECT_EQ(read->at(p).errors[f].joint_errors_mm, stored[p].errors[f].joint_errors_mm);
    }
  }
}

TEST(StoredReplay, HalfOfOneIsNone) {
  const std::string bytes = to_bytes(example_replay());
  for (size_t at = 0; at < bytes.size(); at += 7)
    EXPECT_FALSE(replay_from_bytes(bytes.substr(0, at)).has_value()) << at;
}

TEST(StoredReplay, OfDeepNestingIsNone) {
  const std::string nested(10'000'000, '\x81');  // each an array of one
  EXPECT_FALSE(replay_from_bytes(nested).has_value());
  EXPECT_FALSE(replay_from_bytes("\x41x").has_value()) << "bytes without a meaning";
}

TEST(StoredReplay, WithAStatusThatNobodyKnowsIsNone) {
  const std::string bytes = to_bytes(example_replay());
  for (const std::string status : {"tracked", "poor_match"}) {
    std::string other = bytes;
    const size_t at = other.find(status);
    ASSERT_NE(at, std::string::npos);
    other.replace(at, 1, "x");
    EXPECT_FALSE(replay_from_bytes(other).has_value()) << status;
  }
  nlohmann::json passes = nlohmann::json::from_cbor(bytes);
  for (const nlohmann::json& status :
       {nlohmann::json(99), nlohmann::json(-1), nlohmann::json(0), nlohmann::json()}) {
    passes[0]["errors"][0][2] = status;
    std::string other;
    nlohmann::json::to_cbor(passes, other);
    EXPECT_FALSE(replay_from_bytes(other).has_value()) << status;
  }
}

class RunFolderTest : public testing::Test {
 protected:
  RunFolderTest() : folder_(test_folder() + "/out") {}

  bool is_marked() const {
    try {
      require_finished(folder_);
      return false;
    } catch (const reports::Incomparable& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(folder_), HasSubstr("the same command again resumes it")));
      return true;
    }
  }

  std::string folder_;
};

TEST_F(RunFolderTest, IsMarkedFromBeginToFinish) {
  EXPECT_FALSE(is_marked());
  {
    RunFolder run(folder_);
    run.begin();
    run.store("key", "content");
    EXPECT_TRUE(is_marked());
  }
  EXPECT_TRUE(is_marked()) << "it ended without finish";
  RunFolder again(folder_);
  EXPECT_TRUE(again.load("key").has_value());
  EXPECT_FALSE(again.load("other").has_value());
  again.finish();
  EXPECT_FALSE(is_marked());
  EXPECT_TRUE(fs::is_empty(folder_)) << "what was kept is gone";
}

TEST_F(RunFolderTest, ThatCannotBeLookedIntoIsNoFinishedOne) {
  fs::create_directories(folder_);
  fs::create_symlink(".unfinished", folder_ + "/.unfinished");  // a link to itself
  EXPECT_THAT(
      [&] { require_finished(folder_); },
      testing::ThrowsMessage<Error>(AllOf(HasSubstr(folder_ + "/.unfinished"), HasSubstr("symbolic links"))));
}

TEST_F(RunFolderTest, KeysDoNotLeaveTheFolder) {
  const RunFolder run(folder_);
  EXPECT_THROW(run.store("../../evil", "content"), Error);
  EXPECT_THROW(run.load("../../evil"), Error);
}

TEST_F(RunFolderTest, RefusalBeforeTheWorkLeavesTheMarkAsItWas) {
  { const RunFolder refused(folder_); }
  EXPECT_FALSE(is_marked());
  {
    RunFolder interrupted(folder_);
    interrupted.begin();
  }
  { const RunFolder refused(folder_); }
  EXPECT_TRUE(is_marked()) << "the interrupted run is not undone by a refused one";
}

TEST_F(RunFolderTest, HoldsOneRunAtATime) {
  {
    const RunFolder first(folder_);
    EXPECT_THAT([&] { const RunFolder second(folder_); },
                testing::ThrowsMessage<Error>(AllOf(HasSubstr(folder_), HasSubstr("another run"))));
    EXPECT_TRUE(is_marked()) << "the second did not take it away";
  }
  const RunFolder free_again(folder_);
}

TEST_F(RunFolderTest, WhatIsDamagedHalfOrUnderAnotherNameIsMadeAnew) {
  const RunFolder run(folder_);
  const std::string content = to_bytes(example_replay());
  run.store("key", content);
  EXPECT_EQ(run.load("key"), content);
  const std::string path = folder_ + "/.unfinished/key.stored";
  const std::string bytes = read_file(path);
  for (size_t at = 0; at < bytes.size(); at += 7) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    for (const std::string& wrong : {damaged, bytes.substr(0, at)}) {
      write_file(path, wrong);
      EXPECT_FALSE(run.load("key").has_value()) << at;
      EXPECT_FALSE(fs::exists(path)) << at;
    }
  }
  fs::create_directories(path + "/in the way");
  EXPECT_FALSE(run.load("key").has_value());
  run.store("key", content);
  EXPECT_EQ(run.load("key"), content);
  write_file(folder_ + "/.unfinished/other.stored", bytes);
  EXPECT_FALSE(run.load("other").has_value());
}

TEST_F(RunFolderTest, SaysOnceWhatIsMadeAnew) {
  const RunFolder run(folder_);
  for (const char* key : {"a", "b"}) write_file(folder_ + "/.unfinished/" + key + ".stored", "glovebench-stored");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(run.load("a").has_value());
  EXPECT_FALSE(run.load("b").has_value());
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("a.stored is cut short or of another version"), testing::Not(HasSubstr("b.stored"))));
}

TEST_F(RunFolderTest, RemovesAMarkThatWasPutAside) {
  write_file(folder_ + "/.finished-1/lock", "");  // a kill between the two steps of finish
  EXPECT_FALSE(is_marked());
  { const RunFolder run(folder_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// `run` of six frames against two databases, four seeds, with robot commands.
class KilledRunLong : public RunFolderTest {
 protected:
  std::vector<std::string> run_into(const std::string& name) const {
    const std::string folder = fs::path(folder_).parent_path().string();
    const std::string trajectory = folder + "/six.json";
    if (!fs::exists(trajectory)) write_file(trajectory, make_trajectory_json("six", 6).dump());
    return {"run",
            "--trajectory",
            trajectory,
            "--database",
            "DB_open_pinch",
            "--database",
            "DB_open_power",
            "--seeds",
            "4",
            "--output",
            folder + "/" + name,
            "--robot-out",
            folder + "/" + name + "/robot"};
  }
  /// What `explain` of the folder ends with: a reader.
  int read(const std::string& name) const {
    const std::string folder = fs::path(folder_).parent_path().string();
    return run_glovebench({"explain", folder + "/" + name, "3", "--trajectory", folder + "/six.json", "--output",
                           folder + "/explained.png"})
        .exit_code;
  }
  std::map<std::string, std::string> files(const std::string& name) const {
    return read_timeless((fs::path(folder_).parent_path() / name).string());
  }
};

TEST_F(KilledRunLong, ResumesToTheSameBytes) {
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run_glovebench(run_into("undisturbed")).exit_code, 0);
  const auto duration = std::chrono::steady_clock::now() - begin;
  int killed = 0;
  for (int kill = 1; kill <= 5; ++kill) {
    const StartedProgram started = start_glovebench(run_into("out"));
    std::this_thread::sleep_for(duration * kill / 6);
    ::kill(started.process, SIGKILL);
    if (finish_program(started).exit_code == -1) ++killed;
    const bool is_begun = fs::exists(folder_ + "/.unfinished"), is_done = fs::exists(folder_ + "/results.json");
    EXPECT_EQ(read("out"), is_begun ? 3 : is_done ? 0 : 2);
  }
  EXPECT_GT(killed, 0);
  ASSERT_EQ(run_glovebench(run_into("out")).exit_code, 0);
  EXPECT_EQ(read("out"), 0);
  EXPECT_TRUE(files("out") == files("undisturbed"));
}

TEST_F(KilledRunLong, SecondRunIntoTheFolderIsRefused) {
  const StartedProgram first = start_glovebench(run_into("out"));
  while (!fs::exists(folder_ + "/.unfinished/lock")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // from the file to its lock
  const ProgramRun second = run_glovebench(run_into("out"));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, AllOf(HasSubstr(folder_), HasSubstr("another run")));
  EXPECT_EQ(finish_program(first).exit_code, 0);
  ASSERT_EQ(run_glovebench(run_into("alone")).exit_code, 0);
  EXPECT_TRUE(files("out") == files("alone"));
}

}  // namespace
}  // namespace glovebench::eval
