#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace glovebench {

/// Memory of at least that size, aligned to 64 bytes, from what this thread gave back or, if there is nothing of
/// about that size, from the heap. Throws std::bad_alloc.
void* take_memory(size_t bytes);
/// Gives back what `take_memory` gave for that size, on any thread: this thread keeps it for its next request, up
/// to 64 MiB a thread. With the address sanitizer nothing is kept, and blocks end where they should.
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

/// A vector for what is made and thrown away with each frame on one thread: its memory comes from a frame before
/// that was as large, without a request to the heap and without pages that the system has to clear.
template <typename T>
using RecycledVector = std::vector<T, RecyclingAllocator<T>>;

}  // namespace glovebench
