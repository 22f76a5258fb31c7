#pragma once

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/camera/pinhole_camera.h"
#include "render/exr.h"
#include "render/lighting.h"

namespace glovebench::render {

/// Throws Error unless there is room for all channels of an image in proportion to its file (core/README.md).
inline void expect_exr_size(const Imath::Box2i& window, uint64_t file_bytes, const std::string& where) {
  constexpr int64_t kBytesPerPixel = 42;  // of the channels and of what is made of them
  const int64_t width = int64_t{window.max.x} + 1, height = int64_t{window.max.y} + 1;
  const bool is_frame =
      window.min == Imath::V2i(0, 0) && width > 0 && height > 0 && width <= kMostSide_px && height <= kMostSide_px;
  const auto room = static_cast<int64_t>((uint64_t{15} << 20) + 16 * file_bytes);
  if (!is_frame || width * height * kBytesPerPixel > room) {
    throw Error(where, "size", fmt::format("{}x{} pixels in {} bytes", width, height, file_bytes),
                "an image that begins at (0, 0) and is not much larger than its file");
  }
}

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

/// Colors are exact.
/// Throws: Error for other files than `encode_exr`'s.
inline FrameLayers parse_exr(const std::string& content, const std::string& where) {
  constexpr std::array<std::string_view, 7> channels = {"R", "G", "B", "Z", "label", "tracker.Z", "tracker.label"};
  try {
    Imf::StdISStream stream;
    stream.str(content);
    Imf::InputFile file(stream);
    expect_exr_size(file.header().dataWindow(), content.size(), where);
    for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it) {
      const bool is_label = std::string_view(it.name()).ends_with("label");
      if (std::ranges::find(channels, it.name()) == channels.end() ||
          it.channel().type != (is_label ? Imf::UINT : Imf::FLOAT))
        throw Error(where, "channel", quoted_excerpt(it.name()), "those of a frame");
    }
    FrameLayers layers{{},
                       read_exr_channel<float>(file, "Z"),
                       read_exr_labels(file, "label"),
                       read_exr_channel<float>(file, "tracker.Z"),
                       read_exr_labels(file, "tracker.label")};
    for (size_t c = 0; c < 3; ++c) {
      const Image<float> linear = read_exr_channel<float>(file, std::array{"R", "G", "B"}[c]);
      if (c == 0) layers.color = ColorImage(linear.width(), linear.height());
      if (linear.size() != layers.color.size()) throw Error(where, "colors", "some of R, G and B", "all or none");
      for (size_t i = 0; i < linear.size(); ++i)
        layers.color[i][c] = static_cast<uint8_t>(std::lround(255 * std::clamp(srgb_encode(linear[i]), 0.0, 1.0)));
    }
    return layers;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    throw Error(where, "content", failure.what(), "a readable OpenEXR file");
  }
}

inline FrameLayers read_exr(const std::string& path) {
  return parse_exr(read_file(path, uint64_t{64} << 20), path);
}

}  // namespace glovebench::render
