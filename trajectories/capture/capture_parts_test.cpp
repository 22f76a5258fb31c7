// The parts of the fit, each on its own.
#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "ci/build_paths.h"
#include "core/test_error.h"
#include "trajectories/capture/calibrate_hand.h"
#include "trajectories/capture/fit_frame.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/capture/test_capture.h"

namespace glovebench::trajectories {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const HandModel& model() {
  static const HandModel hand = HandModel::load(build_paths::hand_mesh());
  return hand;
}
CaptureHand skin_hand() { return {model().skeleton(), place_markers(skin_names(), {}, model(), "capture")}; }
HandState some_state() {
  HandState state;
  for (int a = 0; a < kAngleCount; ++a) state.posture[a] = 0.1 + 0.04 * (a % 7);
  state.T_capture_hand = test_T_capture_camera();
  return state;
}
Eigen::VectorXd stacked(const std::vector<Eigen::Vector3d>& points) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(3 * points.size()));
  for (size_t i = 0; i < points.size(); ++i) all.segment<3>(static_cast<Eigen::Index>(3 * i)) = points[i];
  return all;
}

constexpr double kStep = 1e-6;
/// Of central differences: rounding of metres over the step.
constexpr double kDerivativeTolerance = 1e-8;

TEST(CaptureHand, derivative_by_the_state_is_that_of_the_points) {
  const CaptureHand hand = skin_hand();
  const HandState state = some_state();
  const Eigen::MatrixXd jacobian = state_jacobian(hand, state);
  for (int i = 0; i < kStateSize; ++i) {
    const StateStep step = kStep * StateStep::Unit(i);
    const Eigen::VectorXd numeric =
        (stacked(predict_points(hand, moved(state, step))) - stacked(predict_points(hand, moved(state, -step)))) /
        (2 * kStep);
    EXPECT_LT((jacobian.col(i) - numeric).cwiseAbs().maxCoeff(), kDerivativeTolerance) << i;
  }
}

TEST(CaptureHand, derivative_by_the_hand_is_that_of_the_points) {
  CaptureHand nominal = skin_hand();
  for (const PlacedMarker& joint : place_markers(webxr_names(), {}, model(), "capture"))
    nominal.markers.push_back(joint);
  const HandParameters parameters(nominal);
  const Eigen::VectorXd values = 0.3 * parameters.deviations();
  const HandState state = some_state();
  const Eigen::MatrixXd jacobian = parameters.jacobian(parameters.hand(values), state);
  for (int i = 0; i < parameters.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(parameters.size(), i);
    const Eigen::VectorXd numeric = (stacked(predict_points(parameters.hand(values + step), state)) -
                                     stacked(predict_points(parameters.hand(values - step), state))) /
                                    (2 * kStep);
    EXPECT_LT((jacobian.col(i) - numeric).cwiseAbs().maxCoeff(), kDerivativeTolerance) << i;
  }
}

TEST(MarkerPlaces, lie_on_the_skin_of_their_bone) {
  const PosedHand hand = model().pose(Posture::Zero());
  for (const std::string& name : skin_names()) {
    const PlacedMarker marker = place_marker(name, model()).value();
    const Eigen::Vector3d p = marker_frame(marker, hand.T_hand_joint) * marker.offset;
    double nearest = 1;
    for (const Eigen::Vector3f& v : hand.vertices) nearest = std::min(nearest, (v.cast<double>() - p).norm());
    EXPECT_LT(nearest, 0.012) << name << ": triangles are that large at the wrist";
    EXPECT_FALSE(marker.is_joint_center());
  }
  EXPECT_GT(place_marker("index_proximal", model())->offset.y(), 0.004) << "dorsal";
  EXPECT_LT(place_marker("wrist_radial", model())->offset.x(), -0.01) << "at the thumb's side";
  EXPECT_EQ(place_marker("index_proximal_12", model())->offset, place_marker("index_proximal", model())->offset);
  EXPECT_TRUE(place_marker("index-finger-tip", model())->is_joint_center());
  EXPECT_FALSE(place_marker("index_toe", model()));
}

TEST(MarkerPlaces, come_from_a_layout_for_other_names) {
  const std::vector<PlacedMarker> markers =
      place_markers({"RIDX3", "wrist", "unlabeled_1"}, {{"RIDX3", "index_tip"}}, model(), "capture");
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].name, "RIDX3");
  EXPECT_EQ(markers[0].offset, place_marker("index_tip", model())->offset);
  EXPECT_THAT(thrown_by([] {
                place_markers({"wrist"}, {{"RIDX3", "index_tip"}}, model(), "capture");
              }),
              AllOf(HasSubstr("capture: points"), HasSubstr("RIDX3")))
      << "a layout of other points";
}

TEST(MarkerLabels, assignment_is_the_best_of_all) {
  for (int i = 0; i < 50; ++i) {
    RandomStream random(1, "assignment", i, "costs");
    const Eigen::MatrixXd cost = Eigen::MatrixXd::NullaryExpr(4, 5, [&] { return random.uniform(); });
    std::vector<int> columns(5);
    std::iota(columns.begin(), columns.end(), 0);
    const auto sum = [&](const std::vector<int>& column_of) {
      double total = 0;
      for (int r = 0; r < 4; ++r) total += cost(r, column_of[static_cast<size_t>(r)]);
      return total;
    };
    double best = sum(columns);
    while (std::ranges::next_permutation(columns).found) best = std::min(best, sum(columns));
    EXPECT_NEAR(sum(assign(cost)), best, 1e-12);
  }
}

TEST(MarkerLabels, follow_the_prediction_through_swaps_and_missing_names) {
  const std::vector<Eigen::Vector3d> truth = {{0, 0, 0}, {0.02, 0, 0}, {0.04, 0, 0}, {0.06, 0, 0}};
  const Eigen::Vector3d noise(0.001, -0.002, 0.001);
  std::vector<Eigen::Vector3d> seen;
  for (const Eigen::Vector3d& p : truth) seen.push_back(p + noise);
  EXPECT_EQ(relabel(truth, seen, {}).corrected, 0);
  EXPECT_EQ(relabel(truth, seen, {truth[0]}).corrected, 0)
      << "a nearer point without a name does not take one's place";

  std::vector<Eigen::Vector3d> swapped = seen;
  std::swap(swapped[1], swapped[2]);
  const Relabeling back = relabel(truth, swapped, {});
  EXPECT_EQ(back.points, seen);
  EXPECT_EQ(back.corrected, 2);

  std::vector<Eigen::Vector3d> unnamed = seen;
  unnamed[3] = gap();
  const Relabeling found = relabel(truth, unnamed, {gap(), Eigen::Vector3d(1, 1, 1), seen[3]});
  EXPECT_EQ(found.points, seen);
  EXPECT_EQ(found.corrected, 1);

  std::vector<Eigen::Vector3d> ghost = seen;
  ghost[0] = Eigen::Vector3d(0, 0.05, 0);
  const Relabeling without = relabel(truth, ghost, {});
  EXPECT_FALSE(is_seen(without.points[0])) << "a point that is nobody's";
  EXPECT_EQ(without.corrected, 1);
}

TEST(BridgeGaps, goes_evenly_from_frame_to_frame_and_rests_at_the_ends) {
  std::vector<HandState> states(6);
  std::vector<Observability> shown(6);
  for (size_t f = 0; f < 6; ++f) {
    shown[f].pose = true;
    shown[f].angles.fill(true);
    states[f].posture[kIndexPipFlexion] = 0.1 * static_cast<double>(f * f);
  }
  for (const size_t f : {0, 2, 3, 5}) shown[f].angles[kIndexPipFlexion] = false;
  const Bridged bridged = bridge_gaps(states, shown, {0, 1, 2, 2.5, 3, 4});
  const auto angle = [&](size_t f) { return bridged.states[f].posture[kIndexPipFlexion]; };
  EXPECT_DOUBLE_EQ(angle(0), 0.1);
  EXPECT_DOUBLE_EQ(angle(2), 0.5 * (0.1 + 1.6));
  EXPECT_DOUBLE_EQ(angle(3), 0.25 * 0.1 + 0.75 * 1.6);
  EXPECT_DOUBLE_EQ(angle(5), 1.6);
  EXPECT_EQ(bridged.angle_gaps, 3);
  EXPECT_TRUE(bridged.angles[2][kIndexPipFlexion]);
  EXPECT_FALSE(bridged.angles[1][kIndexPipFlexion]);
  EXPECT_EQ(std::ranges::count(bridged.never_shown, true), 0);
}

}  // namespace
}  // namespace glovebench::trajectories
