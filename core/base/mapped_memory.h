#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace glovebench {

class InputFile;

/// Whole pages of memory: of this process alone, or of a file whose bytes they are.
class MappedMemory {
 public:
  MappedMemory() = default;
  /// Zeroed memory. Asks for large pages: what is read here and there in it misses fewer translations. Throws
  /// std::bad_alloc.
  static MappedMemory zeros(size_t bytes);
  /// The bytes of a file, to read; they come into memory when they are looked at, and may leave it again. The file
  /// must be replaced (WholeFile), not changed, while it is mapped (`require_unchanged`): other bytes would be
  /// seen, and a byte that is no longer there, or that the disk cannot read, ends the process (SIGBUS). Throws
  /// Error.
  static MappedMemory of_file(const std::string& path);
  /// The first bytes of an open file, to write. Throws Error naming `path`.
  static MappedMemory of_descriptor(int descriptor, size_t bytes, const std::string& path);
  ~MappedMemory();
  MappedMemory(MappedMemory&& other) noexcept;
  MappedMemory& operator=(MappedMemory&& other) noexcept;

  /// Takes the pages of a file that lie wholly in this range out of this process's memory, not out of the file;
  /// they come back when they are looked at. What was written stays written. Memory from `zeros` is left as it is.
  void release(size_t offset, size_t bytes) const;
  /// Says that this range of a file will be looked at here and there: a page that is missing comes alone.
  void expect_random_reads(size_t offset, size_t bytes) const;

  /// Throws Error if it is the memory of a file that was written to since it was mapped.
  void require_unchanged() const;

  std::span<const uint8_t> bytes() const { return {data_, size_}; }
  /// Not of memory from `of_file`.
  std::span<uint8_t> writable() { return {data_, size_}; }

 private:
  MappedMemory(void* data, size_t size, bool is_file)
      : data_(static_cast<uint8_t*>(data)), size_(size), is_file_(is_file) {}
  void advise(size_t offset, size_t bytes, int advice) const;

  uint8_t* data_ = nullptr;
  size_t size_ = 0;
  bool is_file_ = false;
  std::shared_ptr<const InputFile> input_;  ///< of memory from `of_file`
};

}  // namespace glovebench
