#pragma once

#include <sys/types.h>

#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.h"

namespace glovebench {

/// An open file descriptor, or -1.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int number() const { return number_; }
  void close();

 private:
  int number_;
};

/// The program ended, or closed stdin or stdout and was killed.
struct ProgramEnded : Error {
  explicit ProgramEnded(int code);
  int exit_code;  ///< as a shell's: 128 + N after signal N
};

inline constexpr size_t kLongestAnswer = size_t{64} << 10;  ///< bytes of a line

/// A program that reads frames from stdin and answers on stdout in lines, run by /bin/sh -c. A guard process ends
/// it and all that it started when this object or glovebench ends. SIGPIPE must be ignored.
class TrackerProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws: Error if no process or pipe can be made.
  explicit TrackerProcess(const std::string& command);
  /// Closes the program's stdin, waits up to 1 s for its end, then kills it.
  ~TrackerProcess();
  TrackerProcess(const TrackerProcess&) = delete;
  TrackerProcess& operator=(const TrackerProcess&) = delete;

  /// Sends the parts and returns the next line, without its end.
  /// Throws: ProgramEnded; Error if the deadline passes or a line is too long. No exchange may follow.
  std::string exchange(std::span<const std::string_view> parts, Clock::time_point deadline);

  /// Kills the program and what it started, once. Returns its exit code.
  int kill();

 private:
  void send(std::string_view& bytes);
  void receive();

  pid_t guard_ = -1;
  int exit_code_ = 0;
  Descriptor to_program_, from_program_;
  Descriptor lifeline_;  ///< its closing makes the guard kill
  std::string received_;
};

}  // namespace glovebench
