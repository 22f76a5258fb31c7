#pragma once

#include <time.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace glovebench {

/// A file that is open for reading: a regular file or a pipe. Devices, sockets and folders are refused, since they
/// may never end. What is read is what was checked, even if the name means another file meanwhile.
class InputFile {
 public:
  enum class Kind { regular, regular_or_pipe };

  /// Waits for the writer of a named pipe. Throws Error.
  explicit InputFile(const std::string& path, Kind kind = Kind::regular_or_pipe);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Bytes of a regular file; none for a pipe. The files of /proc say 0.
  std::optional<uint64_t> size() const { return size_; }
  int descriptor() const { return descriptor_; }
  /// Throws Error if the file was written to since it was opened, as far as its size and time tell. A file that
  /// took its name is another one.
  void require_unchanged() const;
  /// Reads bytes into the front of `room`; 0 at the end of the file. Throws Error.
  size_t read(std::span<char> room);

 private:
  std::string path_;
  int descriptor_ = -1;
  std::optional<uint64_t> size_;
  struct timespec modified_ = {};
};

// Larger files are refused before they take memory (core/README.md), bytes.
/// Trajectories and posture sets.
inline constexpr uint64_t kLargestMovement = uint64_t{64} << 20;
/// Results and estimates: the report of some million frames.
inline constexpr uint64_t kLargestResults = 256'000'000;
/// Files that do not grow with the frames: times, ratios, noise floors.
inline constexpr uint64_t kLargestSmallFile = 16'000'000;
/// All others, where nobody says what they may hold.
inline constexpr uint64_t kLargestUnknownFile = uint64_t{256} << 20;

/// The whole content of a regular file or a pipe. Throws Error if it is missing, cannot be read or is larger than
/// `max_bytes`, of which a reader says how many its files may have (core/README.md).
std::string read_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);
/// The same of a file that a folder brings along, which nobody named: a pipe is refused, since its reader would
/// wait for a writer that may never come.
std::string read_regular_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);

}  // namespace glovebench
