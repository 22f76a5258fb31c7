#include "core/calibration/hand_fit.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/calibration/hand_report.h"
#include "core/database/test_database.h"
#include "core/pose/test_alignment.h"
#include "core/test_error.h"
#include "core/tracker/test_scene.h"

namespace glovebench::calibration {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kViews = 16;

/// A hand that closes, opens and turns before an ideal camera. The fit begins beside the truth, as far as a hand of
/// other sizes leads the tracker.
std::vector<TrackedView> filmed(const HandModel& hand, double turn = 1.2) {
  std::vector<TrackedView> views;
  render::LabelRenderer renderer;
  for (int v = 0; v < kViews; ++v) {
    RandomStream random(1, "hand fit", v, "view");
    Posture posture = 0.5 * (1 - std::cos(1.3 * v)) * power_posture();
    for (double& angle : posture) angle += random.uniform(-0.1, 0.1);
    posture = clamp_to_limits(posture);
    const Eigen::Isometry3d T =
        test_pose({0.01 * (v % 3), 0.03, 0.62}, {0.2 + 0.3 * std::sin(0.9 * v), turn * std::sin(0.7 * v), 0.1});
    const HandImages images = renderer.render_ids(hand, hand.pose(posture), kKinect, T);
    TrackedView& view = views.emplace_back();
    view.timestamp_us = 66'667 * v;
    view.seen.points = build_cloud(images.depth, images.label, kKinect, WorkingVolume{}).points;
    view.seen.mask.assign(images.depth, {Image<uint16_t>(640, 480, 900)}, label_box(images.label, 40), 2.0f);
    view.pose = {posture, perturbed_by(T, 2, 0.003, v)};
    for (double& angle : view.pose.posture) angle += random.uniform(-0.08, 0.08);
    view.pose.posture = clamp_to_limits(view.pose.posture);
  }
  return views;
}

HandFit fit_of(const HandShape& shape, double turn = 1.2, Side side = Side::right) {
  const HandModel hand = HandModel::load(build_paths::hand_mesh(), side, shape);
  return fit_hand_shape(filmed(hand, turn), kKinect, {build_paths::hand_mesh(), side});
}

double worst_seen_percent(const HandFit& fit, const HandShape& truth, int first, int count) {
  double worst = 0;
  for (int size = first; size < first + count; ++size)
    if (fit.seen[size]) worst = std::max(worst, 100 * std::abs(fit.shape.sizes[size] / truth.sizes[size] - 1));
  return worst;
}

TEST(HandFitLong, finds_the_sizes_of_another_hand) {
  HandShape truth = second_subject();
  truth.sizes[kPalmBreadth] = 1.06;
  truth.sizes[kLittlePalmLength] = 0.96;
  truth.sizes[kSegmentWidths + 6] = 1.08;
  for (const Side side : {Side::right, Side::left}) {
    SCOPED_TRACE(to_string(side));
    const HandFit fit = fit_of(truth, 1.2, side);
    EXPECT_GT(std::ranges::count(fit.seen, true), 30);
    EXPECT_NEAR(fit.shape.sizes[kScale], 1.05, 0.01);
    EXPECT_NEAR(fit.shape.sizes[kPalmBreadth], 1.06, 0.02);
    EXPECT_NEAR(fit.shape.sizes[kLittlePalmLength], 0.96, 0.02);
    EXPECT_LT(worst_seen_percent(fit, truth, kSegmentLengths, kSegmentCount), 5);
    EXPECT_LT(worst_seen_percent(fit, truth, kSegmentWidths, kSegmentCount), 5);
    EXPECT_LT(fit.residual, 0.3 * fit.residual_before);
  }
}

/// The share of the hand's surface that has another patch than in `truth`, at rest.
double other_patch_percent(const HandShape& shape, const HandShape& truth) {
  struct Facet {
    Eigen::Vector3f center;
    float area;
    uint8_t patch;
  };
  const auto facets_of = [](const HandShape& of) {
    const HandModel hand = HandModel::load(build_paths::hand_mesh(), Side::right, of);
    const PosedHand rest = hand.pose(hand.skeleton().bind_posture());
    std::vector<Facet> facets;
    for (const Triangle& triangle : hand.triangles()) {
      const auto& [a, b, c] = triangle.vertices;
      const Eigen::Vector3f &p = rest.vertices[a], &q = rest.vertices[b], &r = rest.vertices[c];
      if (triangle.patch != kCuff) facets.push_back({(p + q + r) / 3, (q - p).cross(r - p).norm(), triangle.patch});
    }
    return facets;
  };
  const std::vector<Facet> facets = facets_of(shape);
  double other = 0, all = 0;
  for (const Facet& expected : facets_of(truth)) {
    const auto nearest = std::ranges::min_element(
        facets, {}, [&](const Facet& facet) { return (facet.center - expected.center).squaredNorm(); });
    all += expected.area;
    if (nearest->patch != expected.patch) other += expected.area;
  }
  return 100 * other / all;
}

TEST(HandFitLong, finds_where_the_patches_meet) {
  HandShape truth;
  truth.patch_border_shift = 0.005;
  const double before = other_patch_percent({}, truth), after = other_patch_percent(fit_of(truth, 3).shape, truth);
  EXPECT_GT(before, 5);
  EXPECT_LT(after, 0.5 * before);
}

TEST(HandFitLong, finds_a_surface_that_no_sizes_make) {
  // A bump of 4 mm on the back of the hand.
  const HandModel plain = HandModel::load_plain(build_paths::hand_mesh(), Side::right, {});
  const PosedHand rest = plain.pose(plain.skeleton().bind_posture());
  HandShape truth;
  for (const Eigen::Vector3f& p : rest.vertices) {
    const double square = (p.head<1>().squaredNorm() + p.tail<1>().squaredNorm()) / 0.015F / 0.015F;
    truth.heights.push_back(p.y() > 0 ? 0.004 * std::exp(-square) : 0);
  }
  EXPECT_TRUE(fit_of(truth).shape.heights.empty()) << "one side alone was seen";
  const HandFit fit = fit_of(truth, 3);
  double at_the_bump = 0, elsewhere = 0, bump_count = 0, other_count = 0;
  for (size_t v = 0; v < truth.heights.size(); ++v) {
    const double height_mm = 1000 * fit.shape.heights[v];
    if (truth.heights[v] > 0.002) {
      at_the_bump += height_mm;
      ++bump_count;
    } else {
      elsewhere += std::abs(height_mm);
      ++other_count;
    }
  }
  EXPECT_NEAR(at_the_bump / bump_count, 3, 1);
  EXPECT_LT(elsewhere / other_count, 0.5);
  EXPECT_LT(fit.residual, 0.6 * fit.residual_before) << "0.51: half of the views show no bump";
}

TEST(HandFitLong, leaves_the_hand_of_the_mesh_as_it_is) {
  const HandFit fit = fit_of({}, 3);
  for (int size = 0; size < kSizeCount; ++size)
    EXPECT_NEAR(fit.shape.sizes[size], 1, 0.03) << hand_size_names()[size];
  EXPECT_NEAR(fit.shape.sizes[kScale], 1, 0.004);
  double squares = 0;
  for (const double height : fit.shape.heights) squares += height * height;
  EXPECT_LT(1000 * std::sqrt(squares / kRiggedMeshVertices), 0.3);
}

TEST(HandFitLong, says_which_sizes_it_does_not_see) {
  // Nothing of the index finger's end is seen: its sizes stay those of the mesh, and the report says so.
  const HandModel hand = HandModel::load(build_paths::hand_mesh(), Side::right, second_subject());
  std::vector<TrackedView> views = filmed(hand);
  for (TrackedView& view : views)
    std::erase_if(view.seen.points, [](const LabeledPoint& p) { return p.label == patch_labels()[kIndexDistal]; });
  const HandFit fit = fit_hand_shape(views, kKinect, {build_paths::hand_mesh(), Side::right});
  EXPECT_FALSE(fit.seen[kSegmentLengths + 5]);
  EXPECT_TRUE(fit.seen[kScale]);
  EXPECT_TRUE(fit.seen[kSegmentLengths + 6]);
  const std::string report = hand_report_markdown(fit, motion_of(views));
  EXPECT_THAT(report, HasSubstr("index_distal_length"));
  EXPECT_THAT(report, HasSubstr("patch index_distal is hardly seen"));
  EXPECT_THAT(report, Not(HasSubstr("patch middle_distal")));
}

TEST(HandViews, measure_how_a_hand_moves) {
  std::vector<TrackedView> views(40);
  for (int v = 0; v < 40; ++v) {
    views[v].timestamp_us = 100'000 * v;
    views[v].pose.posture[kIndexPipFlexion] = radians_from_degrees(v % 2 == 0 ? 10 : 80);
    views[v].pose.T_camera_hand = test_pose({0, 0, 0.7}, {0, 0, 0});
    if (v >= 20)
      views[v].pose.T_camera_hand.linear() = views[v].pose.T_camera_hand.linear() *
                                             Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  const ShownMotion motion = motion_of(views);
  EXPECT_EQ(motion.views, 40);
  EXPECT_NEAR(motion.seconds, 3.9, 1e-9);
  EXPECT_NEAR(motion.bend_deg[1], 70, 1e-9);
  EXPECT_NEAR(motion.bend_deg[2], 0, 1e-9);
  EXPECT_NEAR(motion.turn_deg, degrees_from_radians(0.5), 0.1);
  EXPECT_EQ(motion_of({}).views, 0);
}

TEST(HandViews, are_of_whole_hands) {
  const MethodInputs inputs{{},
                            synthetic_calibration(),
                            borrowed(render::test_hand()),
                            borrowed(test_database()),
                            borrowed(test_color_table())};
  TrackResult result;
  result.status = TrackStatus::tracked;
  EXPECT_TRUE(view_of(shoot(render::test_pose({0, 0, 0.6})).frame, result, inputs));
  EXPECT_FALSE(view_of(shoot(render::test_pose({0.32, 0, 0.6})).frame, result, inputs)) << "a followed part";
}

TEST(HandViews, ask_for_a_hand_that_moves_long_enough) {
  const auto refusal = [](const ShownMotion& shown) { return thrown_by([&] { require_motion(shown, "dump"); }); };
  ShownMotion motion{120, 10, 100, {50, 120, 120, 120, 120}};
  EXPECT_EQ(refusal(motion), "");
  motion.views = 12;
  EXPECT_THAT(refusal(motion), AllOf(HasSubstr("dump: tracked frames: found 12"), HasSubstr("about 10 s")));
  motion = {120, 10, 100, {5, 10, 12, 10, 9}};
  EXPECT_THAT(refusal(motion),
              AllOf(HasSubstr("movement of the fingers: found 10"), HasSubstr("opens and closes")));
  motion = {120, 10, 8, {50, 120, 120, 120, 120}};
  EXPECT_THAT(refusal(motion), AllOf(HasSubstr("turn of the hand: found 8"), HasSubstr("a hand that turns")));
}

}  // namespace
}  // namespace glovebench::calibration
