#include "trajectories/generation/motion_script.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/test_error.h"
#include "trajectories/generation/natural_variation.h"

namespace glovebench::trajectories {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

PostureSet gestures() {
  Posture bent = Posture::Zero();
  bent[kIndexMcpFlexion] = 0.8;
  return {"gestures", {"flat", "bent"}, {Posture::Zero(), bent}};
}

json example_script() {
  return json::parse(R"({
    "format": "glovebench-motion-script", "version": 1, "name": "s", "description": "d", "seed": 1, "frame_count": 31,
    "postures": [{"frame": 0, "blend": {"flat": 1}}, {"frame": 30, "blend": {"flat": 0.25, "bent": 0.75}}],
    "wrist": [{"frame": 0, "flexion_deg": 0, "abduction_deg": 0}, {"frame": 30, "flexion_deg": 20, "abduction_deg": 0}],
    "poses": [{"frame": 0, "position_mm": [0, 0, 700], "yaw_deg": 0, "pitch_deg": 0, "roll_deg": 0},
              {"frame": 30, "position_mm": [100, 0, 700], "yaw_deg": 40, "pitch_deg": 0, "roll_deg": 0}]})");
}

MotionScript parse(const json& document) { return parse_motion_script(document.dump(), gestures(), "script.json"); }

std::string script_complaint(const json& document) {
  return thrown_by([&] { parse(document); });
}

TEST(MinimumJerk, starts_and_ends_at_rest) {
  EXPECT_DOUBLE_EQ(minimum_jerk(0), 0);
  EXPECT_DOUBLE_EQ(minimum_jerk(0.5), 0.5);
  EXPECT_DOUBLE_EQ(minimum_jerk(1), 1);
  const double h = 1e-4;
  // Speed and acceleration vanish, so the first step is of the third order: 10 h^3.
  EXPECT_LT(minimum_jerk(h), 11 * h * h * h);
  EXPECT_NEAR((minimum_jerk(0.5 + h) - minimum_jerk(0.5 - h)) / (2 * h), 1.875, 1e-6);  // second-order difference
}

TEST(HandRotation, shows_the_back_of_the_hand_with_fingers_up) {
  const Eigen::Matrix3d R_camera_hand = hand_rotation(0, 0, 0).toRotationMatrix();
  // Rounding of sine and cosine only.
  EXPECT_TRUE((R_camera_hand * Eigen::Vector3d(0, 0, -1)).isApprox(Eigen::Vector3d(0, -1, 0), 1e-12));
  EXPECT_TRUE((R_camera_hand * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -1), 1e-12));
  EXPECT_TRUE((R_camera_hand * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  const Eigen::Matrix3d turned = hand_rotation(radians_from_degrees(90), 0, 0).toRotationMatrix();
  EXPECT_TRUE((turned * Eigen::Vector3d(0, 0, -1)).isApprox(Eigen::Vector3d(1, 0, 0), 1e-12)) << "yaw is clockwise";
}

TEST(MotionScript, plays_its_keyframes_up_to_drift) {
  const Trajectory trajectory = perform(parse(example_script()));
  ASSERT_EQ(trajectory.frames.size(), 31u);
  EXPECT_EQ(trajectory.frames[3].timestamp_us, 200'000);
  EXPECT_EQ(trajectory.frames[1].timestamp_us, 66'667);
  // Drift: 2 mm and 1 degree RMS an axis, about 4 degrees RMS over the angles; four waves peak at 2.8 times that.
  for (const auto& [frame, x, flexion] : {std::tuple{0, 0.0, 0.0}, {15, 0.05, 0.3}, {30, 0.1, 0.6}}) {
    EXPECT_NEAR(trajectory.frames[frame].T_camera_hand.translation().x(), x, 0.007);
    EXPECT_NEAR(trajectory.frames[frame].posture[kIndexMcpFlexion], flexion, radians_from_degrees(16));
  }
  EXPECT_NEAR(trajectory.frames[30].posture[kWristFlexion], radians_from_degrees(20), radians_from_degrees(3));
  const Eigen::Quaterniond last(trajectory.frames[30].T_camera_hand.linear());
  EXPECT_LT(last.angularDistance(hand_rotation(radians_from_degrees(40), 0, 0)), radians_from_degrees(5.5));
}

TEST(MotionScript, depends_on_its_seed_only) {
  json other = example_script();
  other["seed"] = 2;
  EXPECT_EQ(hash(perform(parse(example_script()))), hash(perform(parse(example_script()))));
  EXPECT_NE(hash(perform(parse(example_script()))), hash(perform(parse(other))));
}

TEST(MotionScript, refuses_keys_that_do_not_span_the_frames) {
  json bad = example_script();
  bad["wrist"][1]["frame"] = 29;
  EXPECT_EQ(script_complaint(bad), "script.json: wrist: found the last key at frame 29, expected 30");
  bad = example_script();
  bad["poses"][0]["frame"] = 1;
  EXPECT_THAT(script_complaint(bad), HasSubstr("poses[0].frame: found 1"));
  bad = example_script();
  bad["postures"][1]["frame"] = 0;
  EXPECT_THAT(script_complaint(bad), HasSubstr("postures[1].frame: found 0, expected a whole number in 1..30"));
}

TEST(MotionScript, refuses_impossible_blends) {
  json bad = example_script();
  bad["postures"][0]["blend"] = {{"fist", 1}};
  EXPECT_THAT(script_complaint(bad), HasSubstr("found \"fist\", expected one of flat, bent"));
  bad["postures"][0]["blend"] = {{"flat", 0.5}};
  EXPECT_THAT(script_complaint(bad), HasSubstr("postures[0].blend: found weights with sum 0.5, expected sum 1"));
}

TEST(NaturalVariation, modes_have_one_degree_and_leave_the_wrist) {
  for (const Posture& mode : variation_modes()) {
    EXPECT_NEAR(posture_distance(mode, Posture::Zero()), radians_from_degrees(1), 1e-12);  // rounding only
    EXPECT_EQ(mode.head<2>(), Eigen::Vector2d::Zero());
  }
}

TEST(NaturalVariation, noise_has_unit_root_mean_square_and_is_smooth) {
  RandomStream random(3, "natural_variation_test", 0, "noise");
  const SmoothNoise noise(random, 0.05, 0.4);
  double square_sum = 0, largest_step = 0;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i) {
    square_sum += noise.at(i * 0.05) * noise.at(i * 0.05);
    largest_step = std::max(largest_step, std::abs(noise.at((i + 1) * 0.05) - noise.at(i * 0.05)));
  }
  EXPECT_NEAR(std::sqrt(square_sum / count), 1, 0.02);                    // over 500 periods of the slowest wave
  EXPECT_LE(largest_step, 0.05 * 2 * 3.1416 * 0.4 * 4 / std::sqrt(2.0));  // four waves at the highest frequency
}

}  // namespace
}  // namespace glovebench::trajectories
