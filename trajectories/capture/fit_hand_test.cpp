#include "trajectories/capture/fit_hand.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/math.h"
#include "core/test_error.h"
#include "trajectories/capture/test_capture.h"
#include "trajectories/formats/format.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const HandModel& nominal_model() {
  static const HandModel hand = HandModel::load(build_paths::hand_mesh());
  return hand;
}
/// The hand that is captured: 5% larger, other segments.
const HandModel& subject() {
  static const HandModel hand = HandModel::load(build_paths::hand_mesh(), Side::right, second_subject());
  return hand;
}
Trajectory movement(const std::string& name, size_t frames = 1000) {
  Trajectory trajectory = load_trajectory(build_paths::source("trajectories/data/sources/") + name + ".json");
  trajectory.frames.resize(std::min(frames, trajectory.frames.size()));
  return trajectory;
}
HandFit fit(const MarkerSequence& sequence) {
  return fit_hand(sequence, place_markers(sequence.names, {}, nominal_model(), "capture"),
                  nominal_model().skeleton(), "capture");
}

/// Absolute errors of all angles but those that no point shows, degrees.
struct AngleErrors {
  double median = 0;
  double p95 = 0;
  std::string table;  ///< median and 95% of each angle
};
AngleErrors angle_errors(const HandFit& fit, const Trajectory& truth) {
  std::vector<double> all;
  AngleErrors result;
  for (int a = 0; a < kAngleCount; ++a) {
    if (fit.never_shown[a]) continue;
    std::vector<double> errors;
    for (size_t f = 0; f < truth.frames.size(); ++f)
      errors.push_back(degrees_from_radians(std::abs(fit.frames[f].state.posture[a] - truth.frames[f].posture[a])));
    result.table += fmt::format("{:24} {:6.2f} {:6.2f}\n", angle_infos()[a].name, *quantile_of(errors, 0.5),
                                *quantile_of(errors, 0.95));
    all.insert(all.end(), errors.begin(), errors.end());
  }
  result.median = *quantile_of(all, 0.5);
  result.p95 = *quantile_of(all, 0.95);
  return result;
}

TEST(FitHand, finds_the_angles_from_exact_joints_of_one_posture) {
  const Trajectory truth = movement("Tr1", 1);
  const HandFit result = fit(captured(truth, nominal_model(), webxr_names(), {}));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.p95, 1) << errors.table << "the prior of a hand's parts moves them a little";
}

TEST(FitHand, finds_the_angles_of_another_hand_from_joints_with_noise) {
  const Trajectory truth = movement("Tr4");
  const HandFit result = fit(captured(truth, subject(), webxr_names(), {.noise = 0.0005}));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.median, 1) << errors.table;
  EXPECT_TRUE(result.never_shown[kWristFlexion] && result.never_shown[kWristAbduction])
      << "no joint is on the forearm";
  EXPECT_EQ(std::ranges::count(result.never_shown, true), 2);
}

TEST(FitHand, finds_the_angles_of_another_hand_from_flawed_skin_markers) {
  const Trajectory truth = movement("Tr4", 60);
  const CaptureFlaws flaws{
      .noise = 0.001, .placement = 1, .gap_share = 0.05, .swap_share = 0.03, .unlabeled_share = 0.01};
  const HandFit result = fit(flawed(captured(truth, subject(), skin_names(), flaws), flaws));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.median, 3) << errors.table;
  EXPECT_GT(result.missing_points, 50);
  EXPECT_EQ(std::ranges::count(result.never_shown, true), 0) << "two markers are on the forearm";
}

TEST(FitHand, says_what_no_point_shows) {
  const Trajectory truth = movement("Tr4", 10);
  std::vector<std::string> names = webxr_names();
  std::erase_if(names, [](const std::string& name) {
    return name == "ring-finger-tip" || name == "thumb-tip" || name == "thumb-phalanx-distal";
  });
  const HandFit result = fit(captured(truth, nominal_model(), names, {}));
  std::vector<std::string_view> never;
  for (int a = 0; a < kAngleCount; ++a)
    if (result.never_shown[a]) never.push_back(angle_infos()[a].name);
  EXPECT_THAT(never, testing::ElementsAre("wrist_flexion", "wrist_abduction", "thumb_mcp_flexion",
                                          "thumb_ip_flexion", "ring_dip_flexion"));
  const Posture& posture = result.frames[5].state.posture;
  EXPECT_EQ(posture[kThumbIpFlexion], 0);
  EXPECT_NEAR(posture[kRingDipFlexion], posture[kRingPipFlexion] * 2 / 3, 1e-12) << "an end joint follows";
}

TEST(FitHand, bridges_a_short_gap_and_leaves_a_long_one_out) {
  const Trajectory truth = movement("Tr4", 40);  // at 15 Hz
  MarkerSequence sequence = captured(truth, nominal_model(), webxr_names(), {});
  for (const size_t f : {5, 6, 20, 21, 22, 23, 24, 25, 26, 27, 28, 39})
    sequence.frames[f].points.assign(sequence.names.size(), gap());
  const HandFit result = fit(sequence);
  for (size_t f = 0; f < truth.frames.size(); ++f) {
    const bool is_long = (f >= 20 && f <= 28) || f == 39;
    EXPECT_EQ(result.frames[f].bridged_pose, is_long || f == 5 || f == 6) << f;
    EXPECT_EQ(result.frames[f].left_out, is_long) << f;
  }
  const Eigen::Vector3d between = (result.frames[4].state.T_capture_hand.translation() * 2 +
                                   result.frames[7].state.T_capture_hand.translation()) /
                                  3;
  EXPECT_LT((result.frames[5].state.T_capture_hand.translation() - between).norm(), 1e-4) << "a third of the way";
}

std::string refusal(const MarkerSequence& sequence) {
  return thrown_by([&] { fit(sequence); });
}

TEST(FitHand, refuses_what_is_no_hand) {
  const MarkerSequence good = captured(movement("Tr4", 3), nominal_model(), webxr_names(), {});
  EXPECT_EQ(refusal(good), "");

  MarkerSequence large = good;
  for (MarkerFrame& frame : large.frames)
    for (Eigen::Vector3d& p : frame.points) p *= 10;
  EXPECT_THAT(refusal(large), AllOf(HasSubstr("capture: points: found a hand of 10 times"), HasSubstr("unit")));

  MarkerSequence fingertip = good;
  for (MarkerFrame& frame : fingertip.frames) {
    for (size_t p = 0; p < frame.points.size(); ++p)
      if (fingertip.names[p] != "index-finger-tip") frame.points[p] = gap();
  }
  EXPECT_THAT(refusal(fingertip), HasSubstr("found no frame with three on the palm"));

  // Few frames of few points could be some hand's: the parts of a hand are fitted, too.
  MarkerSequence nonsense = captured(movement("Tr4", 15), nominal_model(), webxr_names(), {});
  for (size_t f = 0; f < nonsense.frames.size(); ++f) {
    RandomStream random(1, "nonsense", static_cast<int64_t>(f), "points");
    for (Eigen::Vector3d& p : nonsense.frames[f].points)
      p = 0.04 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  EXPECT_THAT(refusal(nonsense), HasSubstr("found no frame that fits a hand"));

  MarkerSequence unnamed = good;
  unnamed.names[3] = "elbow";
  EXPECT_THAT(refusal(unnamed),
              AllOf(HasSubstr("capture: point: found \"elbow\""), HasSubstr("a place on the hand")));
}

/// End joints that bend on their own, by up to 15 degrees more or less than the prior says.
Trajectory with_free_end_joints(Trajectory movement) {
  for (size_t f = 0; f < movement.frames.size(); ++f) {
    Posture& posture = movement.frames[f].posture;
    for (int dip = kIndexDipFlexion; dip < kAngleCount; dip += 4)
      posture[dip] += radians_from_degrees(15) * std::sin(0.1 * static_cast<double>(f) + dip);
    posture = clamp_to_limits(posture);
  }
  return movement;
}

/// The figures of README.md, as a table: median and 95% over frames and angles, the second subject's hand.
class FitHandLong : public testing::Test {
 protected:
  static constexpr CaptureFlaws kFlaws{
      .noise = 0.001, .placement = 1, .gap_share = 0.05, .swap_share = 0.03, .unlabeled_share = 0.01};

  /// Prints a row and gives back the larger of the medians.
  static double row(const std::string& what, const std::vector<std::string>& names, const CaptureFlaws& flaws,
                    bool free_end_joints = false) {
    double worst = 0;
    std::string line = "| " + what + " |";
    for (const std::string name : {"Tr1", "Tr4"}) {
      const Trajectory truth = free_end_joints ? with_free_end_joints(movement(name)) : movement(name);
      const AngleErrors errors = angle_errors(fit(flawed(captured(truth, subject(), names, flaws), flaws)), truth);
      line += fmt::format(" {:.2f} / {:.1f} |", errors.median, errors.p95);
      worst = std::max(worst, errors.median);
    }
    fmt::print("{}\n", line);
    return worst;
  }
};

TEST_F(FitHandLong, joints_within_a_degree_markers_within_three) {
  EXPECT_LT(row("joints, 0.5 mm of noise", webxr_names(), {.noise = 0.0005}), 1);
  EXPECT_LT(row("skin markers, flawed", skin_names(), kFlaws), 3);
  CaptureFlaws far = kFlaws;
  far.placement = 2;
  EXPECT_LT(row("the same, markers twice as far from their places", skin_names(), far), 3);
  EXPECT_LT(row("the same, end joints on their own", skin_names(), kFlaws, true), 3);
}

}  // namespace
}  // namespace glovebench::trajectories
