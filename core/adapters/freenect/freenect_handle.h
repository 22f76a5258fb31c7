#pragma once

#include <libfreenect.h>

#include <string>

namespace glovebench {

/// " (libfreenect: COMPLAINT)", or "".
std::string last_complaint();
/// Throws: Error with the last complaint unless `success`.
void require_freenect(bool success, const char* field, const std::string& expected);

class FreenectHandle {
 public:
  /// Throws: Error if the device cannot be opened.
  explicit FreenectHandle(int index);
  ~FreenectHandle();
  FreenectHandle(const FreenectHandle&) = delete;
  FreenectHandle& operator=(const FreenectHandle&) = delete;

  freenect_context* context() const { return context_; }
  freenect_device* device() const { return device_; }

 private:
  void open(int index);

  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
};

}  // namespace glovebench
