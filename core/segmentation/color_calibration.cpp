#include "core/segmentation/color_calibration.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kSide = 1 << ColorTable::kBits;
constexpr int kCellWidth = 256 / kSide;
constexpr double kGamma = 2.2;
constexpr double kClipped = 251.0;  // a channel from here on may have been cut off

/// Change of log gamma-coded R, G, B per mired of warmer light: black bodies of 6500 K (154 mired, white) and
/// 3000 K (333 mired, which shows as 255, 180, 107).
const Eigen::Array3d kLogGainPerMired{0.0, -0.00194, -0.00485};

using Density = std::vector<float>;

Eigen::Array3d rgb_of_cell(size_t cell, ColorSpace space) {
  const auto center = [](size_t index) { return kCellWidth * (static_cast<double>(index) + 0.5) - 0.5; };
  const double first = center(cell / (kSide * kSide));
  const double second = center(cell / kSide % kSide);
  const double third = center(cell % kSide);
  if (space == ColorSpace::rgb) return {first, second, third};
  const double y = first, u = second - 128, v = third - 128;
  return {y + 1.402 * v, y - 0.344136 * u - 0.714136 * v, y + 1.772 * u};
}

/// All gains on R, G, B by which a seen color is relit; the identity first.
std::vector<Eigen::Array3d> relighting_gains(const ColorModel& model) {
  constexpr int kStrengths = 16;    // each way; steps of a few percent are under a cell
  constexpr int kTemperatures = 2;  // each way
  std::vector<Eigen::Array3d> gains = {Eigen::Array3d::Ones()};
  for (int t = -kTemperatures; t <= kTemperatures; ++t) {
    const Eigen::Array3d tint = (kLogGainPerMired * (model.temperature_shift_mired * t / kTemperatures)).exp();
    for (int s = -kStrengths; s <= kStrengths; ++s) {
      if (t == 0 && s == 0) continue;
      gains.push_back(tint * std::pow(model.strength_factor, s / (kGamma * kStrengths)));
    }
  }
  return gains;
}

/// Mean over three cells with weights 1, 2, 1 along one axis: camera noise and the width of the cells.
Density blur(const Density& density, size_t step) {
  Density blurred(density.size());
  for (size_t i = 0; i < density.size(); ++i) {
    const size_t index = i / step % kSide;
    const float before = index > 0 ? density[i - step] : 0.0f;
    const float after = index + 1 < kSide ? density[i + step] : 0.0f;
    blurred[i] = 0.25f * before + 0.5f * density[i] + 0.25f * after;
  }
  return blurred;
}

/// Mean over groups of `pooled` cells along each axis, in each cell of the group.
Density pool(const Density& density, const std::array<int, 3>& pooled) {
  const auto group_of = [&](size_t cell) {
    const auto first = [](size_t index, int width) { return index - index % static_cast<size_t>(width); };
    return (first(cell / (kSide * kSide), pooled[0]) * kSide + first(cell / kSide % kSide, pooled[1])) * kSide +
           first(cell % kSide, pooled[2]);
  };
  Density sums(density.size()), means(density.size());
  for (size_t cell = 0; cell < density.size(); ++cell) sums[group_of(cell)] += density[cell];
  const auto count = static_cast<float>(pooled[0] * pooled[1] * pooled[2]);
  for (size_t cell = 0; cell < density.size(); ++cell) means[cell] = sums[group_of(cell)] / count;
  return means;
}

/// Scaled to a sum of 1; all zero if there is nothing.
Density normalize(Density density) {
  const double sum = std::accumulate(density.begin(), density.end(), 0.0);
  if (sum > 0)
    for (float& value : density) value = static_cast<float>(value / sum);
  return density;
}

/// Zero outside the densest cells that together hold `share` of a normalized density.
Density keep_densest(Density density, double share) {
  Density sorted = density;
  std::erase(sorted, 0.0f);
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  double held = 0;
  float least = 0;
  for (size_t i = 0; i < sorted.size() && held < share; ++i) {
    least = sorted[i];
    held += sorted[i];
  }
  for (float& value : density)
    if (value < least) value = 0;
  return density;
}

using Counts = std::vector<std::array<uint32_t, kColorCount + 1>>;

/// Where the pixels of one label fall, as seen and relit, as a density over the cells.
Density relit_density(const Counts& counts, ColorSpace space, int label, const std::vector<Eigen::Array3d>& gains,
                      const ColorModel& model) {
  Density density(ColorTable::kCells);
  for (size_t cell = 0; cell < counts.size(); ++cell) {
    const float count = static_cast<float>(counts[cell][label]);
    if (count == 0) continue;
    const Eigen::Array3d rgb = rgb_of_cell(cell, space);
    if (rgb.matrix().dot(Eigen::Vector3d(0.299, 0.587, 0.114)) < model.min_luma) continue;
    const bool clipped = rgb.maxCoeff() >= kClipped;  // its true color is unknown: it stays as it is
    for (const Eigen::Array3d& gain : std::span(gains).first(clipped ? 1 : gains.size())) {
      const Eigen::Array3d relit = (rgb * gain).max(0.0).min(255.0).round();
      const Rgb relit_rgb = {static_cast<uint8_t>(relit[0]), static_cast<uint8_t>(relit[1]),
                             static_cast<uint8_t>(relit[2])};
      if (yuv_from_rgb(relit_rgb)[0] < model.min_luma) continue;
      density[ColorTable::cell_of_rgb(relit_rgb, space)] += clipped ? count * gains.size() : count;
    }
  }
  for (size_t step : {size_t{1}, size_t{kSide}, size_t{kSide * kSide}}) density = blur(density, step);
  return normalize(pool(density, model.pooled));
}

}  // namespace

void ColorCalibration::add_view(const ColorImage& color, const LabelImage& labels) {
  check(color.width() == labels.width() && color.height() == labels.height(),
        "color and labels are images of one camera");
  const auto is_inside = [&](int u, int v) {
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du)
        if (labels.contains(u + du, v + dv) && labels(u + du, v + dv) != labels(u, v)) return false;
    return true;
  };
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u)
      if (is_inside(u, v)) add_pixel(color(u, v), labels(u, v));
}

void ColorCalibration::add_pixel(const Rgb& color, uint8_t label) {
  check(label <= kColorCount, "a pixel has a label of the glove, or none");
  ++counts_[ColorTable::cell_of_rgb(color, space_)][label];
}

ColorTable ColorCalibration::build(const ColorModel& model) const {
  for (const int width : model.pooled)
    check(width >= 1 && kSide % width == 0, "pooled cells divide those of a channel");
  const std::vector<Eigen::Array3d> gains = relighting_gains(model);
  const Density not_glove = relit_density(counts_, space_, 0, gains, model);
  std::array<Density, kColorCount + 1> colors;
  for (int label = 1; label <= kColorCount; ++label) {
    colors[label] = relit_density(counts_, space_, label, gains, model);
    if (std::all_of(colors[label].begin(), colors[label].end(), [](float d) { return d == 0; }))
      throw Error("color calibration", "color " + std::to_string(label), "no bright pixel", "at least one");
    colors[label] = keep_densest(std::move(colors[label]), model.kept_share);
  }

  const double color_prior = (1 - model.not_glove_prior) / kColorCount;
  std::vector<uint8_t> labels(ColorTable::kCells, 0);
  for (size_t cell = 0; cell < labels.size(); ++cell) {
    int best = 1;
    double sum = 0;
    for (int label = 1; label <= kColorCount; ++label) {
      sum += colors[label][cell];
      if (colors[label][cell] > colors[best][cell]) best = label;
    }
    const double evidence = color_prior * sum + model.not_glove_prior * not_glove[cell];
    const double posterior = color_prior * colors[best][cell];
    if (posterior > 0 && posterior >= model.min_posterior * evidence) labels[cell] = static_cast<uint8_t>(best);
  }
  return ColorTable(std::move(labels), space_);
}

}  // namespace glovebench
