#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace glovebench {

class InputFile;

/// Private pages or a file's.
class MappedMemory {
 public:
  MappedMemory() = default;
  /// Zeros, in large pages if possible.
  /// Throws: std::bad_alloc.
  static MappedMemory zeros(size_t bytes);
  /// Maps a file for reading. A WholeFile may replace it. If the file is shortened, access to lost bytes ends the
  /// process (SIGBUS).
  /// Throws: Error.
  static MappedMemory of_file(const std::string& path);
  /// Maps an open file for writing.
  /// Throws: Error.
  static MappedMemory of_descriptor(int descriptor, size_t bytes, const std::string& path);
  ~MappedMemory();
  MappedMemory(MappedMemory&& other) noexcept;
  MappedMemory& operator=(MappedMemory&& other) noexcept;

  /// Frees a file's pages inside this range until their next access. No effect on `zeros`.
  void release(size_t offset, size_t bytes) const;
  void expect_random_reads(size_t offset, size_t bytes) const;

  /// Throws: Error if the file changed since `of_file`.
  void require_unchanged() const;

  std::span<const uint8_t> bytes() const { return {data_, size_}; }
  /// Not after `of_file`.
  std::span<uint8_t> writable() { return {data_, size_}; }

 private:
  MappedMemory(void* data, size_t size, bool is_file)
      : data_(static_cast<uint8_t*>(data)), size_(size), is_file_(is_file) {}
  void advise(size_t offset, size_t bytes, int advice) const;

  uint8_t* data_ = nullptr;
  size_t size_ = 0;
  bool is_file_ = false;
  std::shared_ptr<const InputFile> input_;
};

}  // namespace glovebench
