#include "core/adapters/freenect/live_kinect.h"

#include <libfreenect.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/adapters/freenect/freenect_handle.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "core/kinect/frame_pairer.h"
#include "core/kinect/latest_queue.h"
#include "core/kinect/recording_files.h"

namespace glovebench {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr size_t kMaxImages = 16;  // of each kind waiting for a partner: half a second
constexpr size_t kMaxFrames = 2;   // whole frames waiting to be fetched
constexpr auto kSlice = std::chrono::milliseconds(100);

/// Keeps signals from a thread that is started while this lives: libusb would report one as a failure.
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

struct WholeFrame {
  DeviceFrame frame;
  int64_t arrived_us = 0;  ///< since 1970
};

/// The recording that fakenect plays, if fakenect is loaded.
const char* played_dump() { return std::getenv("FAKENECT_PATH"); }

void require_size(const PinholeCamera& camera, const std::string& where, const std::string& field) {
  if (camera.width != kWidth || camera.height != kHeight)
    throw Error(where, field, std::to_string(camera.width) + "x" + std::to_string(camera.height) + " pixels",
                "640x480, the images of a Kinect");
}

const LiveOptions& checked(const LiveOptions& options, const RgbdCalibration& calibration) {
  require_size(calibration.ir, options.calibration_name, "ir");
  require_size(calibration.rgb, options.calibration_name, "rgb");
  if (options.index < 0) throw Error("freenect", "device", std::to_string(options.index), "0 or more");
  if (const char* dump = played_dump()) check_fakenect_dump(dump);
  return options;
}

/// The device, its thread, and the queue between the thread and the reader.
class FreenectDevice : public LiveKinect {
 public:
  FreenectDevice(const RgbdCalibration& calibration, const LiveOptions& options)
      : options_(checked(options, calibration)),
        calibration_(calibration),
        handle_(options_.index),
        pairer_({.max_waiting = kMaxImages}) {
    freenect_device* device = handle_.device();
    freenect_set_user(device, this);
    freenect_set_depth_callback(device, [](freenect_device* from, void* data, uint32_t ticks) {
      FreenectDevice* self = static_cast<FreenectDevice*>(freenect_get_user(from));
      self->or_fail([&] { self->take_depth(data, ticks); });
    });
    freenect_set_video_callback(device, [](freenect_device* from, void* data, uint32_t ticks) {
      FreenectDevice* self = static_cast<FreenectDevice*>(freenect_get_user(from));
      self->or_fail([&] { self->take_color(data, ticks); });
    });
    start(device);
    const SignalsBlocked blocked;
    thread_ = std::thread([this] { or_fail([this] { serve(); }); });
  }

  ~FreenectDevice() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
    freenect_stop_depth(handle_.device());
    freenect_stop_video(handle_.device());
  }

  const RgbdCalibration& calibration() const override { return calibration_; }

  std::optional<DeviceFrame> next_frame() override {
    std::unique_lock lock(mutex_);
    if (std::optional<DeviceFrame> frame = take_waiting()) return frame;
    const auto start = std::chrono::steady_clock::now();
    const auto ready = [&] { return !frames_.empty() || has_ended(); };
    while (!changed_.wait_for(lock, kSlice, ready)) {
      if (options_.interrupted && options_.interrupted()) end_ = "interrupted";
      const std::chrono::duration<double> silence = std::chrono::steady_clock::now() - start;
      if (!has_ended() && silence.count() > options_.silence_limit) {
        end_ = "silent";
        throw Error("freenect", "frames",
                    "none in " + std::to_string(std::lround(silence.count())) + " s" + last_complaint(),
                    "30 a second");
      }
    }
    std::optional<DeviceFrame> frame = take_waiting();
    if (!frame) throw_failure();
    return frame;
  }

  int64_t arrived_us() const override {
    const std::lock_guard lock(mutex_);
    return fetched_us_;
  }
  LiveLosses losses() const override {
    const std::lock_guard lock(mutex_);
    return {frames_.late(), pairer_.unpaired(), pairer_.went_back()};
  }
  std::string end() const override {
    const std::lock_guard lock(mutex_);
    return end_;
  }

 private:
  static void start(freenect_device* device) {
    const freenect_frame_mode depth = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_DEPTH_11BIT);
    const freenect_frame_mode video = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
    require_freenect(depth.bytes == 2 * kWidth * kHeight && freenect_set_depth_mode(device, depth) >= 0,
                     "depth mode", "11 bits, 640x480");
    require_freenect(video.bytes == 3 * kWidth * kHeight && freenect_set_video_mode(device, video) >= 0,
                     "video mode", "RGB, 640x480");
    require_freenect(freenect_start_depth(device) >= 0, "depth stream", "a start");
    require_freenect(freenect_start_video(device) >= 0, "video stream", "a start");
  }

  /// The thread's function, in which the library calls take_depth and take_color.
  void serve() {
    int result = 0;
    while (result >= 0 && !is_stopping()) {
      timeval timeout{0, 100'000};
      result = freenect_process_events_timeout(handle_.context(), &timeout);
    }
    const std::lock_guard lock(mutex_);
    pairer_.finish();
    fetch_pairs();
    if (stopping_ || has_ended()) return;
    if (!played_dump())
      throw Error("freenect", "device", "none any more, code " + std::to_string(result) + last_complaint(),
                  "one that stays plugged in");
    end_ = "the end of what fakenect plays";
    changed_.notify_all();
  }

  /// Runs an action in the thread, which C calls, so that nothing may be thrown; an exception ends the stream.
  template <typename Action>
  void or_fail(const Action& action) noexcept {
    try {
      action();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  /// Throws the failure as Error, whatever it was.
  void throw_failure() const {
    if (!failure_) return;
    try {
      std::rethrow_exception(failure_);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& e) {
      throw Error("freenect", "frames", e.what(), "room for them");
    }
  }

  /// True if nothing more will come; needs the mutex.
  bool has_ended() const { return !end_.empty() || failure_; }

  bool is_stopping() const {
    const std::lock_guard lock(mutex_);
    return stopping_ || has_ended();
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
    const auto may_go_on = [&] { return !frames_.is_overfull() || stopping_ || has_ended(); };
    if (options_.every_frame) changed_.wait(lock, may_go_on);
    if (!options_.every_frame) frames_.drop_oldest();
  }

  std::optional<DeviceFrame> take_waiting() {
    std::optional<WholeFrame> whole = frames_.pop();
    if (!whole) return std::nullopt;
    changed_.notify_all();
    fetched_us_ = whole->arrived_us;
    return std::move(whole->frame);
  }

  void fetch_pairs() {
    while (auto pair = pairer_.pop())
      frames_.push({{std::move(*pair->depth), *pair->color, pair->depth_us, pair->color_us}, system_us()});
  }

  LiveOptions options_;
  RgbdCalibration calibration_;
  FreenectHandle handle_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  TickClock clock_;
  FramePairer<std::shared_ptr<Image<uint16_t>>, std::shared_ptr<ColorImage>> pairer_;
  LatestQueue<WholeFrame> frames_{kMaxFrames};
  int64_t fetched_us_ = 0;
  bool stopping_ = false;
  std::string end_;             ///< why the stream ended without a failure
  std::exception_ptr failure_;  ///< the failure that ended it
  std::thread thread_;
};

}  // namespace

const bool kHasFreenect = true;

std::unique_ptr<LiveKinect> open_kinect(const RgbdCalibration& calibration, const LiveOptions& options) {
  return std::make_unique<FreenectDevice>(calibration, options);
}

}  // namespace glovebench
