#include "eval/run_store.h"

#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/error.h"
#include "core/base/random.h"
#include "eval/run_bytes.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Two frames, one lost, with numbers that have no short decimal form.
Run example_run() {
  RandomStream random(1, "run_store_test", 0, "example");
  const auto pose = [&] {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    for (double& value : T.matrix().topRows<3>().reshaped()) value = random.normal();
    return T;
  };
  Run run;
  run.stages = {{"align", {0.1, 1.0 / 3}}, {"look_up", {}}};
  run.frame_ms = {2.0 / 3, 7};
  for (int frame = 0; frame < 2; ++frame) {
    TrackResult answer;
    answer.timestamp_us = int64_t{1} << (40 + frame);
    answer.status = frame == 0 ? TrackStatus::tracked : TrackStatus::poor_match;
    for (double& angle : answer.posture) angle = random.normal() * 1e-300;
    for (double& angle : answer.posture_unfiltered) angle = random.normal();
    answer.T_camera_hand = pose();
    answer.T_camera_hand_unfiltered = pose();
    answer.T_camera_hand_coarse = pose();
    answer.matches = {{7, 0.1F}, {frame, 2.5F}};
    answer.ambiguous = frame == 1;
    answer.converged = frame == 0;
    answer.cloud_points = 1234;
    answer.icp_points = 999;
    answer.icp_iterations = 13;
    answer.icp_residual = -0.0;
    if (frame == 1) answer.certainty = {answer.posture, 0x2aaaaa};
    run.answers.push_back(answer);
    Sight& sight = run.seen.emplace_back();
    for (int p = 0; p < kPatchCount; ++p) sight.visible_pixels[p] = 1000 * frame + p;
    sight.trackable = frame == 1;
    sight.visible_percent = 12.5 * frame;
  }
  return run;
}

void expect_same_bits(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_TRUE(a.matrix() == b.matrix());
}

TEST(RunBytes, ComeBackToTheLastBit) {
  const eval::Run stored = example_run();
  RunSpec spec;
  spec.database = "DB_a";
  const std::optional<eval::Run> read = run_from_bytes(to_bytes(stored), spec);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->spec.database, "DB_a");
  EXPECT_EQ(read->stages[0].frame_ms, stored.stages[0].frame_ms);
  EXPECT_EQ(read->stages[1].stage, "look_up");
  EXPECT_EQ(read->frame_ms, stored.frame_ms);
  ASSERT_EQ(read->answers.size(), 2U);
  for (size_t f = 0; f < 2; ++f) {
    const TrackResult &r = read->answers[f], &s = stored.answers[f];
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
    EXPECT_EQ(read->seen[f].visible_pixels, stored.seen[f].visible_pixels);
    EXPECT_EQ(read->seen[f].trackable, stored.seen[f].trackable);
  }
}

TEST(RunBytes, HalfOfThemAreNone) {
  const std::string bytes = to_bytes(example_run());
  for (size_t at = 0; at < bytes.size(); at += 7)
    EXPECT_FALSE(run_from_bytes(bytes.substr(0, at), {}).has_value()) << at;
}

TEST(RunBytes, OfDeepNestingAreNone) {
  const std::string nested(10'000'000, '\x81');  // each is an array of one item
  EXPECT_FALSE(run_from_bytes(nested, {}).has_value());
  EXPECT_FALSE(run_from_bytes("\x41x", {}).has_value()) << "bytes without a meaning";
}

TEST(RunBytes, WithAnUnknownStatusOrAFrameTooFewAreNone) {
  const std::string bytes = to_bytes(example_run());
  for (const std::string status : {"tracked", "poor_match"}) {
    std::string other = bytes;
    const size_t at = other.find(status);
    ASSERT_NE(at, std::string::npos);
    other.replace(at, 1, "x");
    EXPECT_FALSE(run_from_bytes(other, {}).has_value()) << status;
  }
  const auto is_read = [&](const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json run = nlohmann::json::from_cbor(bytes);
    change(run);
    std::string other;
    nlohmann::json::to_cbor(run, other);
    return run_from_bytes(other, {}).has_value();
  };
  EXPECT_TRUE(is_read([](nlohmann::json&) {}));
  for (const nlohmann::json& status : {nlohmann::json(99), nlohmann::json(-1), nlohmann::json(0), nlohmann::json()})
    EXPECT_FALSE(is_read([&](nlohmann::json& run) { run["answers"][0][1] = status; })) << status;
  // Where a count stands that is a double or does not fit.
  for (const nlohmann::json& count : {nlohmann::json(1e246), nlohmann::json(1.0), nlohmann::json(int64_t{1} << 40)})
    EXPECT_FALSE(is_read([&](nlohmann::json& run) { run["answers"][0][10] = count; })) << count;
  for (const char* list : {"answers", "seen", "frame_ms"})
    EXPECT_FALSE(is_read([&](nlohmann::json& run) { run[list].erase(size_t{1}); })) << list;
}

class RunStoreTest : public testing::Test {
 protected:
  RunStoreTest() : folder_(test_folder() + "/out") {}

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

TEST_F(RunStoreTest, IsMarkedFromBeginToFinish) {
  EXPECT_FALSE(is_marked());
  {
    RunStore run(folder_);
    run.begin();
    run.save("key", "content");
    EXPECT_TRUE(is_marked());
  }
  EXPECT_TRUE(is_marked()) << "it ended without finish";
  RunStore again(folder_);
  EXPECT_TRUE(again.load("key").has_value());
  EXPECT_FALSE(again.load("other").has_value());
  again.finish();
  EXPECT_FALSE(is_marked());
  EXPECT_TRUE(fs::is_empty(folder_)) << "what was kept is gone";
}

TEST_F(RunStoreTest, ThatCannotBeLookedIntoIsNoFinishedOne) {
  fs::create_directories(folder_);
  fs::create_symlink(".unfinished", folder_ + "/.unfinished");  // a link to itself
  EXPECT_THAT(
      [&] { require_finished(folder_); },
      testing::ThrowsMessage<Error>(AllOf(HasSubstr(folder_ + "/.unfinished"), HasSubstr("symbolic links"))));
}

TEST_F(RunStoreTest, KeysDoNotLeaveTheFolder) {
  const RunStore run(folder_);
  EXPECT_THROW(run.save("../../evil", "content"), Error);
  EXPECT_THROW(run.load("../../evil"), Error);
}

TEST_F(RunStoreTest, RefusalBeforeTheWorkLeavesTheMarkAsItWas) {
  { const RunStore refused(folder_); }
  EXPECT_FALSE(is_marked());
  {
    RunStore interrupted(folder_);
    interrupted.begin();
  }
  { const RunStore refused(folder_); }
  EXPECT_TRUE(is_marked()) << "the interrupted run is not undone by a refused one";
}

TEST_F(RunStoreTest, HoldsOneRunAtATime) {
  {
    const RunStore first(folder_);
    EXPECT_THAT([&] { const RunStore second(folder_); },
                testing::ThrowsMessage<Error>(AllOf(HasSubstr(folder_), HasSubstr("another run"))));
    EXPECT_TRUE(is_marked()) << "the second did not take it away";
  }
  const RunStore free_again(folder_);
}

TEST_F(RunStoreTest, WhatIsDamagedHalfOrUnderAnotherNameIsMadeAnew) {
  const RunStore run(folder_);
  const std::string content = to_bytes(example_run());
  run.save("key", content);
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
  run.save("key", content);
  EXPECT_EQ(run.load("key"), content);
  write_file(folder_ + "/.unfinished/other.stored", bytes);
  EXPECT_FALSE(run.load("other").has_value());
}

TEST_F(RunStoreTest, SaysOnceWhatIsMadeAnew) {
  const RunStore run(folder_);
  for (const char* key : {"a", "b"}) write_file(folder_ + "/.unfinished/" + key + ".stored", "glovebench-stored");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(run.load("a").has_value());
  EXPECT_FALSE(run.load("b").has_value());
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("a.stored is damaged or from another version"), testing::Not(HasSubstr("b.stored"))));
}

TEST_F(RunStoreTest, RemovesAMarkThatWasPutAside) {
  write_file(folder_ + "/.finished-1/lock", "");  // a kill between the two steps of finish
  EXPECT_FALSE(is_marked());
  { const RunStore run(folder_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// `run` of six frames, two databases, four seeds, with robot commands.
class KilledRunLong : public RunStoreTest {
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
  /// Reads as `explain` does at the end.
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
