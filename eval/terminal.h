#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "core/tracker/track_result.h"

namespace glovebench::eval {

/// Prints to stderr. Drops the text if stderr is broken.
template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  pollfd to_person = {STDERR_FILENO, POLLOUT, 0};
  if (::poll(&to_person, 1, 0) == 1 && (to_person.revents & POLLOUT))
    std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Width of stdout, at least 60. 80 without a terminal.
size_t terminal_columns();

/// Each `Progress` then logs a line every `interval` s if stderr is no terminal.
void log_progress(double interval);

/// A bar for work over 2 s. Silent unless stderr is a terminal or `log_progress` was called. Thread-safe.
class Progress {
 public:
  Progress(std::string title, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// 0..1.
  void show(double share);

 private:
  void erase_bar();
  void show_bar(double share, double elapsed);

  std::string title_;
  bool quiet_;
  bool has_bar_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  int last_percent_ = -1;
};

/// Statistics over the last `kFrames`.
class LiveStatus {
 public:
  static constexpr size_t kFrames = 60;  ///< two seconds

  /// `time`: s, must not decrease.
  void add(double time, const TrackResult& result);
  /// "29.9 frames/s, 97% tracked, residual 1.3 mm, 2 dropped". "-" for unknown values.
  std::string line(int dropped) const;

 private:
  struct Moment {
    double time = 0;
    bool tracked = false;
    double residual = 0;  ///< m
  };
  std::deque<Moment> moments_;
};

/// At 2 Hz. Silent unless stderr is a terminal.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const TrackResult& result, int dropped);

 private:
  bool enabled_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double last_ = 0;
  LiveStatus status_;
};

/// During its lifetime SIGINT, SIGTERM and SIGHUP set a flag. A second SIGINT or SIGTERM ends the program. Respects
/// nohup.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool wished();

 private:
  struct sigaction before_int_, before_term_, before_hup_;
};

}  // namespace glovebench::eval
