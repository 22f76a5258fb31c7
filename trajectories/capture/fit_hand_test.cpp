#include "trajectories/capture/fit_hand.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "trajectories/capture/quantile.h"
#include "trajectories/capture/test_capture.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const HandModel& model() {
  static const HandModel hand = HandModel::load(GLOVEBENCH_HAND_MESH);
  return hand;
}
/// The hand that is captured: 5% larger, other segments.
const HandModel& subject() {
  static const HandModel hand = HandModel::load(GLOVEBENCH_HAND_MESH, Side::right, second_subject());
  return hand;
}
Trajectory movement(const std::string& name, size_t frames = 1000) {
  Trajectory trajectory = load_trajectory(GLOVEBENCH_TRAJECTORIES "/data/sources/" + name + ".json");
  trajectory.frames.resize(std::min(frames, trajectory.frames.size()));
  return trajectory;
}
HandFit fit(const MarkerSequence& sequence) {
  return fit_hand(sequence, place_markers(sequence.names, {}, model(), "capture"), model().skeleton(), "capture");
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
    for (size_t f = 0; f < truth.frames.size(); ++f) {
      errors.push_back(degrees_from_radians(std::abs(fit.frames[f].state.posture[a] - truth.frames[f].posture[a])));
    }
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
  const HandFit result = fit(captured(truth, model(), webxr_names(), {}));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.p95, 1) << errors.table << "the prior of a hand's parts moves them a little";
}

TEST(FitHand, finds_the_angles_of_another_hand_from_joints_with_noise) {
  const Trajectory truth = movement("Tr4");
  const HandFit result = fit(captured(truth, subject(), webxr_names(), {.noise = 0.0005}));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.median, 1) << errors.table;
  RecordProperty("median_deg", fmt::format("{:.2f}", errors.median));
  RecordProperty("p95_deg", fmt::format("{:.2f}", errors.p95));
  EXPECT_TRUE(result.never_shown[kWristFlexion] && result.never_shown[kWristAbduction])
      << "no joint is on the forearm";
  EXPECT_EQ(std::ranges::count(result.never_shown, true), 2);
}

TEST(FitHand, finds_the_angles_of_another_hand_from_flawed_skin_markers) {
  const Trajectory truth = movement("Tr4");
  const CaptureFlaws flaws{
      .noise = 0.001, .placement = 1, .gap_share = 0.05, .swap_share = 0.03, .unlabeled_share = 0.01};
  const HandFit result = fit(flawed(captured(truth, subject(), skin_names(), flaws), flaws));
  const AngleErrors errors = angle_errors(result, truth);
  EXPECT_LT(errors.median, 3) << errors.table;
  RecordProperty("median_deg", fmt::format("{:.2f}", errors.median));
  RecordProperty("p95_deg", fmt::format("{:.2f}", errors.p95));
  EXPECT_GT(result.missing_points, 100);
  EXPECT_EQ(std::ranges::count(result.never_shown, true), 0) << "two markers are on the forearm";
}

}  // namespace
}  // namespace glovebench::trajectories
