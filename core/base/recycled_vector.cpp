#include "core/base/recycled_vector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>

#include "core/base/sanitizers.h"

namespace glovebench {
namespace {

constexpr size_t kMostKept = size_t{64} << 20;  // bytes

/// Blocks are powers of two.
constexpr int kSmallest = 6;  // 64 bytes
constexpr int kClasses = 27 - kSmallest;

/// The class of blocks for so many bytes: 0 for the smallest; kClasses or more are not kept.
int class_of(size_t bytes) { return std::max<int>(0, std::bit_width(std::max<size_t>(bytes, 1) - 1) - kSmallest); }

size_t block_bytes(int block_class) { return size_t{1} << (block_class + kSmallest); }

/// Set when `waiting` is destroyed: other destructors of the thread may run later and give memory back.
thread_local bool thread_ends = false;

/// Lists of free blocks, one for each size. A free block holds the address of the next.
class Waiting {
 public:
  ~Waiting() {
    thread_ends = true;
    for (Block* block : first_)
      while (block != nullptr) std::free(std::exchange(block, block->next));
  }

  /// Null if no block is free.
  void* take(int block_class) {
    Block* const block = first_[block_class];
    if (block == nullptr) return nullptr;
    first_[block_class] = block->next;
    kept_ -= block_bytes(block_class);
    return block;
  }
  bool keep(void* memory, int block_class) {
    if (kept_ + block_bytes(block_class) > kMostKept) return false;
    first_[block_class] = new (memory) Block{first_[block_class]};
    kept_ += block_bytes(block_class);
    return true;
  }

 private:
  struct Block {
    Block* next;
  };
  std::array<Block*, kClasses> first_{};
  size_t kept_ = 0;  ///< bytes
};

thread_local Waiting waiting;

void* from_heap(size_t bytes) {
  void* memory = nullptr;
  if (bytes > PTRDIFF_MAX || posix_memalign(&memory, 64, bytes) != 0) throw std::bad_alloc();
  return memory;
}

/// With recycling the address sanitizer would miss use after release and access beyond the requested size.
#ifdef GLOVEBENCH_ADDRESS_SANITIZER
constexpr bool kRecycles = false;
#else
constexpr bool kRecycles = true;
#endif

bool is_recycled(int block_class) { return kRecycles && block_class < kClasses && !thread_ends; }

}  // namespace

void* take_memory(size_t bytes) {
  const int block_class = class_of(bytes);
  if (!is_recycled(block_class)) return from_heap(bytes);
  void* const kept = waiting.take(block_class);
  return kept != nullptr ? kept : from_heap(block_bytes(block_class));
}

void give_memory(void* memory, size_t bytes) noexcept {
  const int block_class = class_of(bytes);
  if (!is_recycled(block_class) || !waiting.keep(memory, block_class)) std::free(memory);
}

}  // namespace glovebench
