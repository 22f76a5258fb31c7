#include "render/lighting.h"

#include <gtest/gtest.h>

#include "render/glove_colors.h"
#include "render/scene.h"

namespace glovebench::render {
namespace {

TEST(Lighting, WarmLightIsRedderMonotonically) {
  double last_ratio = std::numeric_limits<double>::max();
  for (double kelvin = 2500; kelvin <= 9000; kelvin += 100) {
    const Eigen::Vector3d rgb = rgb_of_temperature(kelvin);
    const double ratio = rgb.x() / rgb.z();
    EXPECT_LT(ratio, last_ratio) << kelvin;
    last_ratio = ratio;
    EXPECT_NEAR(rgb.dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722)), 1.0, 1e-12);
  }
}

TEST(Lighting, WhiteBalanceStaysAt5000K) {
  EXPECT_TRUE(rgb_of_temperature(5000).isApprox(Eigen::Vector3d::Ones(), 1e-12));
  // Kim's spline at 6500 K is (0.3136, 0.3237); with D50-like 5000 K (0.3450, 0.3516) this is a blue surplus.
  EXPECT_GT(rgb_of_temperature(6500).z(), 1.2);
  EXPECT_LT(rgb_of_temperature(3000).z(), 0.5);
}

TEST(Lighting, NamesItsProblems) {
  EXPECT_TRUE(Lighting{}.problems().empty());
  const Lighting bad{.direction_to_light = {0, 0, 0}, .strength = 0, .temperature_k = 100, .ambient_share = 2};
  EXPECT_EQ(bad.problems().size(), 4u);
  EXPECT_EQ(Lighting{.strength = std::nan("")}.problems().size(), 1u);
}

/// Luma of the gamma-coded color (0..255) and its chroma (U, V over Y).
struct Coded {
  double luma;
  Eigen::Vector2d chroma;
};
Coded coded(const Eigen::Vector3d& linear) {
  const Eigen::Vector3d rgb = 255 * linear.unaryExpr(&srgb_encode);
  const double y = rgb.dot(Eigen::Vector3d(0.299, 0.587, 0.114));
  return {y, Eigen::Vector2d(0.564 * (rgb.z() - y), 0.713 * (rgb.x() - y)) / y};
}

TEST(GloveColors, StayApartUnderEveryLight) {
  const Scene scene = make_scene({});
  std::vector<Eigen::Vector3d> albedos;
  for (int m = 1; m <= kFloor; ++m) albedos.push_back(scene.materials[m].albedo.cast<double>());
  double smallest_levels = 1e9;
  double smallest_chroma = 1e9;
  double smallest_at_5000 = 1e9;
  for (size_t a = 0; a < kColorCount; ++a) {
    for (size_t b = a + 1; b < albedos.size(); ++b) {
      for (double light_a : {3000.0, 4000.0, 5000.0, 6500.0}) {
        for (double light_b : {3000.0, 4000.0, 5000.0, 6500.0}) {
          const Coded one = coded(albedos[a].cwiseProduct(rgb_of_temperature(light_a)));
          const Coded other = coded(albedos[b].cwiseProduct(rgb_of_temperature(light_b)));
          const double distance = (one.chroma - other.chroma).norm();
          smallest_levels = std::min(smallest_levels, distance * std::max(one.luma, other.luma));
          smallest_chroma = std::min(smallest_chroma, distance);
          if (light_a == 5000 && light_b == 5000) smallest_at_5000 = std::min(smallest_at_5000, distance);
        }
      }
    }
  }
  // What the search reached without gloss, less the last digit; see glove_colors.h.
  EXPECT_GT(smallest_levels, 20.5);
  EXPECT_GT(smallest_chroma, 0.105);
  EXPECT_GT(smallest_at_5000, 0.185);
}

TEST(GloveColors, ChromaDependsLittleOnStrength) {
  for (int label = 1; label <= kColorCount; ++label) {
    const Eigen::Vector3d albedo = glove_albedos(Shader::first_subject)[label].cast<double>();
    const Coded one = coded(albedo);
    const Coded half = coded(0.5 * albedo);
    // sRGB is a power law but for a straight piece near black: less than half the smallest distance of two colors.
    EXPECT_LT((one.chroma - half.chroma).norm() * half.luma, 20.6 / 2) << label;
    EXPECT_LE(albedo.maxCoeff(), 0.5);
  }
}

TEST(GloveColors, SecondSubjectsDyesDifferByAFewPercent) {
  double largest = 0;
  for (int label = 1; label <= kColorCount; ++label) {
    const Eigen::Array3f ratio =
        glove_albedos(Shader::second_subject)[label].array() / glove_albedos(Shader::first_subject)[label].array();
    largest = std::max(largest, static_cast<double>((ratio - 1).abs().maxCoeff()));
  }
  EXPECT_GT(largest, 0.02);
  EXPECT_LT(largest, 0.05);
}

}  // namespace
}  // namespace glovebench::render
