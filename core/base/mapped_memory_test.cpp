#include "core/base/mapped_memory.h"

#include <gtest/gtest.h>

#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

constexpr size_t kBytes = 40'000;  // not whole pages

TEST(MappedMemory, of_a_file_that_is_written_keeps_what_was_written_when_it_is_released) {
  const TestFolder folder;
  {
    WholeFile file(folder / "file");
    MappedMemory memory = file.map(kBytes);
    std::ranges::fill(memory.writable(), uint8_t{7});
    memory.release(0, kBytes);
    EXPECT_EQ(std::ranges::count(memory.bytes(), 7), kBytes);
    memory.writable()[kBytes - 1] = 8;
    memory.release(100, kBytes);  // neither begins nor ends with a page
    file.commit();
  }
  EXPECT_EQ(read_file(folder / "file"), std::string(kBytes - 1, 7) + char{8});
}

TEST(MappedMemory, of_a_file_that_is_read_comes_back_when_it_is_released) {
  const TestFolder folder;
  write_file(folder / "file", std::string(kBytes, 5));
  const MappedMemory memory = MappedMemory::of_file(folder / "file");
  memory.expect_random_reads(0, kBytes);
  EXPECT_EQ(std::ranges::count(memory.bytes(), 5), kBytes);
  memory.release(0, 2 * kBytes);  // beyond the end
  EXPECT_EQ(std::ranges::count(memory.bytes(), 5), kBytes);
}

TEST(MappedMemory, of_this_process_alone_is_not_lost_when_it_is_released) {
  MappedMemory memory = MappedMemory::zeros(kBytes);
  std::ranges::fill(memory.writable(), uint8_t{3});
  const MappedMemory moved = std::move(memory);
  moved.release(0, kBytes);
  EXPECT_EQ(std::ranges::count(moved.bytes(), 3), kBytes);
}

}  // namespace
}  // namespace glovebench
