#include "core/base/recycled_vector.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <thread>

#include "core/base/sanitizers.h"

namespace glovebench {
namespace {

TEST(RecycledVector, is_a_vector) {
  RecycledVector<int> values = {1, 2, 3};
  for (int i = 4; i < 1000; ++i) values.push_back(i);
  const RecycledVector<int> copy = values;
  values.clear();
  ASSERT_EQ(copy.size(), 999u);
  for (int i = 0; i < 999; ++i) EXPECT_EQ(copy[i], i + 1);
  EXPECT_EQ(RecycledVector<int>(5), RecycledVector<int>({0, 0, 0, 0, 0})) << "also in memory that comes back";
}

TEST(RecycledVector, has_memory_for_wide_registers) {
  for (size_t bytes : {1, 63, 64, 65, 1000, 1 << 20, (1 << 26) + 1}) {
    void* const memory = take_memory(bytes);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(memory) % 64, 0u) << bytes;
    std::memset(memory, 1, bytes);
    give_memory(memory, bytes);
  }
}

TEST(RecycledVector, refuses_what_no_memory_has) {
  EXPECT_THROW(RecyclingAllocator<double>().allocate(static_cast<size_t>(-1) / 4), std::bad_alloc);
  for (const size_t bytes : {SIZE_MAX / 2 + 1, SIZE_MAX - 1, SIZE_MAX})
    EXPECT_THROW(take_memory(bytes), std::bad_alloc) << bytes;
#ifndef GLOVEBENCH_ADDRESS_SANITIZER  // which ends the program
  EXPECT_THROW(take_memory(size_t{1} << 62), std::bad_alloc);
#endif
}

TEST(RecycledVector, may_be_made_on_one_thread_and_thrown_away_on_another) {
  for (int round = 0; round < 100; ++round) {
    RecycledVector<int> made;
    std::thread([&] { made.assign(1 << 16, round); }).join();
    EXPECT_EQ(made.back(), round);
  }
}

#ifndef GLOVEBENCH_ADDRESS_SANITIZER  // with it nothing is kept

TEST(RecycledVector, gives_back_what_was_given_last) {
  std::thread([] {
    void* const first = take_memory(1000);
    give_memory(first, 1000);
    void* const again = take_memory(600);  // the same power of two
    EXPECT_EQ(again, first);
    void* const another = take_memory(1000);
    EXPECT_NE(another, first);
    void* const larger = take_memory(1025);
    EXPECT_NE(larger, first);
    give_memory(again, 600);
    give_memory(another, 1000);
    give_memory(larger, 1025);
  }).join();
}

#endif

}  // namespace
}  // namespace glovebench
