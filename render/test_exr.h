#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>

#include "render/exr.h"
#include "render/lighting.h"

namespace glovebench::render {

/// Empty if the file has no such channel.
template <typename T>
Image<T> read_exr_channel(Imf::InputFile& file, const char* name) {
  if (file.header().channels().findChannel(name) == nullptr) return {};
  const Imath::Box2i window = file.header().dataWindow();
  Image<T> image(window.max.x + 1, window.max.y + 1);
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice(std::is_same_v<T, float> ? Imf::FLOAT : Imf::UINT,
                                 reinterpret_cast<char*>(image.data()), sizeof(T), image.width() * sizeof(T)));
  file.setFrameBuffer(buffer);
  file.readPixels(0, image.height() - 1);
  return image;
}

inline LabelImage read_exr_labels(Imf::InputFile& file, const char* name) {
  const Image<uint32_t> channel = read_exr_channel<uint32_t>(file, name);
  LabelImage labels(channel.width(), channel.height());
  std::ranges::transform(channel, labels.begin(), [](uint32_t label) { return static_cast<uint8_t>(label); });
  return labels;
}

/// Reads a file that encode_exr made. Colors are exact.
inline FrameLayers read_exr(const std::string& path) {
  Imf::InputFile file(path.c_str());
  FrameLayers layers{{},
                     read_exr_channel<float>(file, "Z"),
                     read_exr_labels(file, "label"),
                     read_exr_channel<float>(file, "tracker.Z"),
                     read_exr_labels(file, "tracker.label")};
  for (size_t c = 0; c < 3; ++c) {
    const Image<float> linear = read_exr_channel<float>(file, std::array{"R", "G", "B"}[c]);
    if (c == 0) layers.color = ColorImage(linear.width(), linear.height());
    for (size_t i = 0; i < linear.size(); ++i)
      layers.color[i][c] = static_cast<uint8_t>(std::lround(255 * std::clamp(srgb_encode(linear[i]), 0.0, 1.0)));
  }
  return layers;
}

}  // namespace glovebench::render
