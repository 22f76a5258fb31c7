#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace glovebench {

/// At least `bytes`, aligned to 64, from this thread's store or the heap.
/// Throws: std::bad_alloc.
void* take_memory(size_t bytes);
/// The store keeps up to 64 MiB (0 under the address sanitizer).
void give_memory(void* memory, size_t bytes) noexcept;

template <typename T>
struct RecyclingAllocator {
  using value_type = T;

  RecyclingAllocator() = default;
  template <typename U>
  RecyclingAllocator(const RecyclingAllocator<U>&) {}

  T* allocate(size_t count) {
    static_assert(alignof(T) <= 64);
    if (count > static_cast<size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(take_memory(count * sizeof(T)));
  }
  void deallocate(T* memory, size_t count) noexcept { give_memory(memory, count * sizeof(T)); }

  friend bool operator==(const RecyclingAllocator&, const RecyclingAllocator&) { return true; }
};

/// For data of one frame. Reuses the memory of earlier frames.
template <typename T>
using RecycledVector = std::vector<T, RecyclingAllocator<T>>;

}  // namespace glovebench
