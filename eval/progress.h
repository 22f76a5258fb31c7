#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace glovebench::eval {

/// A bar on stderr for what takes over two seconds; silent unless stderr is a terminal. Thread-safe.
class Progress {
 public:
  Progress(std::string title, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` done, 0..1.
  void show(double share);

 private:
  std::string title_;
  bool enabled_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  int last_percent_ = -1;
};

}  // namespace glovebench::eval
