#include "render/rgbd_renderer.h"

#include <gtest/gtest.h>

#include <thread>

#include "render/label_renderer.h"
#include "render/noise/noise_model.h"
#include "render/test_hand.h"

namespace glovebench::render {
namespace {

std::shared_ptr<const HandModel> shared_hand() {
  return {&test_hand(), [](const HandModel*) {}};
}

double mean_red_over_blue(const ColorImage& color) {
  double red = 0;
  double blue = 0;
  for (const Rgb& rgb : color) {
    red += rgb[0];
    blue += rgb[2];
  }
  return red / blue;
}

TEST(RgbdRenderer, BothCamerasSeeTheSameVertices) {
  const RgbdCalibration calibration = synthetic_calibration();
  RgbdRenderer renderer(calibration, shared_hand(), {});
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const Eigen::Isometry3d T_camera_hand = test_pose({0.02, 0.03, 0.7}, {0.2, 0.1, 0.3});
  const RgbdImages images = renderer.render(hand, T_camera_hand, {});
  const LabelImage color_labels = renderer.render_color_labels(hand, T_camera_hand);
  int equal = 0;
  int compared = 0;
  for (const Triangle& triangle : test_hand().triangles()) {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    for (const uint32_t vertex : triangle.vertices) center += hand.vertices[vertex].cast<double>() / 3;
    const Eigen::Vector3d p_camera = T_camera_hand * center;
    const auto pixel = [](const Eigen::Vector2d& uv_px) {
      return std::pair(static_cast<int>(std::lround(uv_px.x())), static_cast<int>(std::lround(uv_px.y())));
    };
    const auto [u, v] = pixel(calibration.ir.project(p_camera));
    if (std::abs(images.depth(u, v) - p_camera.z()) > 0.001) continue;
    const auto [u_rgb, v_rgb] = pixel(calibration.rgb.project(calibration.T_rgb_ir * p_camera));
    ++compared;
    equal += images.label(u, v) == triangle.label && color_labels(u_rgb, v_rgb) == triangle.label;
  }
  EXPECT_GT(compared, 500);
  // At 0.7 m a pixel is 1.2 mm wide: centers of triangles at patch borders and at the outline fall beside them.
  EXPECT_GT(equal, 0.85 * compared);
}

TEST(RgbdRenderer, TruthEqualsTheLabelRendererWhereTheForearmHidesNothing) {
  const RgbdCalibration calibration = synthetic_calibration();
  RgbdRenderer renderer(calibration, shared_hand(), {});
  LabelRenderer label_renderer;
  const PosedHand hand = test_hand().pose(test_posture());
  const Eigen::Isometry3d T_camera_hand = test_pose({0.02, 0.03, 0.7});
  const RgbdImages images = renderer.render(hand, T_camera_hand, {});
  const HandImages alone = label_renderer.render_ids(test_hand(), hand, calibration.ir, T_camera_hand);
  EXPECT_EQ(images.label, alone.label);
  EXPECT_EQ(images.patch, alone.patch);
  for (size_t i = 0; i < images.depth.size(); ++i) {
    ASSERT_TRUE(alone.label[i] == 0 || images.depth[i] == alone.depth[i]);
  }
}

TEST(RgbdRenderer, EverythingButTheArmLiesBeyondTheWorkingVolume) {
  const Eigen::Isometry3d far_aside = test_pose({5, 0, 0.7});
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const auto nearest = [&](const SceneConfig& scene) {
    RgbdRenderer renderer(synthetic_calibration(), shared_hand(), scene);
    const DepthImage depth = renderer.render(hand, far_aside, {}).depth;
    return *std::min_element(depth.begin(), depth.end());
  };
  EXPECT_GT(nearest({}), 1.0f);
  EXPECT_NEAR(nearest({.clutter = false}), 1.06, 1e-5);
  EXPECT_NEAR(nearest({.clutter_in_volume = true}), 0.90, 1e-5);
}

TEST(RgbdRenderer, ForearmContinuesTheCuffWithoutALabel) {
  RgbdRenderer renderer(synthetic_calibration(), shared_hand(), {});
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const Eigen::Isometry3d T_camera_hand = test_pose({0, -0.05, 0.75}, {0, 0, 0});
  const RgbdImages images = renderer.render(hand, T_camera_hand, {});
  const Eigen::Isometry3d T_camera_forearm = T_camera_hand * hand.T_hand_joint[kForearmJoint];
  for (double along = 0.03; along < 0.24; along += 0.01) {
    const Eigen::Vector2d uv_px =
        synthetic_calibration().ir.project(T_camera_forearm * Eigen::Vector3d(0, 0, along));
    const int u = static_cast<int>(std::lround(uv_px.x()));
    const int v = static_cast<int>(std::lround(uv_px.y()));
    EXPECT_LT(images.depth(u, v), 0.78) << along;
    EXPECT_GT(images.depth(u, v), 0.68) << along;
    // The cuff ends 60 mm past the wrist; its front edge is seen up to 5 mm beside the axis.
    if (std::abs(along - 0.06) > 0.006) {
      EXPECT_EQ(images.label(u, v) != 0, along < 0.06) << along;
    }
  }
}

TEST(RgbdRenderer, WarmerLightMakesARedderImageAndStrongerLightABrighterOne) {
  RgbdRenderer renderer(synthetic_calibration(), shared_hand(), {});
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const Eigen::Isometry3d T_camera_hand = test_pose({0, 0, 0.7});
  double last_ratio = std::numeric_limits<double>::max();
  for (double kelvin : {3000.0, 4000.0, 5000.0, 6500.0}) {
    const double ratio = mean_red_over_blue(renderer.render(hand, T_camera_hand, {.temperature_k = kelvin}).color);
    EXPECT_LT(ratio, last_ratio);
    last_ratio = ratio;
  }
  const ColorImage dim = renderer.render(hand, T_camera_hand, {.strength = 0.5}).color;
  const ColorImage bright = renderer.render(hand, T_camera_hand, {.strength = 2.0}).color;
  for (size_t i = 0; i < dim.size(); ++i) ASSERT_GE(bright[i][1], dim[i][1]);
  int saturated = 0;
  for (const Rgb& rgb : bright) saturated += rgb[0] == 255 || rgb[1] == 255 || rgb[2] == 255;
  EXPECT_LT(saturated, 0.05 * bright.size());
}

TEST(RgbdRenderer, ReusedBackgroundEqualsAFreshOne) {
  const PosedHand hand = test_hand().pose(test_posture());
  RgbdRenderer used(synthetic_calibration(), shared_hand(), {});
  used.render(hand, test_pose({0.1, 0.1, 0.6}), {});
  used.render(hand, test_pose({-0.2, 0.1, 0.9}), {.strength = 2});
  RgbdRenderer fresh(synthetic_calibration(), shared_hand(), {});
  for (const Eigen::Vector3d& position : {Eigen::Vector3d(0, 0, 0.7), Eigen::Vector3d(-0.4, -0.2, 0.7)}) {
    const RgbdImages a = used.render(hand, test_pose(position), {});
    const RgbdImages b = fresh.render(hand, test_pose(position), {});
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.label, b.label);
  }
}

TEST(RgbdRenderer, ABareHandHasTheGlovesTruthAndOneColor) {
  const PosedHand hand = test_hand().pose(Posture::Zero());
  const auto draw = [&](Appearance appearance) {
    RgbdRenderer renderer(synthetic_calibration(), shared_hand(), {.appearance = appearance});
    return renderer.render(hand, test_pose({0, 0, 0.7}), {});
  };
  const RgbdImages glove = draw(Appearance::glove), skin = draw(Appearance::skin);
  EXPECT_EQ(skin.depth, glove.depth);
  EXPECT_EQ(skin.label, glove.label);
  EXPECT_EQ(skin.patch, glove.patch);
  int changed = 0, skin_colored = 0;
  for (size_t i = 0; i < skin.color.size(); ++i) {
    if (skin.color[i] == glove.color[i]) continue;
    ++changed;
    skin_colored += skin.color[i][0] > skin.color[i][1] && skin.color[i][1] > skin.color[i][2];
  }
  EXPECT_GT(changed, 5000);
  EXPECT_GT(skin_colored, 0.97 * changed) << "but for pixels that the hand shares with the table";
}

TEST(RgbdRenderer, TheColorCamerasTruth) {
  const RgbdCalibration calibration = synthetic_calibration();
  RgbdRenderer renderer(calibration, shared_hand(), {});
  const PosedHand hand = test_hand().pose(test_posture());
  const Eigen::Isometry3d T_camera_hand = test_pose({0.02, 0.03, 0.7});
  const TrueImages truth = renderer.render_color_truth(hand, T_camera_hand);
  EXPECT_EQ(truth.label, renderer.render_color_labels(hand, T_camera_hand));
  for (size_t i = 0; i < truth.label.size(); ++i) {
    ASSERT_EQ(truth.label[i] != 0, truth.patch[i] != 0);
    ASSERT_TRUE(truth.label[i] == 0 || truth.label[i] == truth.whole_hand[i]);
  }
  const RgbdImages ir = renderer.render(hand, T_camera_hand, {});
  int glove = 0, equal = 0;
  for (int v = 0; v < truth.label.height(); ++v) {
    for (int u = 0; u < truth.label.width(); ++u) {
      if (truth.label(u, v) == 0) continue;
      const Eigen::Vector3d p_rgb = calibration.rgb.back_project(u, v, double{truth.depth(u, v)});
      const Eigen::Vector3d p_ir = calibration.T_rgb_ir.inverse() * p_rgb;
      const Eigen::Vector2d uv_px = calibration.ir.project(p_ir);
      const float z = ir.depth(static_cast<int>(std::lround(uv_px.x())), static_cast<int>(std::lround(uv_px.y())));
      ++glove;
      equal += std::abs(double{z} - p_ir.z()) < 0.003;
    }
  }
  EXPECT_GT(glove, 5000);
  EXPECT_GT(equal, 0.9 * glove) << "but for what one camera sees behind an outline of the other";
  // From behind, the forearm hides a part of a hand that points away from the camera.
  const TrueImages away = renderer.render_color_truth(hand, test_pose({0, 0, 0.7}, {-1.4, 0, 0}));
  const auto count = [](const LabelImage& labels) {
    return static_cast<int>(labels.size()) - std::ranges::count(labels, uint8_t{0});
  };
  EXPECT_LT(count(away.label), count(away.whole_hand));
}

TEST(RgbdRenderer, ThreadsDrawBitForBitAsOne) {
  const PosedHand hand = test_hand().pose(test_posture());
  const auto draw = [&](int first, int step, std::vector<RgbdImages>* frames) {
    RgbdRenderer renderer(synthetic_calibration(), shared_hand(), {.shader = Shader::second_subject});
    for (size_t i = first; i < frames->size(); i += step) {
      (*frames)[i] = renderer.render(hand, test_pose({0.03 * static_cast<double>(i), 0, 0.7}), {});
    }
  };
  std::vector<RgbdImages> serial(4);
  draw(0, 1, &serial);
  std::vector<RgbdImages> parallel(4);
  std::thread even(draw, 0, 2, &parallel);
  std::thread odd(draw, 1, 2, &parallel);
  even.join();
  odd.join();
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(parallel[i].color, serial[i].color);
    EXPECT_EQ(parallel[i].depth, serial[i].depth);
    EXPECT_EQ(parallel[i].patch, serial[i].patch);
  }
}

}  // namespace
}  // namespace glovebench::render
