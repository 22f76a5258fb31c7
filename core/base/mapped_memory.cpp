#include "core/base/mapped_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace glovebench {

MappedMemory MappedMemory::zeros(size_t bytes) {
  if (bytes == 0) return {};
  void* const data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED) throw std::bad_alloc();
  ::madvise(data, bytes, MADV_HUGEPAGE);  // optional: small pages work, too
  return {data, bytes, false};
}

MappedMemory MappedMemory::of_file(const std::string& path) {
  const auto file = std::make_shared<const InputFile>(path, InputFile::Kind::regular);
  const auto bytes = static_cast<size_t>(*file->size());
  if (bytes == 0) return {};
  void* const data = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file->descriptor(), 0);
  if (data == MAP_FAILED) throw Error(path, "file", std::strerror(errno), "a file that can be mapped");
  MappedMemory memory(data, bytes, true);
  memory.input_ = file;
  return memory;
}

MappedMemory MappedMemory::of_descriptor(int descriptor, size_t bytes, const std::string& path) {
  if (bytes == 0) return {};
  void* const data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (data == MAP_FAILED) throw Error(path, "file", std::strerror(errno), "a file that can be mapped");
  return {data, bytes, true};
}

void MappedMemory::release(size_t offset, size_t bytes) const { advise(offset, bytes, MADV_DONTNEED); }

void MappedMemory::expect_random_reads(size_t offset, size_t bytes) const { advise(offset, bytes, MADV_RANDOM); }

void MappedMemory::require_unchanged() const {
  if (input_) input_->require_unchanged();
}

void MappedMemory::advise(size_t offset, size_t bytes, int advice) const {
  if (!is_file_) return;  // private memory would be lost
  const auto page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
  const size_t begin = (offset + page - 1) / page * page, end = std::min(offset + bytes, size_) / page * page;
  if (begin < end) ::madvise(data_ + begin, end - begin, advice);  // optional
}

MappedMemory::~MappedMemory() {
  if (data_) ::munmap(data_, size_);
}

MappedMemory::MappedMemory(MappedMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      is_file_(std::exchange(other.is_file_, false)),
      input_(std::move(other.input_)) {}

MappedMemory& MappedMemory::operator=(MappedMemory&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(is_file_, other.is_file_);
  std::swap(input_, other.input_);
  return *this;
}

}  // namespace glovebench
