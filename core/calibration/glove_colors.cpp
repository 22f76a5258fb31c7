#include "core/calibration/glove_colors.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/calibration/chroma.h"

namespace glovebench::calibration {
namespace {

constexpr size_t kFitSamples = 60'000;  ///< enough for ten Gaussians

/// A sample as the fit sees it.
struct ChromaSample {
  Chroma chroma;
  double noise;  ///< variance of each coordinate
};

double noise_variance(double luma, double noise_gray) {
  // Rounding adds a variance of about 0.1.
  return (noise_gray * noise_gray + 0.1) / (luma * luma);
}

std::vector<ChromaSample> fit_samples(const ColorSamples& samples, double min_luma) {
  const std::vector<ColorSample>& inside = samples.inside();
  const size_t stride = std::max<size_t>(1, inside.size() / kFitSamples);
  std::vector<ChromaSample> chosen;
  for (size_t i = 0; i < inside.size(); i += stride) {
    const Eigen::Array3d rgb = array_of(inside[i].rgb);
    const double luma = luma_of(rgb);
    if (luma >= min_luma) chosen.push_back({chroma_of(rgb), noise_variance(luma, samples.noise_gray())});
  }
  return chosen;
}

/// Density and squared Mahalanobis distance of a sample from a color.
struct Nearness {
  double density, squared_distance;
};
Nearness nearness(const GloveColor& color, const ChromaSample& sample) {
  Eigen::Matrix2d covariance = color.covariance;
  covariance.diagonal().array() += sample.noise;
  const Chroma offset = sample.chroma - color.center;
  const double determinant = covariance.determinant();
  // The inverse of a 2 x 2 matrix, written out.
  const double squared = (covariance(1, 1) * offset[0] * offset[0] - 2 * covariance(0, 1) * offset[0] * offset[1] +
                          covariance(0, 0) * offset[1] * offset[1]) /
                         determinant;
  return {std::exp(-0.5 * squared) / (2 * std::numbers::pi * std::sqrt(determinant)), squared};
}

/// The covariance with its deviations clamped along its axes.
Eigen::Matrix2d within_deviations(const Eigen::Matrix2d& covariance, double least, double most) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Vector2d variances = axes.eigenvalues().cwiseMax(least * least).cwiseMin(most * most);
  return axes.eigenvectors() * variances.asDiagonal() * axes.eigenvectors().transpose();
}

constexpr double kLeastDeviation = 0.008, kMostDeviation = 0.05, kFirstDeviation = 0.025;
constexpr double kNear = 0.05, kNearShare = 0.09;  ///< from the seed, chroma; saturated colors move farther
constexpr double kFarthest = 0.07;                 ///< of the others from where they were found
constexpr double kOtherDensity = 0.5;              ///< of other colors, uniform over a chroma area of two units
constexpr double kGate = 4.0;                      ///< deviations beyond which a sample does not count for a color

/// The ten colors from index 1 on, then the others.
using Colors = std::vector<GloveColor>;

/// How far each color may lie from its seed: not half way to another's.
std::array<double, kColorCount + 1> reaches(const ColorSeeds& seeds) {
  std::array<double, kColorCount + 1> reach{};
  for (int k = 1; k <= kColorCount; ++k) {
    reach[k] = kNear + kNearShare * seeds[k].norm();
    for (int other = 1; other <= kColorCount; ++other)
      if (other != k) reach[k] = std::min(reach[k], 0.5 * (seeds[k] - seeds[other]).norm());
  }
  return reach;
}

GloveColor first_color(const Chroma& seed, double reach) {
  GloveColor color;
  color.seed = color.center = seed;
  color.reach = reach;
  color.covariance = Eigen::Matrix2d::Identity() * (kFirstDeviation * kFirstDeviation);
  color.weight = 0.07;
  return color;
}

/// The seeds, and other frequent colors. Without its own Gaussian, skin would pull a color beside it.
Colors first_colors(const ColorSeeds& seeds, const ColorSamples& samples, double min_luma) {
  constexpr double kWidth = 0.03, kShare = 0.03;
  constexpr size_t kMost = 4;
  const std::array<double, kColorCount + 1> reach = reaches(seeds);
  Colors colors(1);
  for (int k = 1; k <= kColorCount; ++k) colors.push_back(first_color(seeds[k], reach[k]));
  const ChromaDensity density(samples.inside(), min_luma, kWidth);
  std::vector<KnownChroma> known;
  for (int k = 1; k <= kColorCount; ++k) known.push_back({seeds[k], std::max(reach[k], kFarthest)});
  for (const Chroma& peak : density.peaks(known, kFarthest, kShare, kMost))
    colors.push_back(first_color(peak, kFarthest));
  return colors;
}

/// Sums of one color over all samples, weighted by the probability of the color.
struct Sums {
  double weight = 0, precision = 0;
  Chroma chroma = Chroma::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();  ///< about the previous center, without noise
};

/// One step of expectation maximization. `is_first`: the covariances stay.
Colors improved(const Colors& colors, const std::vector<ChromaSample>& samples, bool is_first) {
  std::vector<Sums> sums(colors.size());
  std::vector<double> likely(colors.size());
  const double other_weight = 1 - std::accumulate(colors.begin() + 1, colors.end(), 0.0,
                                                  [](double sum, const GloveColor& c) { return sum + c.weight; });
  for (const ChromaSample& sample : samples) {
    double sum = std::max(other_weight, 0.02) * kOtherDensity;
    for (size_t k = 1; k < colors.size(); ++k) {
      const Nearness near = nearness(colors[k], sample);
      likely[k] = 0;
      if (near.squared_distance > kGate * kGate) continue;
      likely[k] = std::max(colors[k].weight, 0.005) * near.density;
      sum += likely[k];
    }
    // Pixels with little noise say more about the center.
    const double precision = 1 / (kFirstDeviation * kFirstDeviation / 4 + sample.noise);
    for (size_t k = 1; k < colors.size(); ++k) {
      if (likely[k] == 0) continue;
      const double share = likely[k] / sum;
      const Chroma offset = sample.chroma - colors[k].center;
      sums[k].weight += share;
      sums[k].precision += share * precision;
      sums[k].chroma += share * precision * sample.chroma;
      sums[k].squares +=
          share * precision * (offset * offset.transpose() - sample.noise * Eigen::Matrix2d::Identity());
    }
  }
  Colors next = colors;
  for (size_t k = 1; k < colors.size(); ++k) {
    next[k].weight = sums[k].weight / static_cast<double>(samples.size());
    if (sums[k].weight < 1) continue;
    next[k].center = sums[k].chroma / sums[k].precision;
    const Chroma moved = next[k].center - colors[k].seed;
    if (moved.norm() > colors[k].reach) next[k].center = colors[k].seed + moved * (colors[k].reach / moved.norm());
    if (!is_first)
      next[k].covariance = within_deviations(sums[k].squares / sums[k].precision, kLeastDeviation, kMostDeviation);
  }
  return next;
}

void count_pixels(const ColorSamples& samples, GloveColorFit& fit) {
  std::array<int, kColorCount + 1> last_frame;
  last_frame.fill(-1);
  std::array<std::vector<double>, kColorCount + 1> lumas;
  for (const ColorSample& sample : samples.inside()) {
    const uint8_t label = fit.classify(sample.rgb);
    fit.other += label == kNotGlove;
    fit.unsure += label == kUnsure;
    if (label == kNotGlove || label == kUnsure) continue;
    ++fit.glove;
    ++fit.colors[label].pixels;
    fit.colors[label].frames += sample.frame != last_frame[label];
    last_frame[label] = sample.frame;
    lumas[label].push_back(luma_of(array_of(sample.rgb)));
  }
  for (int k = 1; k <= kColorCount; ++k)
    for (size_t i = 0; i < fit.colors[k].lumas.size(); ++i)
      fit.colors[k].lumas[i] = quantile_of(lumas[k], 0.1 + 0.2 * static_cast<double>(i)).value_or(0);
  for (const ColorSample& sample : samples.beyond()) {
    const uint8_t label = fit.classify(sample.rgb);
    ++fit.beyond;
    if (label == kNotGlove || label == kUnsure) continue;
    ++fit.beyond_like_glove;
    ++fit.beyond_like[label];
  }
}

void expect_samples(const ColorSamples& samples, const std::vector<ChromaSample>& chosen, const std::string& where,
                    const GloveColorConfig& config) {
  if (samples.frames() == 0) throw Error(where, "frames", "none", "at least one");
  if (static_cast<int64_t>(chosen.size()) >= std::min<int64_t>(config.min_pixels, kFitSamples)) return;
  const WorkingVolume& volume = samples.config().volume;
  throw Error(where, "pixels in the working volume", fmt::format("{} that tell a color", chosen.size()),
              fmt::format("a gloved hand {} to {} m before the camera", volume.z_min, volume.z_max));
}

void expect_all_colors(const GloveColorFit& fit, const std::string& where) {
  std::string missing;
  int count = 0;
  for (int k = 1; k <= kColorCount; ++k) {
    if (fit.colors[k].pixels >= fit.config.min_pixels) continue;
    missing += fmt::format("{}{} ({} pixels)", count++ > 0 ? ", " : "", k, fit.colors[k].pixels);
  }
  if (count == 0) return;
  const std::string expected = fmt::format("{} pixels of each color at least", fit.config.min_pixels);
  if (count > kColorCount / 2) throw Error(where, "glove", fmt::format("no {}", missing), expected);
  throw Error(where, "colors", "no " + missing, expected + ": turn the hand so that every patch is seen");
}

}  // namespace

uint8_t GloveColorFit::classify(const Rgb& rgb) const {
  const Eigen::Array3d coded = array_of(rgb);
  const double luma = luma_of(coded);
  if (luma < config.min_luma) return kUnsure;
  const ChromaSample sample{chroma_of(coded), noise_variance(luma, noise_gray)};
  uint8_t best = 0;
  double likely = 0, nearest = std::numeric_limits<double>::infinity(), of_best = nearest;
  for (int k = 1; k <= kColorCount; ++k) {
    const Nearness near = nearness(colors[k], sample);
    nearest = std::min(nearest, near.squared_distance);
    // All colors have equal priors, however much of them was seen.
    if (best != 0 && near.density <= likely) continue;
    best = static_cast<uint8_t>(k);
    likely = near.density;
    of_best = near.squared_distance;
  }
  // Clipping hides the true color of an overexposed pixel.
  const uint8_t other_label = is_overexposed(rgb) ? kUnsure : kNotGlove;
  for (const GloveColor& bell : others)
    if (nearness(bell, sample).density > likely) return other_label;
  if (of_best <= config.glove_distance * config.glove_distance) return best;
  return nearest > config.other_distance * config.other_distance ? other_label : kUnsure;
}

GloveColorFit fit_glove_colors(const ColorSamples& samples, const ColorSeeds& seeds, const std::string& where,
                               const GloveColorConfig& config) {
  constexpr int kSteps = 25, kFirstSteps = 4;
  GloveColorFit fit;
  fit.config = config;
  fit.noise_gray = samples.noise_gray();
  const std::vector<ChromaSample> chosen = fit_samples(samples, config.min_luma);
  expect_samples(samples, chosen, where, config);
  fit.light = estimate_light(seeds, samples.inside(), config.min_luma);
  Colors colors = first_colors(relit(seeds, fit.light), samples, config.min_luma);
  for (int step = 0; step < kSteps; ++step) colors = improved(colors, chosen, step < kFirstSteps);
  std::copy_n(colors.begin(), fit.colors.size(), fit.colors.begin());
  fit.others.assign(colors.begin() + kColorCount + 1, colors.end());
  count_pixels(samples, fit);
  expect_all_colors(fit, where);
  return fit;
}

}  // namespace glovebench::calibration
