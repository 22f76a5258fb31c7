#include "core/kinect/freenect/freenect_device.h"

#include <libfreenect.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>

#include "core/kinect/disparity.h"
#include "core/kinect/frame_pairer.h"
#include "core/kinect/latest_queue.h"
#include "core/kinect/recording_index.h"
#include "core/kinect/tick_clock.h"

namespace glovebench {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr size_t kMaxImages = 16;  // of each kind that wait for a partner: half a second
constexpr size_t kMaxFrames = 2;   // whole ones that wait to be fetched
constexpr auto kSlice = std::chrono::milliseconds(100);

/// What libfreenect said last of what is wrong. It tells the context alone, to which nothing of ours can be tied.
std::mutex complaint_mutex;
std::string complaint;

void keep_complaint(freenect_context*, freenect_loglevel level, const char* message) {
  if (level > FREENECT_LOG_ERROR) return;
  const std::lock_guard lock(complaint_mutex);
  complaint = message;
  while (!complaint.empty() && complaint.back() == '\n') complaint.pop_back();
  for (char& c : complaint)
    if (c == '\n') c = ' ';
}

std::string last_complaint() {
  const std::lock_guard lock(complaint_mutex);
  return complaint.empty() ? "" : " (libfreenect: " + complaint + ")";
}

void require(bool success, const char* field, const std::string& expected) {
  if (!success) throw Error("libfreenect", field, "a refusal" + last_complaint(), expected);
}

/// Initialized libfreenect with one open device; closes what it has opened.
class Handle {
 public:
  explicit Handle(int index) {
    require(freenect_init(&context_, nullptr) >= 0, "context", "access to USB devices");
    try {
      open(index);
    } catch (...) {
      freenect_shutdown(context_);
      throw;
    }
  }
  ~Handle() {
    freenect_close_device(device_);
    freenect_shutdown(context_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  freenect_context* context() const { return context_; }
  freenect_device* device() const { return device_; }

 private:
  void open(int index) {
    freenect_set_log_callback(context_, keep_complaint);
    freenect_select_subdevices(context_, FREENECT_DEVICE_CAMERA);
    const int count = freenect_num_devices(context_);
    if (index >= count)
      throw Error("libfreenect", "Kinects that are plugged in", std::to_string(count),
                  "at least " + std::to_string(index + 1));
    require(freenect_open_device(context_, &device_, index) >= 0, "device",
            "a Kinect that is free and that this user may open (the udev rules of libfreenect)");
  }

  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
};

/// No signal interrupts a thread that is started while this lives: libusb would report it as a failure.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

const FreenectOptions& checked(const FreenectOptions& options) {
  if (options.index < 0) throw Error("freenect", "device", std::to_string(options.index), "0 or more");
  if (const char* dump = std::getenv("FAKENECT_PATH")) check_fakenect_dump(dump);
  return options;
}

}  // namespace

/// The device, the thread that serves it, and what waits between that thread and the reader.
class FreenectDevice::Stream {
 public:
  explicit Stream(FreenectOptions options)
      : options_(std::move(options)), handle_(options_.index), pairer_({.max_waiting = kMaxImages}) {
    freenect_device* device = handle_.device();
    freenect_set_user(device, this);
    freenect_set_depth_callback(device, [](freenect_device* from, void* data, uint32_t ticks) {
      static_cast<Stream*>(freenect_get_user(from))->take_depth(data, ticks);
    });
    freenect_set_video_callback(device, [](freenect_device* from, void* data, uint32_t ticks) {
      static_cast<Stream*>(freenect_get_user(from))->take_color(data, ticks);
    });
    start(device);
    const SignalsBlocked blocked;
    thread_ = std::thread([this] { serve(); });
  }

  ~Stream() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
    freenect_stop_depth(handle_.device());
    freenect_stop_video(handle_.device());
  }

  std::optional<DeviceFrame> next_frame() {
    std::unique_lock lock(mutex_);
    if (std::optional<DeviceFrame> frame = take_waiting()) return frame;
    const auto start = std::chrono::steady_clock::now();
    const auto ready = [&] { return !frames_.empty() || !end_.empty(); };
    while (!changed_.wait_for(lock, kSlice, ready)) {
      if (options_.interrupted && options_.interrupted()) end_ = "interrupted";
      const std::chrono::duration<double> silence = std::chrono::steady_clock::now() - start;
      if (end_.empty() && silence.count() > options_.silence_limit) {
        end_ = "silent";
        throw Error("freenect", "frames",
                    "none in " + std::to_string(std::lround(silence.count())) + " s" + last_complaint(),
                    "30 a second");
      }
    }
    return take_waiting();
  }

  FreenectLosses losses() const {
    const std::lock_guard lock(mutex_);
    return {frames_.late(), pairer_.unpaired(), pairer_.went_back()};
  }
  std::string end() const {
    const std::lock_guard lock(mutex_);
    return end_;
  }

 private:
  static void start(freenect_device* device) {
    const freenect_frame_mode depth = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_DEPTH_11BIT);
    const freenect_frame_mode video = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
    require(depth.bytes == 2 * kWidth * kHeight && freenect_set_depth_mode(device, depth) >= 0, "depth mode",
            "11 bits, 640x480");
    require(video.bytes == 3 * kWidth * kHeight && freenect_set_video_mode(device, video) >= 0, "video mode",
            "RGB, 640x480");
    require(freenect_start_depth(device) >= 0, "depth stream", "a start");
    require(freenect_start_video(device) >= 0, "video stream", "a start");
  }

  /// The thread: from here the library calls take_depth and take_color.
  void serve() {
    const char* reason = "the device has gone: unplugged, or the end of what fakenect plays";
    while (!is_stopping()) {
      timeval timeout{0, 100'000};
      if (freenect_process_events_timeout(handle_.context(), &timeout) < 0) break;
    }
    const std::lock_guard lock(mutex_);
    pairer_.finish();
    fetch_pairs();
    if (end_.empty()) end_ = reason;
    changed_.notify_all();
  }

  bool is_stopping() const {
    const std::lock_guard lock(mutex_);
    return stopping_ || !end_.empty();
  }

  void take_depth(const void* data, uint32_t ticks) {
    auto image = std::make_shared<Image<uint16_t>>(kWidth, kHeight);
    std::memcpy(image->data(), data, 2 * image->size());
    for (uint16_t& raw : *image) raw = std::min(raw, kNoDisparity);
    take([&](int64_t time_us) { pairer_.push_depth(time_us, image); }, ticks);
  }
  void take_color(const void* data, uint32_t ticks) {
    auto image = std::make_shared<ColorImage>(kWidth, kHeight);
    std::memcpy(image->data(), data, 3 * image->size());
    take([&](int64_t time_us) { pairer_.push_color(time_us, image); }, ticks);
  }
  template <typename Push>
  void take(const Push& push, uint32_t ticks) {
    std::unique_lock lock(mutex_);
    push(clock_.microseconds(ticks));
    fetch_pairs();
    changed_.notify_all();
    const auto may_go_on = [&] { return !frames_.is_overfull() || stopping_ || !end_.empty(); };
    if (options_.every_frame) changed_.wait(lock, may_go_on);
    if (!options_.every_frame) frames_.drop_oldest();
  }

  std::optional<DeviceFrame> take_waiting() {
    std::optional<DeviceFrame> frame = frames_.pop();
    if (frame) changed_.notify_all();
    return frame;
  }

  void fetch_pairs() {
    while (auto pair = pairer_.pop())
      frames_.push({std::move(*pair->depth), *pair->color, pair->depth_us, pair->color_us});
  }

  FreenectOptions options_;
  Handle handle_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  TickClock clock_;
  FramePairer<std::shared_ptr<Image<uint16_t>>, std::shared_ptr<ColorImage>> pairer_;
  LatestQueue<DeviceFrame> frames_{kMaxFrames};
  bool stopping_ = false;
  std::string end_;
  std::thread thread_;
};

FreenectDevice::FreenectDevice(const RgbdCalibration& calibration, FreenectOptions options)
    : calibration_(calibration), stream_(std::make_unique<Stream>(checked(options))) {}

FreenectDevice::~FreenectDevice() = default;

const RgbdCalibration& FreenectDevice::calibration() const {
  return calibration_;
}

std::optional<DeviceFrame> FreenectDevice::next_frame() {
  return stream_->next_frame();
}

FreenectLosses FreenectDevice::losses() const {
  return stream_->losses();
}

std::string FreenectDevice::end() const {
  return stream_->end();
}

}  // namespace glovebench
