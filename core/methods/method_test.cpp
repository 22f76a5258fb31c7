#include "core/methods/method.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/tracker/test_scene.h"
#include "core/tracker/track_result.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::unique_ptr<Method> make(std::string_view name, TrackerConfig config = {}) {
  config.method = name;
  return find_method(name).make({config, synthetic_calibration(), borrowed(render::test_hand()),
                                 borrowed(test_database()), borrowed(test_color_table())});
}

/// The back of the hand, turned a little, so that no two axes are alike.
Eigen::Isometry3d pose_before_camera(double x, double z) { return render::test_pose({x, 0.01, z}); }

TEST(Methods, are_named_after_their_files) {
  ASSERT_EQ(methods().size(), method_names().size());
  for (size_t i = 0; i < methods().size(); ++i) {
    EXPECT_EQ(methods()[i].name, method_names()[i]);
    EXPECT_EQ(find_method(methods()[i].name).make, methods()[i].make);
    EXPECT_NE(methods()[i].description, "");
  }
  EXPECT_EQ(TrackerConfig{}.method, kPaperMethod);
  EXPECT_THAT([] { find_method("best"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("best"), HasSubstr("schroeder2012"), HasSubstr("monocular"))));
}

TEST(Methods, the_papers_is_the_tracker) {
  const Shot shot = shoot(pose_before_camera(0.02, 0.65));
  std::vector<Stage> stages_of_method, stages_of_tracker;
  const TrackResult a = make(kPaperMethod)->track(shot.frame, {}, [&](Stage s) { stages_of_method.push_back(s); });
  const TrackResult b = make_tracker().track(shot.frame, {}, [&](Stage s) { stages_of_tracker.push_back(s); });
  EXPECT_EQ(a.status, TrackStatus::tracked);
  EXPECT_EQ(estimate_line(0, a), estimate_line(0, b));
  EXPECT_EQ(stages_of_method, stages_of_tracker);
}

TEST(Methods, refuse_a_table_over_another_color_space) {
  TrackerConfig config;
  config.segmentation.color_space = ColorSpace::rgb;
  for (const std::string_view name : method_names()) {
    EXPECT_THAT([&] { make(name, config); },
                ThrowsMessage<Error>(AllOf(HasSubstr("color space"), HasSubstr("found yuv"), HasSubstr("rgb"))))
        << name;
  }
}

TEST(Monocular, finds_the_hand_without_depth) {
  for (const double z : {0.55, 0.65, 0.8}) {
    const Eigen::Isometry3d truth = pose_before_camera(0.03, z);
    const TrackResult result = make("monocular_bbox")->track(shoot(truth).frame);
    ASSERT_EQ(result.status, TrackStatus::tracked) << z;
    EXPECT_TRUE(result.converged);
    const PoseError error = error_of(result.T_camera_hand, truth);
    // Measured: 10 to 12 mm, 7 to 8 degrees. The other camera's frame would be another 24 mm away.
    EXPECT_LT(error.mm, 20) << z;
    EXPECT_LT(error.deg, 15) << z;
  }
}

TEST(Monocular, does_not_look_at_the_depth) {
  const Shot shot = shoot(pose_before_camera(0.02, 0.65), power_posture());
  const auto with_depth = make("monocular_bbox"), with_noise = make("monocular_bbox"),
             without = make("monocular_bbox");
  const TrackResult expected = with_depth->track(shot.frame);
  ASSERT_EQ(expected.status, TrackStatus::tracked);
  DeviceFrame frame = shot.frame;
  RandomStream random(1, "monocular", 0, "disparity");
  for (uint16_t& raw : frame.raw_disparity) raw = static_cast<uint16_t>(random.index(2048));
  const TrackResult result = with_noise->track(frame);
  EXPECT_EQ(estimate_line(0, result), estimate_line(0, expected));
  EXPECT_EQ(result.T_camera_hand.matrix(), expected.T_camera_hand.matrix());
  frame.raw_disparity = {};
  EXPECT_EQ(estimate_line(0, without->track(frame)), estimate_line(0, expected));
}

TEST(Monocular, says_why_there_is_no_hand) {
  DeviceFrame empty;
  empty.color = ColorImage(640, 480);
  EXPECT_EQ(make("monocular_bbox")->track(empty).status, TrackStatus::no_hand);

  const DeviceFrame cut = shoot(pose_before_camera(0.36, 0.6)).frame;
  EXPECT_EQ(make("monocular_bbox")->track(cut).status, TrackStatus::cut_by_border);

  TrackerConfig strict;
  strict.lookup.max_matching_error = 1e-6;
  const DeviceFrame whole = shoot(pose_before_camera(0.0, 0.65)).frame;
  EXPECT_EQ(make("monocular_bbox", strict)->track(whole).status, TrackStatus::poor_match);
}

TEST(Monocular, takes_the_largest_of_several_blobs) {
  const Shot shot = shoot(pose_before_camera(0.0, 0.65));
  // A stain of a glove color in the corner, as large as the corner allows without touching the hand.
  DeviceFrame stained = shot.frame;
  Rgb glove{};
  for (size_t i = 0; i < shot.rgb_labels.size(); ++i)
    if (shot.rgb_labels[i] != 0 && test_color_table().label(shot.frame.color[i]) != 0) glove = shot.frame.color[i];
  for (int v = 10; v < 30; ++v)
    for (int u = 10; u < 30; ++u) stained.color(u, v) = glove;
  EXPECT_EQ(estimate_line(0, make("monocular_bbox")->track(stained)),
            estimate_line(0, make("monocular_bbox")->track(shot.frame)));
}

TEST(Monocular, smooths_the_posture_like_the_tracker) {
  const auto method = make("monocular_bbox");
  const TrackResult open = method->track(shoot(pose_before_camera(0.0, 0.65)).frame);
  const TrackResult power = method->track(shoot(pose_before_camera(0.0, 0.65), power_posture()).frame, {&open, 1});
  ASSERT_EQ(power.status, TrackStatus::tracked);
  const Posture expected = 0.75 * open.posture + 0.25 * power.posture_unfiltered;
  EXPECT_LT((power.posture - expected).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace glovebench
