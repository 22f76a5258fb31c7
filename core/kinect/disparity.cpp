#include "core/kinect/disparity.h"

#include <array>
#include <cmath>

namespace glovebench {
namespace {

constexpr double kNumerator = 345.489;  // m; f * 75 mm baseline * 8 steps a px
constexpr double kInfinity = 1089.41;   // disparity at infinite depth

constexpr auto kDepths = [] {
  std::array<float, 2048> depths{};
  for (int raw = 0; raw <= kMaxDisparity; ++raw) depths[raw] = static_cast<float>(kNumerator / (kInfinity - raw));
  return depths;
}();

}  // namespace

float depth_from_disparity(uint16_t raw) {
  return raw < kDepths.size() ? kDepths[raw] : 0.0f;
}

uint16_t disparity_from_depth(double z) {
  if (!(z > 0) || !std::isfinite(z)) return kNoDisparity;
  const double raw = std::round(kInfinity - kNumerator / z);
  return raw >= 0 && raw <= kMaxDisparity ? static_cast<uint16_t>(raw) : kNoDisparity;
}

DepthImage depth_from_disparity(const Image<uint16_t>& raw) {
  DepthImage depth(raw.width(), raw.height());
  for (size_t i = 0; i < raw.size(); ++i) depth[i] = depth_from_disparity(raw[i]);
  return depth;
}

}  // namespace glovebench
