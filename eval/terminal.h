#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <deque>
#include <mutex>
#include <string>
#include <utility>

#include "core/tracker/track_result.h"

// What the program says to a person, on stderr.

namespace glovebench::eval {

/// Writes text to stderr. If nobody can read it (a pipe that was closed or is full, a terminal that is gone),
/// nothing happens: no work ends or waits for that. fmt::print would throw.
template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  pollfd to_person = {STDERR_FILENO, POLLOUT, 0};
  if (::poll(&to_person, 1, 0) == 1 && (to_person.revents & POLLOUT))
    std::fwrite(text.data(), 1, text.size(), stderr);
}

/// From now on every `Progress` speaks to a log, too: where stderr is no terminal, a line for each `interval`, s.
void log_progress(double interval);

/// A bar for what takes over two seconds; silent unless stderr is a terminal or `log_progress` was called.
/// Thread-safe.
class Progress {
 public:
  Progress(std::string title, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` done, 0..1.
  void show(double share);

 private:
  void show_bar(double share, double elapsed);

  std::string title_;
  bool quiet_;
  bool has_bar_;  ///< standard error is a terminal
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  int last_percent_ = -1;
};

/// How tracking goes just now, in one line. The caller brings the clock.
class LiveStatus {
 public:
  static constexpr size_t kFrames = 60;  ///< of which it speaks: two seconds

  /// `time` (s, of any origin) is when the answer was there; it does not decrease.
  void add(double time, const TrackResult& result);
  /// "29.9 frames/s, 97% tracked, residual 1.3 mm, 2 dropped"; what is not known yet is a dash.
  std::string line(int dropped) const;

 private:
  struct Moment {
    double time = 0;
    bool tracked = false;
    double residual = 0;  ///< m
  };
  std::deque<Moment> moments_;
};

/// The status of a live device, twice a second; silent unless stderr is a terminal.
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
  double last_ = 0;  ///< s after the start
  LiveStatus status_;
};

}  // namespace glovebench::eval
