#include "core/kinect/disparity.h"

#include <array>
#include <cmath>

namespace glovebench {
namespace {

constexpr double kNumerator = 345.489;            // m; f * 75 mm baseline * 8 steps a px
constexpr double kDisparityAtInfinity = 1089.41;  // disparity at infinite depth

constexpr double kLeastInverse = (kDisparityAtInfinity - kMaxDisparity - 0.5) / kNumerator;  // 1/m

using DepthTable = std::array<float, 2048>;

constexpr DepthTable kDepths = [] {
  DepthTable depths{};
  for (int raw = 0; raw <= kMaxDisparity; ++raw)
    depths[raw] = static_cast<float>(kNumerator / (kDisparityAtInfinity - raw));
  return depths;
}();

DepthImage look_up_all(const Image<uint16_t>& raw, const DepthTable& depths) {
  DepthImage depth(raw.width(), raw.height());
  for (size_t i = 0; i < raw.size(); ++i) depth[i] = raw[i] < depths.size() ? depths[raw[i]] : 0.0f;
  return depth;
}

}  // namespace

float depth_from_disparity(uint16_t raw) { return raw < kDepths.size() ? kDepths[raw] : 0.0f; }

uint16_t disparity_from_depth(double z) {
  if (!(z > 0) || !std::isfinite(z)) return kNoDisparity;
  const double steps = kDisparityAtInfinity - kNumerator / z;
  if (!(steps > -0.5 && steps < kMaxDisparity + 0.5)) return kNoDisparity;
  const auto whole = static_cast<int>(steps);
  return static_cast<uint16_t>(steps - whole >= 0.5 ? whole + 1 : whole);  // as std::round, which is a call
}

float depth_from_disparity(uint16_t raw, const OptionalLine& line) {
  if (!line) return depth_from_disparity(raw);
  const double inverse = line->a_per_m * raw + line->b_per_m;
  return raw < kNoDisparity && inverse > kLeastInverse ? static_cast<float>(1 / inverse) : 0.0f;
}

uint16_t disparity_from_depth(double z, const OptionalLine& line) {
  if (!line) return disparity_from_depth(z);
  if (!(z > 0) || !std::isfinite(z)) return kNoDisparity;
  const double raw = std::round((1 / z - line->b_per_m) / line->a_per_m);
  const bool fits = raw >= 0 && raw < kNoDisparity && depth_from_disparity(static_cast<uint16_t>(raw), line) > 0;
  return fits ? static_cast<uint16_t>(raw) : kNoDisparity;
}

DepthImage depth_from_disparity(const Image<uint16_t>& raw) { return look_up_all(raw, kDepths); }

DepthImage depth_from_disparity(const Image<uint16_t>& raw, const OptionalLine& line, double z_max) {
  DepthTable depths = kDepths;
  for (size_t i = 0; i < depths.size(); ++i) {
    if (line) depths[i] = depth_from_disparity(static_cast<uint16_t>(i), line);
    if (depths[i] > z_max) depths[i] = 0;
  }
  return look_up_all(raw, depths);
}

DepthImage depth_of(const DeviceFrame& frame, const OptionalLine& line, double z_max) {
  if (!frame.raw_disparity.empty()) return depth_from_disparity(frame.raw_disparity, line, z_max);
  DepthImage depth = frame.depth;
  for (float& z : depth) z = double{z} <= z_max ? z : 0;
  return depth;
}

}  // namespace glovebench
