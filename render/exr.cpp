#include "render/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/error.h"

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

constexpr std::array<const char*, 3> kColorChannels = {"R", "G", "B"};

/// The channels by their names in the file.
struct Channels {
  int width = 0;
  int height = 0;
  std::map<std::string, Image<float>> floats;
  std::map<std::string, Image<uint32_t>> integers;
};

Channels split(const std::string& path, const FrameLayers& layers) {
  Channels channels;
  /// False without image. The first image gives the size.
  const auto has = [&](const auto& image) {
    if (image.empty()) return false;
    if (channels.width == 0) {
      channels.width = image.width();
      channels.height = image.height();
    }
    if (image.width() != channels.width || image.height() != channels.height)
      throw Error(path, "layers", fmt::format("{} x {} px", image.width(), image.height()),
                  fmt::format("{} x {} px, as the first layer", channels.width, channels.height));
    return true;
  };
  const auto add_depth = [&](const char* name, const DepthImage& depth) {
    if (has(depth)) channels.floats[name] = depth;
  };
  const auto add_label = [&](const char* name, const LabelImage& label) {
    if (!has(label)) return;
    Image<uint32_t>& target = channels.integers[name] = Image<uint32_t>(label.width(), label.height());
    std::copy(label.begin(), label.end(), target.begin());
  };
  if (has(layers.color)) {
    for (size_t c = 0; c < kColorChannels.size(); ++c) {
      Image<float>& target = channels.floats[kColorChannels[c]] = Image<float>(channels.width, channels.height);
      for (size_t i = 0; i < target.size(); ++i) target[i] = linear_of_code()[layers.color[i][c]];
    }
  }
  add_depth("Z", layers.depth);
  add_label("label", layers.label);
  add_depth("tracker.Z", layers.tracker_depth);
  add_label("tracker.label", layers.tracker_label);
  if (channels.width == 0) throw Error(path, "layers", "none", "at least one image");
  return channels;
}

/// OpenEXR's view of the channels' memory.
Imf::FrameBuffer frame_buffer(Channels& channels) {
  Imf::FrameBuffer buffer;
  const auto row_bytes = static_cast<size_t>(channels.width) * 4;
  for (auto& [name, image] : channels.floats)
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.data()), 4, row_bytes));
  for (auto& [name, image] : channels.integers)
    buffer.insert(name, Imf::Slice(Imf::UINT, reinterpret_cast<char*>(image.data()), 4, row_bytes));
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

}  // namespace glovebench::render
