#include "trajectories/trajectory.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/test_error.h"
#include "core/test_folder.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

Trajectory example(int frame_count = 3) {
  Trajectory trajectory{.name = "wave", .description = "a \"quoted\" wave", .provenance = {}, .frames = {}};
  RandomStream random(7, "trajectory_test", 0, "frames");
  for (int i = 0; i < frame_count; ++i) {
    HandFrame& frame = trajectory.frames.emplace_back();
    frame.timestamp_us = i * 66'667;
    for (int a = 0; a < kAngleCount; ++a) frame.posture[a] = radians_from_degrees(random.uniform(-10, 25));
    frame.T_camera_hand.translation() << random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.7;
    frame.T_camera_hand.linear() =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized()
            .toRotationMatrix();
  }
  return trajectory;
}

json example_json() { return json::parse(canonical_text(example())); }

std::string complaint(const std::string& text) {
  return thrown_by([&] { parse_trajectory(text, "my.json"); });
}

std::string complaint(const json& document) { return complaint(document.dump()); }

TEST(Trajectory, keeps_its_values_to_the_rounding_of_the_file) {
  const Trajectory before = example(50);
  const Trajectory after = parse_trajectory(canonical_text(before), "memory");
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.description, before.description);
  ASSERT_EQ(after.frames.size(), before.frames.size());
  for (size_t i = 0; i < before.frames.size(); ++i) {
    const HandFrame& a = before.frames[i];
    const HandFrame& b = after.frames[i];
    EXPECT_EQ(b.timestamp_us, a.timestamp_us);
    // Half a step of the file: 0.001 deg, 0.001 mm; the quaternion's 1e-7 steps turn by at most 2e-7 rad.
    EXPECT_LE((b.posture - a.posture).cwiseAbs().maxCoeff(), radians_from_degrees(0.000501));
    EXPECT_LE((b.T_camera_hand.translation() - a.T_camera_hand.translation()).cwiseAbs().maxCoeff(), 0.501e-6);
    EXPECT_LE((b.T_camera_hand.linear() - a.T_camera_hand.linear()).cwiseAbs().maxCoeff(), 4e-7);
  }
}

TEST(Trajectory, canonical_text_is_a_fixed_point) {
  const std::string text = canonical_text(example(400));
  const Trajectory parsed = parse_trajectory(text, "memory");
  EXPECT_EQ(canonical_text(parsed), text);
  EXPECT_EQ(hash(parsed), hash(example(400)));
  EXPECT_EQ(hash(parsed).size(), 32u);
}

TEST(Trajectory, hash_sees_every_part) {
  const std::string before = hash(example());
  Trajectory changed = example();
  changed.frames[1].posture[3] += radians_from_degrees(0.002);
  EXPECT_NE(hash(changed), before);
  changed = example();
  changed.side = Side::left;
  EXPECT_NE(hash(changed), before);
  changed = example();
  changed.frames[2].timestamp_us += 1;
  EXPECT_NE(hash(changed), before);
}

TEST(Trajectory, writes_and_loads_a_file) {
  Trajectory recorded = example();
  recorded.kind = TrajectoryKind::recorded;
  recorded.provenance = Provenance{"Tr1", "00ff", "DB_open_pinch", "11ee", "paper", "22dd"};
  const std::string path = test_folder() + "/recorded.json";
  write_trajectory(recorded, path);
  const Trajectory loaded = load_trajectory(path);
  EXPECT_EQ(loaded.kind, TrajectoryKind::recorded);
  EXPECT_EQ(loaded.provenance, recorded.provenance);
  EXPECT_EQ(canonical_text(loaded), read_file(path));
}

TEST(Trajectory, opposite_quaternions_are_one_rotation) {
  json document = example_json();
  const std::string before = hash(parse_trajectory(document.dump(), "memory"));
  for (json& component : document["frames"][1]["quaternion_wxyz"]) component = -component.get<double>();
  EXPECT_EQ(hash(parse_trajectory(document.dump(), "memory")), before);
}

TEST(Trajectory, names_file_field_found_and_expected) {
  json document = example_json();
  document["frames"][2]["angles_deg"][3] = 200;
  EXPECT_EQ(complaint(document), "my.json: frames[2].angles_deg[3]: found 200, expected a number in -35..60");
}

TEST(Trajectory, refuses_what_is_not_json) {
  EXPECT_THAT(complaint(std::string("")), HasSubstr("expected JSON"));
  EXPECT_THAT(complaint(std::string("{\"format\": ")), HasSubstr("expected JSON"));
  std::string text = canonical_text(example());
  text.resize(text.size() / 2);
  EXPECT_THAT(complaint(text), HasSubstr("expected JSON"));
  EXPECT_THAT(complaint(std::string("[]")), HasSubstr("top level: found an array of 0, expected an object"));
}

TEST(Trajectory, refuses_numbers_that_are_not_finite) {
  const std::string text = canonical_text(example());
  const size_t at = text.find("[", text.find("position_mm")) + 1;
  const size_t length = text.find(",", at) - at;
  for (const char* bad : {"NaN", "Infinity", "-Infinity"})
    EXPECT_THAT(complaint(std::string(text).replace(at, length, bad)), HasSubstr("expected JSON")) << bad;
  EXPECT_THAT(complaint(std::string(text).replace(at, length, "1e999")), HasSubstr("expected a finite number"));
  EXPECT_EQ(complaint(std::string(text).replace(at, length, "null")),
            "my.json: frames[0].position_mm[0]: found null, expected a number in -10000..10000");
}

TEST(Trajectory, refuses_unknown_missing_and_repeated_keys) {
  json document = example_json();
  document["frames"][1]["speed"] = 1;
  EXPECT_THAT(complaint(document), AllOf(HasSubstr("frames[1]"), HasSubstr("unknown key \"speed\"")));
  document = example_json();
  document.erase("side");
  EXPECT_THAT(complaint(document), HasSubstr("side: found nothing"));
  std::string text = canonical_text(example());
  text.insert(text.find("\"side\""), "\"side\": \"left\", ");
  EXPECT_THAT(complaint(text), HasSubstr("side: found the key twice"));
}

TEST(Trajectory, refuses_other_formats_and_versions) {
  json document = example_json();
  document["version"] = 2;
  EXPECT_THAT(complaint(document), HasSubstr("version: found 2"));
  document = example_json();
  document["format"] = "other";
  EXPECT_THAT(complaint(document), HasSubstr("format: found \"other\", expected \"glovebench-trajectory\""));
  document = example_json();
  document["side"] = "up";
  EXPECT_THAT(complaint(document), HasSubstr("side: found \"up\""));
  document = example_json();
  document["name"] = "../escape";
  EXPECT_THAT(complaint(document), HasSubstr("name: found \"../escape\""));
}

TEST(Trajectory, refuses_other_joints) {
  json document = example_json();
  document["joint_order"][4] = "elbow";
  EXPECT_EQ(complaint(document), "my.json: joint_order[4]: found \"elbow\", expected \"thumb_mcp_flexion\"");
  document = example_json();
  document["frames"][0]["angles_deg"].erase(21);
  EXPECT_EQ(complaint(document), "my.json: frames[0].angles_deg: found 21 elements, expected 22");
}

TEST(Trajectory, refuses_time_that_stands_still_or_runs_back) {
  json document = example_json();
  document["frames"][2]["timestamp_us"] = document["frames"][1]["timestamp_us"];
  EXPECT_EQ(complaint(document), "my.json: frames[2].timestamp_us: found 66667, expected more than 66667");
  document["frames"][2]["timestamp_us"] = 5;
  EXPECT_THAT(complaint(document), HasSubstr("frames[2].timestamp_us: found 5, expected more than 66667"));
  document["frames"][2]["timestamp_us"] = 1.5;
  EXPECT_THAT(complaint(document), HasSubstr("expected a whole number in 0.."));
  document["frames"][2]["timestamp_us"] = std::numeric_limits<uint64_t>::max();
  EXPECT_THAT(complaint(document), HasSubstr("expected a whole number in 0.."));
}

TEST(Trajectory, refuses_quaternions_that_are_not_unit) {
  json document = example_json();
  document["frames"][1]["quaternion_wxyz"] = {0.9, 0, 0, 0};
  EXPECT_THAT(complaint(document), HasSubstr("frames[1].quaternion_wxyz: found length 0.900000"));
  document["frames"][1]["quaternion_wxyz"] = {0, 0, 0, 0};
  EXPECT_THAT(complaint(document), HasSubstr("frames[1].quaternion_wxyz: found length 0.000000"));
  document["frames"][1]["quaternion_wxyz"] = {0.7071, 0.7071, 0, 0};
  EXPECT_EQ(complaint(document), "");
}

TEST(Trajectory, refuses_no_frames_and_unfit_provenance) {
  json document = example_json();
  document["frames"] = json::array();
  EXPECT_EQ(complaint(document), "my.json: frames: found an empty array, expected at least one element");
  document = example_json();
  document["kind"] = "recorded";
  EXPECT_THAT(complaint(document), HasSubstr("provenance: found none"));
}

TEST(Trajectory, is_not_written_when_it_would_be_refused) {
  Trajectory trajectory = example();
  trajectory.frames[1].posture[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(canonical_text(trajectory), Error);
  trajectory = example();
  trajectory.frames[1].T_camera_hand.linear().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(canonical_text(trajectory), Error);
  trajectory = example();
  trajectory.frames.clear();
  EXPECT_THROW(canonical_text(trajectory), Error);
}

}  // namespace
}  // namespace glovebench::trajectories
