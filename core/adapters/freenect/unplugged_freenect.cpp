// For tests, in place of libfreenect: one Kinect that is unplugged after four frames.
#include <libfreenect.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

constexpr uint32_t kFrames = 4;
constexpr uint32_t kPeriod = 2'000'000;  // ticks of 60 MHz
constexpr int kNoDevice = -4;            // of libusb
constexpr size_t kPixels = 640 * 480;

void* user = nullptr;
freenect_depth_cb take_depth = nullptr;
freenect_video_cb take_video = nullptr;
freenect_log_cb log_line = nullptr;
uint32_t frame = 0;

/// The users of these never look inside.
template <typename T>
T* some() {
  static std::max_align_t place;
  return reinterpret_cast<T*>(&place);
}

freenect_frame_mode mode_of(size_t bytes) {
  freenect_frame_mode mode = {};
  mode.bytes = static_cast<int32_t>(bytes);
  mode.is_valid = 1;
  return mode;
}

}  // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name): of the library
int freenect_init(freenect_context** context, freenect_usb_context*) {
  *context = some<freenect_context>();
  return 0;
}
int freenect_shutdown(freenect_context*) { return 0; }
void freenect_set_log_callback(freenect_context*, freenect_log_cb callback) { log_line = callback; }
void freenect_select_subdevices(freenect_context*, freenect_device_flags) {}
int freenect_num_devices(freenect_context*) { return 1; }
int freenect_open_device(freenect_context*, freenect_device** device, int) {
  *device = some<freenect_device>();
  return 0;
}
int freenect_close_device(freenect_device*) { return 0; }
void freenect_set_user(freenect_device*, void* value) { user = value; }
void* freenect_get_user(freenect_device*) { return user; }
void freenect_set_depth_callback(freenect_device*, freenect_depth_cb callback) { take_depth = callback; }
void freenect_set_video_callback(freenect_device*, freenect_video_cb callback) { take_video = callback; }
freenect_frame_mode freenect_find_depth_mode(freenect_resolution, freenect_depth_format) {
  return mode_of(2 * kPixels);
}
freenect_frame_mode freenect_find_video_mode(freenect_resolution, freenect_video_format) {
  return mode_of(3 * kPixels);
}
int freenect_set_depth_mode(freenect_device*, freenect_frame_mode) { return 0; }
int freenect_set_video_mode(freenect_device*, freenect_frame_mode) { return 0; }
int freenect_start_depth(freenect_device*) { return 0; }
int freenect_start_video(freenect_device*) { return 0; }
int freenect_stop_depth(freenect_device*) { return 0; }
int freenect_stop_video(freenect_device*) { return 0; }

int freenect_process_events_timeout(freenect_context* context, timeval*) {
  if (frame == kFrames) {
    log_line(context, FREENECT_LOG_ERROR, "the camera is gone\n");
    return kNoDevice;
  }
  std::vector<uint16_t> nothing(kPixels, 2047);
  std::vector<uint8_t> black(3 * kPixels);
  take_depth(some<freenect_device>(), nothing.data(), kPeriod * frame);
  take_video(some<freenect_device>(), black.data(), kPeriod * frame);
  ++frame;
  return 0;
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
