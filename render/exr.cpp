#include "render/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "core/camera/pinhole_camera.h"
#include "render/lighting.h"

namespace glovebench::render {
namespace {

/// Linear light of each 8-bit code.
const std::array<float, 256>& linear_of_code() {
  static const std::array<float, 256> linear = [] {
    std::array<float, 256> values{};
    for (int code = 0; code < 256; ++code) {
      const double c = code / 255.0;
      values[code] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return linear;
}

uint8_t code_of_linear(float linear) {
  return static_cast<uint8_t>(std::lround(255 * std::clamp(srgb_encode(linear), 0.0, 1.0)));
}

constexpr std::array<const char*, 3> kColorChannels = {"R", "G", "B"};

/// The channels by their names in the file.
struct Channels {
  int width = 0;
  int height = 0;
  std::map<std::string, Image<float>> floats;
  std::map<std::string, Image<uint32_t>> integers;
};

void require_size(const std::string& path, const Channels& channels, int width, int height) {
  if (width != channels.width || height != channels.height) {
    throw Error(path, "layers", fmt::format("{} x {} px", width, height),
                fmt::format("{} x {} px, as the first layer", channels.width, channels.height));
  }
}

template <typename T>
void adopt_size(Channels& channels, const Image<T>& image) {
  if (channels.width == 0 && !image.empty()) {
    channels.width = image.width();
    channels.height = image.height();
  }
}

Channels split(const std::string& path, const FrameLayers& layers) {
  Channels channels;
  adopt_size(channels, layers.color);
  adopt_size(channels, layers.depth);
  adopt_size(channels, layers.label);
  adopt_size(channels, layers.tracker_depth);
  adopt_size(channels, layers.tracker_label);
  if (channels.width == 0) throw Error(path, "layers", "none", "at least one image");
  const auto add_depth = [&](const char* name, const DepthImage& depth) {
    if (depth.empty()) return;
    require_size(path, channels, depth.width(), depth.height());
    channels.floats[name] = depth;
  };
  const auto add_label = [&](const char* name, const LabelImage& label) {
    if (label.empty()) return;
    require_size(path, channels, label.width(), label.height());
    Image<uint32_t>& target = channels.integers[name] = Image<uint32_t>(label.width(), label.height());
    std::copy(label.begin(), label.end(), target.begin());
  };
  add_depth("Z", layers.depth);
  add_depth("tracker.Z", layers.tracker_depth);
  add_label("label", layers.label);
  add_label("tracker.label", layers.tracker_label);
  if (!layers.color.empty()) {
    require_size(path, channels, layers.color.width(), layers.color.height());
    for (size_t c = 0; c < kColorChannels.size(); ++c) {
      Image<float>& target = channels.floats[kColorChannels[c]] = Image<float>(channels.width, channels.height);
      for (size_t i = 0; i < target.size(); ++i) target[i] = linear_of_code()[layers.color[i][c]];
    }
  }
  return channels;
}

FrameLayers join(const Channels& channels) {
  const auto depth = [&](const char* name) {
    return channels.floats.contains(name) ? channels.floats.at(name) : DepthImage();
  };
  const auto label = [&](const char* name) {
    if (!channels.integers.contains(name)) return LabelImage();
    LabelImage image(channels.width, channels.height);
    const Image<uint32_t>& source = channels.integers.at(name);
    for (size_t i = 0; i < image.size(); ++i) image[i] = static_cast<uint8_t>(source[i]);
    return image;
  };
  FrameLayers layers{{}, depth("Z"), label("label"), depth("tracker.Z"), label("tracker.label")};
  if (!channels.floats.contains("R")) return layers;
  layers.color = ColorImage(channels.width, channels.height);
  for (size_t c = 0; c < kColorChannels.size(); ++c) {
    const Image<float>& source = channels.floats.at(kColorChannels[c]);
    for (size_t i = 0; i < source.size(); ++i) layers.color[i][c] = code_of_linear(source[i]);
  }
  return layers;
}

constexpr uint64_t kLargestFile = uint64_t{64} << 20;  // bytes
constexpr std::array<std::string_view, 7> kChannels = {"R", "G", "B", "Z", "label", "tracker.Z", "tracker.label"};

/// Throws Error unless there is room for all channels of an image in proportion to its file (core/README.md).
void expect_size(const Imath::Box2i& window, uint64_t file_bytes, const std::string& path) {
  constexpr int64_t kBytesPerPixel = 42;  // of the channels and of what is made of them
  const int64_t width = int64_t{window.max.x} + 1, height = int64_t{window.max.y} + 1;
  const bool is_frame =
      window.min == Imath::V2i(0, 0) && width > 0 && height > 0 && width <= kMostSide_px && height <= kMostSide_px;
  const auto room = static_cast<int64_t>((uint64_t{15} << 20) + 16 * file_bytes);
  if (!is_frame || width * height * kBytesPerPixel > room) {
    throw Error(path, "size", fmt::format("{}x{} pixels in {} bytes", width, height, file_bytes),
                "an image that begins at (0, 0) and is not much larger than its file");
  }
}

/// OpenEXR's view of the channels' memory, for writing and for reading.
Imf::FrameBuffer frame_buffer(Channels& channels) {
  Imf::FrameBuffer buffer;
  const auto row_bytes = static_cast<size_t>(channels.width) * 4;
  for (auto& [name, image] : channels.floats) {
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.data()), 4, row_bytes));
  }
  for (auto& [name, image] : channels.integers) {
    buffer.insert(name, Imf::Slice(Imf::UINT, reinterpret_cast<char*>(image.data()), 4, row_bytes));
  }
  return buffer;
}

}  // namespace

std::string encode_exr(const FrameLayers& layers, const std::string& where) {
  Channels channels = split(where, layers);
  Imf::Header header(channels.width, channels.height);
  for (const auto& entry : channels.floats) header.channels().insert(entry.first, Imf::Channel(Imf::FLOAT));
  for (const auto& entry : channels.integers) header.channels().insert(entry.first, Imf::Channel(Imf::UINT));
  Imf::StdOSStream stream;
  {
    // The file's end is written when it is closed.
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame_buffer(channels));
    file.writePixels(channels.height);
  }
  return stream.str();
}

void write_exr(const std::string& path, const FrameLayers& layers) { write_file(path, encode_exr(layers, path)); }

FrameLayers read_exr(const std::string& path) { return parse_exr(read_file(path, kLargestFile), path); }

FrameLayers parse_exr(const std::string& content, const std::string& where) {
  try {
    Imf::StdISStream stream;
    stream.str(content);
    Imf::InputFile file(stream);
    const Imath::Box2i window = file.header().dataWindow();
    expect_size(window, content.size(), where);
    Channels channels{window.max.x + 1, window.max.y + 1, {}, {}};
    for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it) {
      if (std::ranges::find(kChannels, it.name()) == kChannels.end()) {
        throw Error(where, "channel", quoted_excerpt(it.name()), "those of a frame");
      }
      if (it.channel().type == Imf::UINT) {
        channels.integers[it.name()] = Image<uint32_t>(channels.width, channels.height);
      } else {
        channels.floats[it.name()] = Image<float>(channels.width, channels.height);
      }
    }
    file.setFrameBuffer(frame_buffer(channels));
    file.readPixels(0, channels.height - 1);
    return join(channels);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    throw Error(where, "content", failure.what(), "a readable OpenEXR file");
  }
}

}  // namespace glovebench::render
