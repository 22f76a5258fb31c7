#include "render/noise/noise_model.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/base/registry.h"
#include "render/noise/depth_gradient.h"

namespace glovebench::render {
namespace {

const PinholeCamera kCamera{640, 480, 575.816, 575.816, 319.5, 239.5};
const FrameKey kKey{7, "test", 3};

/// z of the plane z = z0 + slope * x at every pixel.
DepthImage slanted_plane(double z0, double slope) {
  DepthImage depth(kCamera.width, kCamera.height);
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u)
      depth(u, v) = static_cast<float>(z0 / (1 - slope * (u - kCamera.cx) / kCamera.fx));
  return depth;
}

/// Standard deviation of noisy - clean over the columns around the center.
double noise_sigma(const DepthImage& noisy, const DepthImage& clean, int half_width) {
  double sum = 0;
  int count = 0;
  for (int v = 0; v < clean.height(); ++v) {
    for (int u = 320 - half_width; u < 320 + half_width; ++u) {
      sum += std::pow(noisy(u, v) - clean(u, v), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(Noise, FortyFiveDegreesAtSeventyCentimetresHave1_4mm) {
  const DepthImage clean = slanted_plane(0.7, 1.0);
  NoiseConfig config;
  // 480 * 20 samples: the standard error of sigma is sigma / sqrt(2 n) = 0.010 mm, allowed 4 times; z changes
  // by 1.7% over the columns, and the variance with its square, symmetrically.
  EXPECT_NEAR(noise_sigma(add_depth_noise(clean, kCamera, config, kKey), clean, 10), 1.4e-3, 0.04e-3);
  config.gain_factor = 2;
  EXPECT_NEAR(noise_sigma(add_depth_noise(clean, kCamera, config, kKey), clean, 10), 1.4e-3 * std::sqrt(2.0),
              0.06e-3);
  config.gain_factor = 0.5;
  EXPECT_NEAR(noise_sigma(add_depth_noise(clean, kCamera, config, kKey), clean, 10), 1.4e-3 * std::sqrt(0.5),
              0.03e-3);
}

TEST(Noise, GradientIsByCentralDifferences) {
  DepthImage depth(5, 3, 1.0f);
  depth(3, 1) = 1.3f;
  depth(1, 1) = 0.0f;
  const auto gradient = [&](int u, int v) { return gradient_magnitude(depth, u, v); };
  EXPECT_FLOAT_EQ(gradient(2, 1), 0.3f);  // its left neighbor has no value: one-sided
  EXPECT_FLOAT_EQ(gradient(3, 0), 0.3f);  // at the image border: one-sided
  EXPECT_FLOAT_EQ(gradient(4, 1), 0.3f);  // at the image border
  EXPECT_FLOAT_EQ(gradient(3, 1), 0.0f);  // the peak itself: central
  EXPECT_FLOAT_EQ(gradient(0, 0), 0.0f);
}

TEST(Noise, FlatSurfacesAndHolesStayAsTheyAre) {
  DepthImage depth(64, 48, 0.8f);
  for (int v = 0; v < 48; ++v) depth(20, v) = 0.0f;
  EXPECT_EQ(add_depth_noise(depth, kCamera, NoiseConfig{}, kKey), depth);
  DepthImage slope = slanted_plane(0.7, 0.5);
  slope(20, 30) = 0;
  EXPECT_EQ(add_depth_noise(slope, kCamera, NoiseConfig{}, kKey)(20, 30), 0);
}

TEST(Noise, DependsOnTheKeyAloneNotOnOrder) {
  const DepthImage clean = slanted_plane(0.7, 0.5);
  for (const char* model : {"gradient", "kinect"}) {
    NoiseConfig config;
    config.depth = model;
    const DepthImage first = add_depth_noise(clean, kCamera, config, kKey);
    const DepthImage other_frame = add_depth_noise(clean, kCamera, config, {7, "test", 4});
    const DepthImage other_seed = add_depth_noise(clean, kCamera, config, {8, "test", 3});
    EXPECT_EQ(add_depth_noise(clean, kCamera, config, kKey), first);
    EXPECT_NE(first, other_frame);
    EXPECT_NE(first, other_seed);
  }
}

TEST(Noise, KinectDisparityNoiseIsHalfAStepWithRounding) {
  const DepthImage clean(640, 480, 0.8f);
  NoiseConfig config;
  config.depth = "kinect";
  config.kinect.projector_baseline = 0;
  const DepthImage noisy = add_depth_noise(clean, kCamera, config, kKey);
  // 0.40 steps of z^2 / 345.489 m; 307,200 samples, so that 1% is eight standard errors.
  const double expected = 0.40 * 0.8 * 0.8 / 345.489;
  EXPECT_NEAR(noise_sigma(noisy, clean, 320), expected, 0.01 * expected);
}

TEST(Noise, KinectShadowLiesToTheLeftOfTheNearSurface) {
  DepthImage depth(640, 480, 1.0f);
  for (int v = 100; v < 200; ++v)
    for (int u = 300; u < 340; ++u) depth(u, v) = 0.6f;
  NoiseConfig config;
  config.depth = "kinect";
  config.kinect.lateral_sigma_px = 0;
  const DepthImage noisy = add_depth_noise(depth, kCamera, config, kKey);
  // f b (1 / 0.6 - 1 / 1.0) = 28.8 px of the far surface are hidden from the projector.
  int missing = 0;
  for (int u = 0; u < 640; ++u) missing += noisy(u, 150) == 0;
  EXPECT_NEAR(missing, 28.8, 1.0);
  EXPECT_EQ(noisy(290, 150), 0.0f);
  EXPECT_GT(noisy(350, 150), 0.0f);
  EXPECT_GT(noisy(320, 150), 0.0f);
}

TEST(Noise, KinectDropsGrazingAndNearSurfaces) {
  NoiseConfig config;
  config.depth = "kinect";
  config.kinect.projector_baseline = 0;
  const auto missing_share = [&](double z0, double slope_deg) {
    const DepthImage clean = slanted_plane(z0, std::tan(slope_deg * std::numbers::pi / 180));
    const DepthImage noisy = add_depth_noise(clean, kCamera, config, kKey);
    int missing = 0;
    for (int v = 0; v < 480; ++v) missing += noisy(319, v) == 0;
    return missing / 480.0;
  };
  EXPECT_EQ(missing_share(0.8, 45), 0.0);
  // Halfway between 70 and 85 degrees half of the values are lost; four standard errors of 480 draws are 9%.
  EXPECT_NEAR(missing_share(0.8, 77.5), 0.5, 0.1);
  EXPECT_EQ(missing_share(0.8, 86), 1.0);
  EXPECT_EQ(missing_share(0.4, 0), 1.0);
}

TEST(Noise, NamesAndProblems) {
  EXPECT_THAT(names_in(depth_noises()), testing::IsSupersetOf({"gradient", "kinect", "none"}));
  for (const DepthNoise& noise : depth_noises()) EXPECT_EQ(&find_depth_noise(noise.name), &noise);
  EXPECT_THROW(find_depth_noise("gaussian"), Error);
  EXPECT_TRUE(NoiseConfig{}.problems().empty());
  NoiseConfig bad;
  bad.gain_factor = -1;
  bad.kinect.grazing_to_deg = 60;
  EXPECT_EQ(bad.problems().size(), 2u);
}

}  // namespace
}  // namespace glovebench::render
