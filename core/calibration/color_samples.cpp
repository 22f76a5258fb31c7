#include "core/calibration/color_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/math.h"
#include "core/calibration/chroma.h"
#include "core/kinect/disparity.h"

namespace glovebench::calibration {
namespace {

/// Where a pixel lies.
enum Place : uint8_t { kNowhere, kInside, kBeyond };

struct PlacedColors {
  DepthImage depth;
  ColorImage color;
  Image<uint8_t> place;
};

PlacedColors place_colors(const DeviceFrame& frame, const RgbdCalibration& calibration,
                          const SampleConfig& config) {
  PlacedColors placed{depth_of(frame, calibration.disparity), {}, {}};
  RegisteredImage mapped = register_color(placed.depth, frame.color, calibration, config.registration);
  placed.place = Image<uint8_t>(placed.depth.width(), placed.depth.height(), kNowhere);
  for (size_t i = 0; i < placed.depth.size(); ++i) {
    const double z = placed.depth[i];
    if (mapped.has_color[i] == 0) continue;
    if (z >= config.volume.z_min && z <= config.volume.z_max) placed.place[i] = kInside;
    if (z > config.volume.z_max + kCutOffMargin) placed.place[i] = kBeyond;
  }
  placed.color = std::move(mapped.color);
  return placed;
}

/// The standard deviation of the green channel, by second differences along rows, which cancel shade. Empty for too
/// few pixels.
std::optional<double> noise_of(const PlacedColors& placed) {
  constexpr size_t kFewest = 100;
  std::vector<double> bends;
  for (int v = 0; v < placed.color.height(); ++v) {
    for (int u = 1; u + 1 < placed.color.width(); ++u) {
      if (placed.place(u - 1, v) != kInside || placed.place(u, v) != kInside || placed.place(u + 1, v) != kInside)
        continue;
      bends.push_back(
          std::abs(placed.color(u - 1, v)[1] - 2.0 * placed.color(u, v)[1] + placed.color(u + 1, v)[1]));
    }
  }
  if (bends.size() < kFewest) return {};
  // Half of a bell lies within 0.6745 deviations; the weights 1, -2, 1 make the deviation sqrt(6) as large.
  return *quantile_of(std::move(bends), 0.5) / (0.6745 * std::sqrt(6.0));
}

/// Do two pixels differ by no more than noise and a little shade can make them?
bool look_alike(const Rgb& a, const Rgb& b, double noise_gray) {
  const Eigen::Array3d first = array_of(a), second = array_of(b);
  const double sum = std::min(first.sum(), second.sum());
  if (sum <= 0) return false;
  // The noise of a share is that of a channel divided by the sum; two pixels add the root of two.
  const double limit = 0.012 + 4 * std::sqrt(2.0) * noise_gray / sum;
  return (first / first.sum() - second / second.sum()).abs().maxCoeff() < limit;
}

bool is_even(const PlacedColors& placed, int u, int v, double surface_step, double noise_gray) {
  constexpr std::array<std::array<int, 2>, 4> kNeighbors = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (const auto& [du, dv] : kNeighbors) {
    const int nu = u + du, nv = v + dv;
    if (!placed.place.contains(nu, nv) || placed.place(nu, nv) != placed.place(u, v)) return false;
    if (std::abs(placed.depth(nu, nv) - placed.depth(u, v)) > surface_step) return false;
    if (!look_alike(placed.color(u, v), placed.color(nu, nv), noise_gray)) return false;
  }
  return true;
}

/// 1 where a pixel is even.
Image<uint8_t> even_pixels(const PlacedColors& placed, double surface_step, double noise_gray) {
  Image<uint8_t> even(placed.color.width(), placed.color.height());
  for (int v = 0; v < even.height(); ++v)
    for (int u = 0; u < even.width(); ++u)
      even(u, v) = placed.place(u, v) != kNowhere && is_even(placed, u, v, surface_step, noise_gray);
  return even;
}

/// Distance of two colors without brightness, as shares of the sum.
double difference(const Rgb& a, const Rgb& b) {
  const Eigen::Array3d first = array_of(a) + 1, second = array_of(b) + 1;
  return (first / first.sum() - second / second.sum()).matrix().norm();
}

/// The two even colors around the uneven pixel (u, v). Empty if there is only one.
std::optional<MixedSample> mixed_at(const PlacedColors& placed, const Image<uint8_t>& even, int u, int v) {
  constexpr int kReach = 3;
  constexpr double kDifferent = 0.04;  // of shares: the glove's colors are farther apart
  int nearest = std::numeric_limits<int>::max();
  MixedSample mixed{placed.color(u, v)};
  for (int j = v - kReach; j <= v + kReach; ++j)
    for (int i = u - kReach; i <= u + kReach; ++i) {
      if (!even.contains(i, j) || even(i, j) == 0 || placed.place(i, j) != kInside) continue;
      const int squared = (i - u) * (i - u) + (j - v) * (j - v);
      if (squared >= nearest) continue;
      nearest = squared;
      mixed.near = placed.color(i, j);
    }
  double most = kDifferent;
  for (int j = v - kReach; j <= v + kReach; ++j)
    for (int i = u - kReach; i <= u + kReach; ++i) {
      if (!even.contains(i, j) || even(i, j) == 0) continue;
      const double different = difference(mixed.near, placed.color(i, j));
      if (different <= most) continue;
      most = different;
      mixed.other = placed.color(i, j);
      mixed.other_is_inside = placed.place(i, j) == kInside;
    }
  if (nearest == std::numeric_limits<int>::max() || most == kDifferent) return {};
  return mixed;
}

}  // namespace

VolumeView view_volume(const DeviceFrame& frame, const RgbdCalibration& calibration, const SampleConfig& config) {
  PlacedColors placed = place_colors(frame, calibration, config);
  for (uint8_t& place : placed.place) place = place == kInside;
  return {std::move(placed.color), std::move(placed.place)};
}

void ColorSamples::add_frame(const DeviceFrame& frame, const RgbdCalibration& calibration) {
  const PlacedColors placed = place_colors(frame, calibration, config_);
  const auto number = static_cast<uint16_t>(std::min<int>(frames_, std::numeric_limits<uint16_t>::max()));
  ++frames_;
  const std::optional<double> noise = noise_of(placed);
  if (noise) noise_.push_back(*noise);
  const Image<uint8_t> even = even_pixels(placed, config_.surface_step, noise.value_or(0));
  for (int v = 0; v < placed.color.height(); ++v) {
    for (int u = 0; u < placed.color.width(); ++u) {
      const uint8_t place = placed.place(u, v);
      inside_pixels_ += place == kInside;
      if (place == kInside && even(u, v) != 0) inside_.push_back({placed.color(u, v), number});
      if (place == kBeyond && even(u, v) != 0 && beyond_pixels_++ % config_.beyond_stride == 0)
        beyond_.push_back({placed.color(u, v), number});
      if (place != kInside || even(u, v) != 0) continue;
      if (const std::optional<MixedSample> mixed = mixed_at(placed, even, u, v)) mixed_.push_back(*mixed);
    }
  }
}

double ColorSamples::noise_gray() const { return quantile_of(noise_, 0.5).value_or(0); }

}  // namespace glovebench::calibration
