#pragma once

#include <time.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace glovebench {

/// An open file. Its name may move to another file.
class InputFile {
 public:
  enum class Kind { regular, regular_or_pipe };

  /// Waits for the writer of a pipe.
  /// Throws: Error, also for devices, sockets and folders.
  explicit InputFile(const std::string& path, Kind kind = Kind::regular_or_pipe);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Bytes (0 in /proc). Empty for a pipe.
  std::optional<uint64_t> size() const { return size_; }
  int descriptor() const { return descriptor_; }
  /// Throws: Error if size or time of change differ from opening.
  void require_unchanged() const;
  /// The number of bytes, 0 at the end.
  /// Throws: Error.
  size_t read(std::span<char> room);

 private:
  std::string path_;
  int descriptor_ = -1;
  std::optional<uint64_t> size_;
  struct timespec modified_ = {};
};

// Largest accepted files (core/README.md), bytes.
inline constexpr uint64_t kLargestMovement = uint64_t{64} << 20;
inline constexpr uint64_t kLargestResults = 256'000'000;
inline constexpr uint64_t kLargestSmallFile = 16'000'000;
inline constexpr uint64_t kLargestUnknownFile = uint64_t{256} << 20;

/// Throws: Error if missing, unreadable or larger than `max_bytes`.
std::string read_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);
/// The same, without pipes.
std::string read_regular_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);

}  // namespace glovebench
