#include "core/adapters/freenect/freenect_handle.h"

#include <mutex>

#include "core/base/error.h"

namespace glovebench {
namespace {

/// libfreenect's last complaint. The library passes only its context, which cannot refer to our objects.
std::mutex complaint_mutex;
std::string complaint;

/// Called from C, so nothing may be thrown: without memory a complaint is lost.
void keep_complaint(freenect_context*, freenect_loglevel level, const char* message) noexcept try {
  if (level > FREENECT_LOG_ERROR) return;
  const std::lock_guard lock(complaint_mutex);
  complaint = message;
  while (!complaint.empty() && complaint.back() == '\n') complaint.pop_back();
  for (char& c : complaint)
    if (c == '\n') c = ' ';
} catch (...) {
}

}  // namespace

std::string last_complaint() {
  const std::lock_guard lock(complaint_mutex);
  return complaint.empty() ? "" : " (libfreenect: " + complaint + ")";
}

void require_freenect(bool success, const char* field, const std::string& expected) {
  if (!success) throw Error("libfreenect", field, "a refusal" + last_complaint(), expected);
}

FreenectHandle::FreenectHandle(int index) {
  require_freenect(freenect_init(&context_, nullptr) >= 0, "context", "access to USB devices");
  try {
    open(index);
  } catch (...) {
    freenect_shutdown(context_);
    throw;
  }
}

FreenectHandle::~FreenectHandle() {
  freenect_close_device(device_);
  freenect_shutdown(context_);
}

void FreenectHandle::open(int index) {
  freenect_set_log_callback(context_, keep_complaint);
  freenect_select_subdevices(context_, FREENECT_DEVICE_CAMERA);
  const int count = freenect_num_devices(context_);
  if (index >= count)
    throw Error("libfreenect", "Kinects that are plugged in", std::to_string(count),
                "at least " + std::to_string(index + 1));
  require_freenect(freenect_open_device(context_, &device_, index) >= 0, "device",
                   "a Kinect that is free and that this user may open (the udev rules of libfreenect)");
}

}  // namespace glovebench
