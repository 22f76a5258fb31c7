#include <OpenNI.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <deque>
#include <initializer_list>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

#include "core/adapters/openni2/oni_player.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

// OpenNI2 crashes if a recording is closed before its thread has begun.
constexpr auto kStart = std::chrono::milliseconds(50);
constexpr int kSilence_ms = 5000;     // without a frame; then the player has given up
constexpr size_t kMostWaiting = 100;  // images of both kinds

/// OpenNI2 with its drivers.
class OpenNi2 {
 public:
  OpenNi2() {
    openni::OpenNI::setLogConsoleOutput(false);
    openni::OpenNI::setLogFileOutput(false);
    if (openni::OpenNI::initialize() != openni::STATUS_OK) throw Error("OpenNI2", "drivers", complaint(), "some");
  }
  ~OpenNi2() { openni::OpenNI::shutdown(); }
  OpenNi2(const OpenNi2&) = delete;
  OpenNi2& operator=(const OpenNi2&) = delete;

  /// The last one, in one line.
  static std::string complaint() {
    std::string text = openni::OpenNI::getExtendedError();
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\t'; }, ' ');
    const size_t begin = text.find_first_not_of(' ');
    if (begin == std::string::npos) return "a refusal";
    return text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
  }
};

std::string name_of(openni::PixelFormat format) {
  constexpr std::pair<openni::PixelFormat, const char*> kNames[] = {
      {openni::PIXEL_FORMAT_DEPTH_1_MM, "DEPTH_1_MM"},
      {openni::PIXEL_FORMAT_DEPTH_100_UM, "DEPTH_100_UM"},
      {openni::PIXEL_FORMAT_SHIFT_9_2, "SHIFT_9_2"},
      {openni::PIXEL_FORMAT_SHIFT_9_3, "SHIFT_9_3"},
      {openni::PIXEL_FORMAT_RGB888, "RGB888"},
      {openni::PIXEL_FORMAT_YUV422, "YUV422"},
      {openni::PIXEL_FORMAT_GRAY8, "GRAY8"},
      {openni::PIXEL_FORMAT_GRAY16, "GRAY16"},
      {openni::PIXEL_FORMAT_JPEG, "JPEG"},
      {openni::PIXEL_FORMAT_YUYV, "YUYV"}};
  for (const auto& [known, name] : kNames)
    if (known == format) return name;
  return fmt::format("format {}", static_cast<int>(format));
}

/// px
double focal_length(int size_px, float fov, const std::string& where, const char* field) {
  if (!(fov > 0 && fov < std::numbers::pi_v<float>))
    throw Error(where, field, fmt::format("{} rad", fov), "more than 0 and less than pi, or --calibration");
  return size_px / (2 * std::tan(fov / 2.0));
}

class OpenNi2Player : public OniPlayer {
 public:
  explicit OpenNi2Player(const std::string& path) : path_(path) {
    if (device_.open(path.c_str()) != openni::STATUS_OK)
      throw Error(path, "recording", OpenNi2::complaint(), "one that OpenNI2 opens");
    std::this_thread::sleep_for(kStart);
    // The player skips the images of streams that do not exist yet.
    create(kDepth, openni::SENSOR_DEPTH, {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM});
    create(kColor, openni::SENSOR_COLOR, {openni::PIXEL_FORMAT_RGB888});
    device_.getPlaybackControl()->setSpeed(-1);  // an image for each wait
    for (openni::VideoStream& stream : streams_)
      if (stream.start() != openni::STATUS_OK) throw Error(path, "streams", OpenNi2::complaint(), "a start");
  }

  RgbdCalibration calibration() const override {
    const openni::VideoMode depth = streams_[kDepth].getVideoMode(), color = streams_[kColor].getVideoMode();
    if (int64_t{depth.getResolutionX()} * color.getResolutionY() !=
        int64_t{color.getResolutionX()} * depth.getResolutionY())
      throw Error(path_, "sizes",
                  fmt::format("{}x{} depth and {}x{} color", depth.getResolutionX(), depth.getResolutionY(),
                              color.getResolutionX(), color.getResolutionY()),
                  "the same shape, or --calibration");
    RgbdCalibration calibration;
    calibration.ir = camera(depth);
    calibration.rgb = camera(color);
    return calibration;
  }
  double steps_per_m() const override { return format_of(kDepth) == openni::PIXEL_FORMAT_DEPTH_1_MM ? 1e3 : 1e4; }

  Image<uint16_t> depth_steps(int64_t time_us) override { return image<uint16_t>(kDepth, time_us); }
  ColorImage color(int64_t time_us) override { return image<Rgb>(kColor, time_us); }

 private:
  enum Kind { kDepth, kColor };
  using Frame = openni::VideoFrameRef;

  void create(Kind kind, openni::SensorType sensor, std::initializer_list<openni::PixelFormat> formats) {
    const std::string field = kind == kDepth ? "depth stream" : "color stream";
    std::vector<std::string> names;
    for (const openni::PixelFormat format : formats) names.push_back(name_of(format));
    const std::string expected = fmt::format("{}", fmt::join(names, " or "));
    if (!device_.hasSensor(sensor)) throw Error(path_, field, "none", expected);
    if (streams_[kind].create(device_, sensor) != openni::STATUS_OK)
      throw Error(path_, field, OpenNi2::complaint(), expected);
    const openni::PixelFormat found = format_of(kind);
    if (std::ranges::find(formats, found) == formats.end()) throw Error(path_, field, name_of(found), expected);
  }
  openni::PixelFormat format_of(Kind kind) const { return streams_[kind].getVideoMode().getPixelFormat(); }

  /// A camera of the color stream's fields of view and the mode's size.
  PinholeCamera camera(const openni::VideoMode& mode) const {
    const openni::VideoStream& color = streams_[kColor];
    PinholeCamera camera{.width = mode.getResolutionX(), .height = mode.getResolutionY()};
    camera.fx = focal_length(camera.width, color.getHorizontalFieldOfView(), path_, "horizontal field of view");
    camera.fy = focal_length(camera.height, color.getVerticalFieldOfView(), path_, "vertical field of view");
    camera.cx = (camera.width - 1) / 2.0;
    camera.cy = (camera.height - 1) / 2.0;
    return camera;
  }

  template <typename Pixel>
  Image<Pixel> image(Kind kind, int64_t time_us) {
    const Frame& frame = frame_at(kind, time_us);
    const int width = frame.getWidth(), height = frame.getHeight(), stride = frame.getStrideInBytes();
    if (width < 1 || height < 1 || stride / static_cast<int>(sizeof(Pixel)) < width ||
        frame.getDataSize() / stride < height)
      throw Error(path_, field_of(kind, time_us),
                  fmt::format("{} bytes for {}x{} pixels", frame.getDataSize(), width, height), "more");
    Image<Pixel> image(width, height);
    for (int v = 0; v < height; ++v)
      std::memcpy(image.row(v), static_cast<const char*>(frame.getData()) + size_t{1} * v * stride,
                  sizeof(Pixel) * width);
    if (streams_[kind].getMirroringEnabled())
      for (int v = 0; v < height; ++v) std::reverse(image.row(v), image.row(v) + width);
    return image;
  }

  const Frame& frame_at(Kind kind, int64_t time_us) {
    std::deque<Frame>& waiting = waiting_[kind];
    const auto is_wanted = [&](const Frame& frame) {
      return frame.getTimestamp() == static_cast<uint64_t>(time_us);
    };
    while (true) {
      const auto found = std::ranges::find_if(waiting, is_wanted);
      if (found != waiting.end()) {
        waiting.erase(waiting.begin(), found);
        return waiting.front();
      }
      if (has_ended_ || waiting_[kDepth].size() + waiting_[kColor].size() >= kMostWaiting || !read_next()) {
        has_ended_ = true;
        throw Error(path_, field_of(kind, time_us), "none that OpenNI2 shows", "the recorded one");
      }
    }
  }

  /// False at the end, where the player begins again, and if it is stuck in damaged data.
  bool read_next() {
    openni::VideoStream* streams[] = {&streams_[kDepth], &streams_[kColor]};
    int ready = 0;
    Frame frame;
    if (openni::OpenNI::waitForAnyStream(streams, 2, &ready, kSilence_ms) != openni::STATUS_OK ||
        streams_[ready].readFrame(&frame) != openni::STATUS_OK || frame.getFrameIndex() <= last_index_[ready])
      return false;
    last_index_[ready] = frame.getFrameIndex();
    waiting_[ready].push_back(frame);
    return true;
  }

  static std::string field_of(Kind kind, int64_t time_us) {
    return fmt::format("{} image at {:.6f} s", kind == kDepth ? "depth" : "color",
                       1e-6 * static_cast<double>(time_us));
  }

  std::string path_;
  OpenNi2 library_;
  openni::Device device_;
  std::array<openni::VideoStream, 2> streams_;
  std::array<std::deque<Frame>, 2> waiting_;
  std::array<int, 2> last_index_ = {-1, -1};
  bool has_ended_ = false;
};

}  // namespace

const bool kHasOpenNi2 = true;

std::unique_ptr<OniPlayer> open_oni(const std::string& path) { return std::make_unique<OpenNi2Player>(path); }

}  // namespace glovebench
