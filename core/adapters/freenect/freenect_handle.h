#pragma once

#include <libfreenect.h>

#include <string>

namespace glovebench {

/// " (libfreenect: ...)", what the library said last of what is wrong, or "". For the end of a message.
std::string last_complaint();
/// Throws Error naming the field, what was expected and the library's complaint unless the library did as it was
/// told.
void require_freenect(bool success, const char* field, const std::string& expected);

/// Initialized libfreenect with one open device; closes what it has opened.
class FreenectHandle {
 public:
  /// Throws Error if there is no such device or it cannot be opened.
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
