#include "core/base/hash.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

TEST(Hash, is_that_of_the_published_algorithm) {
  // XXH3_128bits of no bytes, from the algorithm's own test vectors (xxhsum -H2 of an empty file).
  EXPECT_EQ(hash_text(""), "99aa06d3014798d86001c324468d497f");
}

TEST(Hash, changes_with_any_byte_and_with_the_length) {
  std::string text(1000, 'x');
  std::set<std::string> hashes = {hash_text(text)};
  for (size_t i = 0; i < text.size(); ++i) {
    std::string other = text;
    other[i] ^= 1;
    hashes.insert(hash_text(other));
    hashes.insert(hash_text(text.substr(0, i)));
  }
  EXPECT_EQ(hashes.size(), 2001u);
}

TEST(Hash, of_a_file_is_that_of_its_content) {
  const TestFolder folder;
  const std::string content("with\0zero\n", 10);
  write_file(folder / "file", content);
  EXPECT_EQ(hash_file(folder / "file"), hash_text(content));
  EXPECT_EQ(hash_bytes(std::as_bytes(std::span(content))), hash_text(content));
  EXPECT_THROW(hash_file(folder / "missing"), Error);
}

}  // namespace
}  // namespace glovebench
