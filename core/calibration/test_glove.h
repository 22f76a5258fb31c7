#pragma once

#include "core/base/random.h"
#include "core/calibration/color_samples.h"
#include "core/calibration/color_seeds.h"
#include "core/kinect/disparity.h"
#include "render/glove_colors.h"
#include "render/lighting.h"

namespace glovebench::calibration {

struct TestScene {
  double strength = 1;
  Eigen::Array3d gain = Eigen::Array3d::Ones();  ///< of linear light
  double noise_gray = 2;
  int missing = 0;    ///< color without a stripe; 0: none
  bool glove = true;  ///< false: skin only
  bool hand = true;   ///< false: empty volume
};

inline constexpr int kTestWidth = 160, kTestHeight = 200, kStripe = 16, kTestMargin = 12;
inline constexpr int kSkinStripe = kColorCount + 1;

inline RgbdCalibration test_calibration() {
  const PinholeCamera camera{kTestWidth, kTestHeight, 570, 570, kTestWidth / 2.0, kTestHeight / 2.0};
  return {camera, camera, Eigen::Isometry3d::Identity()};
}

/// Color 1..10, kSkinStripe, or 0 for the table.
inline int stripe_at(int u, int v, const TestScene& scene) {
  const bool inside = u >= kTestMargin && u < kTestWidth - kTestMargin && v >= kTestMargin;
  const int stripe = (v - kTestMargin) / kStripe + 1;
  if (!scene.hand || !inside || stripe > kSkinStripe || stripe == scene.missing) return 0;
  return scene.glove ? stripe : kSkinStripe;
}

inline Eigen::Array3d light_at(int u, int v, const TestScene& scene) {
  const int stripe = stripe_at(u, v, scene);
  Eigen::Array3d albedo(0.42, 0.38, 0.33);
  if (stripe == kSkinStripe) albedo = {0.40, 0.23, 0.15};
  if (stripe > 0 && stripe <= kColorCount)
    albedo =
        render::glove_albedos(render::Shader::first_subject)[static_cast<size_t>(stripe)].cast<double>().array();
  return albedo * scene.gain * (scene.strength * (0.35 + 0.65 * u / kTestWidth));
}

/// A stripe's first row mixes in the stripe above.
inline DeviceFrame test_frame(const TestScene& scene, int number) {
  DeviceFrame frame{Image<uint16_t>(kTestWidth, kTestHeight), ColorImage(kTestWidth, kTestHeight)};
  RandomStream random(3, "test glove", number, "noise");
  for (int v = 0; v < kTestHeight; ++v) {
    for (int u = 0; u < kTestWidth; ++u) {
      frame.raw_disparity(u, v) = disparity_from_depth(stripe_at(u, v, scene) > 0 ? 0.7 : 1.3);
      const Eigen::Array3d light = 0.5 * (light_at(u, v, scene) + light_at(u, std::max(0, v - 1), scene));
      for (int channel = 0; channel < 3; ++channel) {
        const double coded = 255 * render::srgb_encode(std::min(1.0, light[channel]));
        frame.color(u, v)[static_cast<size_t>(channel)] =
            static_cast<uint8_t>(std::clamp(std::round(coded + scene.noise_gray * random.normal()), 0.0, 255.0));
      }
    }
  }
  return frame;
}

inline ColorSamples test_samples(const TestScene& scene, int frames = 3) {
  ColorSamples samples;
  for (int f = 0; f < frames; ++f) samples.add_frame(test_frame(scene, f), test_calibration());
  return samples;
}

inline ColorSeeds test_seeds() {
  ColorSeeds seeds;
  seeds[0] = Chroma::Zero();
  for (size_t label = 1; label <= kColorCount; ++label) {
    const Eigen::Vector3f& albedo = render::glove_albedos(render::Shader::first_subject)[label];
    Eigen::Array3d coded;
    for (int channel = 0; channel < 3; ++channel) coded[channel] = render::srgb_encode(0.5 * albedo[channel]);
    seeds[label] = chroma_of(coded);
  }
  return seeds;
}

}  // namespace glovebench::calibration
