#include "trajectories/generation/families/movement.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/camera/rgbd_calibration.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"
#include "core/test_error.h"
#include "trajectories/generation/families/solid_hand.h"
#include "trajectories/generation/motion_script.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::trajectories {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const MovementMaterial& test_material() {
  static const MovementMaterial material = load_movement_material(
      build_paths::source("trajectories/data"), HandModel::load(build_paths::hand_mesh()).skeleton());
  return material;
}

/// A movement as it is read from its file.
Trajectory written_movement(const MovementFamily& family, uint64_t seed, int frame_count = kMovementFrames) {
  return parse_trajectory(canonical_text(generate_movement(family, seed, test_material(), frame_count)),
                          "movement");
}

double nearest_gesture_deg(const Posture& posture) {
  double nearest = 180;
  for (const Posture& gesture : test_material().gestures.postures)
    nearest = std::min(nearest, degrees_from_radians(finger_distance(posture, gesture)));
  return nearest;
}

/// The largest speed, m/s, and turn rate, rad/s, between frames.
struct Peaks {
  double speed = 0;
  double turn_rate = 0;
};
Peaks peaks_of(const Trajectory& movement) {
  Peaks peaks;
  for (size_t f = 1; f < movement.frames.size(); ++f) {
    const Eigen::Isometry3d &a = movement.frames[f - 1].T_camera_hand, &b = movement.frames[f].T_camera_hand;
    peaks.speed = std::max(peaks.speed, (b.translation() - a.translation()).norm() * kFrameRateHz);
    peaks.turn_rate = std::max(peaks.turn_rate, angle_between(a.linear(), b.linear()) * kFrameRateHz);
  }
  return peaks;
}

// Files hold 0.001 mm, 0.001 degrees and 1e-7 of a quaternion.
constexpr double kRoundedDeg = 0.002;

class Families : public ::testing::TestWithParam<std::string> {
 protected:
  const MovementFamily& family = find_movement_family(GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, Families, ::testing::ValuesIn(movement_family_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(Families, poses_stay_in_their_ranges) {
  const PinholeCamera camera = synthetic_calibration().ir;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const Trajectory movement = written_movement(family, seed);
    for (const HandFrame& frame : movement.frames) {
      const Eigen::Vector3d position = frame.T_camera_hand.translation();
      const double tilt = tilt_deg(frame.T_camera_hand.linear());
      EXPECT_TRUE(tilt >= family.tilt_deg.low - kRoundedDeg && tilt <= family.tilt_deg.high + kRoundedDeg) << tilt;
      EXPECT_TRUE(family.depth.low - 1e-6 <= position.z() && position.z() <= family.depth.high + 1e-6)
          << position.z();
      const Eigen::Vector2d off_px = camera.project(position) - Eigen::Vector2d(camera.cx, camera.cy);
      EXPECT_LE(std::abs(off_px.x()), family.off_axis * camera.width / 2 + 0.01);
      EXPECT_LE(std::abs(off_px.y()), family.off_axis * camera.height / 2 + 0.01);
    }
    const Peaks peaks = peaks_of(movement);
    EXPECT_LE(peaks.speed, family.speed.high);
    EXPECT_LE(peaks.turn_rate, family.turn_rate.high + 1e-5);
    EXPECT_GT(peaks.speed, 1e-3) << "the hand moves";
  }
}

class RandomPostures : public Families {};
INSTANTIATE_TEST_SUITE_P(All, RandomPostures, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const MovementFamily& family : movement_families())
                             if (!family.captured) names.emplace_back(family.name);
                           return names;
                         }()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(RandomPostures, keep_the_rules) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    for (const HandFrame& frame : written_movement(family, seed).frames) {
      EXPECT_GE(nearest_gesture_deg(frame.posture), kGestureDistanceDeg - kRoundedDeg);
      EXPECT_LE(deepest_overlap(test_material().skeleton, frame.posture), kMostOverlap + 1e-5);
      for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
        if (degrees_from_radians(frame.posture[pip]) < 1) continue;  // rounded, a share of nothing is anything
        const double share = frame.posture[pip + 1] / frame.posture[pip];
        EXPECT_TRUE(share >= kDipShare.low - kRoundedDeg && share <= kDipShare.high + kRoundedDeg) << share;
      }
      for (const int wrist : {kWristFlexion, kWristAbduction}) {
        EXPECT_GE(degrees_from_radians(frame.posture[wrist]),
                  family.wrist * angle_infos()[wrist].min_deg - kRoundedDeg);
        EXPECT_LE(degrees_from_radians(frame.posture[wrist]),
                  family.wrist * angle_infos()[wrist].max_deg + kRoundedDeg);
      }
    }
  }
}

TEST_P(Families, depend_on_the_seed_alone) {
  const std::string once = canonical_text(generate_movement(family, 7, test_material()));
  generate_movement(family, 8, test_material());
  EXPECT_EQ(canonical_text(generate_movement(family, 7, test_material())), once);
  EXPECT_NE(hash(generate_movement(family, 8, test_material())), hash(parse_trajectory(once, "movement")));
  Trajectory longer = generate_movement(family, 7, test_material(), 130);
  longer.frames.resize(kMovementFrames);
  EXPECT_EQ(canonical_text(longer), once) << "a shorter movement is the beginning of a longer one";
  EXPECT_EQ(generate_movement(family, 7, test_material(), 1).frames.size(), 1U);
}

TEST(Movement, fast_ones_come_near_their_limits) {
  const MovementFamily& fast = find_movement_family("fast");
  Peaks peaks;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Peaks one = peaks_of(written_movement(fast, seed));
    peaks = {std::max(peaks.speed, one.speed), std::max(peaks.turn_rate, one.turn_rate)};
  }
  EXPECT_GT(peaks.speed, 0.75 * 2);
  EXPECT_GT(peaks.turn_rate, 0.75 * 10);
}

TEST(Movement, at_the_border_go_out_and_come_back) {
  const PinholeCamera camera = synthetic_calibration().ir;
  const WorkingVolume volume;
  int out = 0, changes = 0, frames = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    std::optional<bool> before;
    for (const HandFrame& frame : written_movement(find_movement_family("border"), seed).frames) {
      const Eigen::Vector3d position = frame.T_camera_hand.translation();
      const Eigen::Vector2d uv_px = camera.project(position);
      const bool is_out = position.z() < volume.z_min || position.z() > volume.z_max || uv_px.x() < 0 ||
                          uv_px.y() < 0 || uv_px.x() > camera.width || uv_px.y() > camera.height;
      out += is_out;
      changes += before && *before != is_out;
      before = is_out;
      ++frames;
    }
  }
  EXPECT_GT(out, frames / 20);
  EXPECT_LT(out, frames / 2);
  EXPECT_GE(changes, 20) << "two a movement";
}

TEST(Movement, captured_ones_rest_at_postures_of_people) {
  const Posture first = written_movement(find_movement_family("captured"), 1).frames.front().posture;
  double nearest = 1;
  for (const Posture& posture : test_material().captured.postures)
    nearest = std::min(nearest, posture_distance(posture, first));
  EXPECT_LT(degrees_from_radians(nearest), kRoundedDeg);
}

TEST(Movement, without_a_posture_that_fits_is_refused) {
  MovementMaterial material = test_material();
  material.least_distance_deg = 90;
  EXPECT_THAT(thrown_by([&] { generate_movement(find_movement_family("side"), 3, material); }),
              AllOf(HasSubstr("side_3: ranges: found none of"), HasSubstr("90 deg"), Not(HasSubstr("\n"))))
      << "no posture is so far away";
}

TEST(Movement, is_found_by_its_name) {
  const std::optional<NamedMovement> found = find_movement("side_12");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->family->name, "side");
  EXPECT_EQ(found->seed, 12U);
  for (const char* other :
       {"side", "side_", "side_012", "side_+1", "side_1x", "Tr1", "sid_1", "side_1000001", "_1"})
    EXPECT_FALSE(find_movement(other)) << other;
  EXPECT_THROW(find_movement_family("sideways"), Error);
}

double correlation_of(const std::vector<Posture>& postures, int angle, int other) {
  Eigen::MatrixX2d values(postures.size(), 2);
  for (size_t i = 0; i < postures.size(); ++i)
    values.row(static_cast<int>(i)) << postures[i][angle], postures[i][other];
  values.rowwise() -= values.colwise().mean().eval();
  return values.col(0).dot(values.col(1)) / (values.col(0).norm() * values.col(1).norm());
}

TEST(RandomPosture, flexions_of_neighbors_correlate) {
  std::vector<Posture> drawn, kept;
  for (int i = 0; i < 4000; ++i) {
    RandomStream random(1, "movement_test", i, "posture");
    drawn.push_back(random_posture(find_movement_family("any"), {0, 1}, random));
    if (nearest_gesture_deg(drawn.back()) >= kGestureDistanceDeg &&
        deepest_overlap(test_material().skeleton, drawn.back()) <= kMostOverlap)
      kept.push_back(drawn.back());
  }
  for (const int flexion : {kIndexMcpFlexion, kIndexPipFlexion}) {
    for (int finger = 0; finger < 3; ++finger) {
      const int angle = flexion + 4 * finger;
      // Of 4,000 pairs the standard deviation is (1 - 0.36) / sqrt(4000) = 0.01.
      EXPECT_NEAR(correlation_of(drawn, angle, angle + 4), kNeighborCorrelation, 0.03);
      EXPECT_NEAR(correlation_of(kept, angle, angle + 4), kNeighborCorrelation, 0.08) << "of what does not pierce";
    }
    EXPECT_NEAR(correlation_of(drawn, flexion, flexion + 12), 0.23, 0.05) << "index and little finger";
  }
}

}  // namespace
}  // namespace glovebench::trajectories
