#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/image.h"

/// The camera of test_camera_driver.cpp. Words may follow its name, "test_camera".
namespace glovebench::test_camera {

inline constexpr std::string_view kName = "test_camera", kMirrored = "mirrored", kFine = "100um", kYuv = "yuv",
                                  kDepthOnly = "depth_only";
inline constexpr int kDepthWidth = 320, kDepthHeight = 240, kColorWidth = 640, kColorHeight = 480;
inline constexpr int kFrames = 6;  ///< of each kind
inline constexpr int64_t kDepthPeriod_us = 33'000, kColorPeriod_us = 41'000;
inline constexpr float kHorizontalFov = 1.0, kVerticalFov = 0.75;  ///< rad, of the color camera
inline constexpr int kShow = 1;  ///< command to show an image; its int argument is the number

inline uint16_t depth_step(int u, int v, int frame) {
  return static_cast<uint16_t>(u % 16 == 0 ? 0 : 400 + 3 * u + v + 10 * frame);
}
inline Rgb color(int u, int v, int frame) {
  return {static_cast<uint8_t>(u), static_cast<uint8_t>(v), static_cast<uint8_t>(u / 256 + 16 * frame)};
}

}  // namespace glovebench::test_camera
