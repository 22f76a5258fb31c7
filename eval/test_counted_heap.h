#pragma once

// Counts a thread's heap memory. Replaces C library functions: include it in one source of a program.

#include <malloc.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

namespace counted_heap {

inline thread_local bool counting = false;
inline thread_local int64_t now_bytes = 0, most_bytes = 0;

inline void* taken(void* memory) {
  if (!counting) return memory;
  now_bytes += static_cast<int64_t>(malloc_usable_size(memory));
  most_bytes = std::max(most_bytes, now_bytes);
  return memory;
}
inline void given_back(void* memory) {
  if (counting && memory) now_bytes -= static_cast<int64_t>(malloc_usable_size(memory));
}

inline void begin() {
  now_bytes = most_bytes = 0;
  counting = true;
}
/// Peak since `begin`.
inline int64_t end() {
  counting = false;
  return most_bytes;
}

}  // namespace counted_heap

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

void* malloc(size_t size) { return counted_heap::taken(__libc_malloc(size)); }
void* calloc(size_t number, size_t size) { return counted_heap::taken(__libc_calloc(number, size)); }
void* realloc(void* memory, size_t size) {
  counted_heap::given_back(memory);
  return counted_heap::taken(__libc_realloc(memory, size));
}
void* aligned_alloc(size_t alignment, size_t size) { return counted_heap::taken(__libc_memalign(alignment, size)); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  *memory = counted_heap::taken(__libc_memalign(alignment, size));
  return *memory != nullptr ? 0 : ENOMEM;
}
void free(void* memory) {
  counted_heap::given_back(memory);
  __libc_free(memory);
}
}
