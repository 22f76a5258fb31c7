#include "core/base/text.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Name, may_be_a_files_and_nothing_else) {
  for (const std::string& name : {std::string("a"), std::string("DB_20_postures"), std::string("Tr4.b-2 c"),
                                  std::string("9"), std::string(64, 'x')})
    EXPECT_TRUE(is_name(name)) << name;
  const std::string with_zero("a\0b", 3);
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string(".hidden"), std::string("../a"),
        std::string("a/b"), std::string("/a"), std::string("a\\b"), std::string("-rf"), std::string(" a"),
        std::string("a\n"), std::string("a\x7f"), std::string("\xc3\xa4"), std::string(65, 'x'), with_zero})
    EXPECT_FALSE(is_name(name)) << name;
}

TEST(Name, that_is_none_is_an_error_with_its_place) {
  EXPECT_EQ(checked_name("DB_own", "my.glovedb", "name"), "DB_own");
  EXPECT_THAT(
      [] { checked_name("x/../../evil", "my.glovedb", "name"); },
      ThrowsMessage<Error>(AllOf(HasSubstr("my.glovedb: name: found \"x/../../evil\""), HasSubstr("letters"))));
}

TEST(PathWithin, stays_in_the_folder) {
  EXPECT_EQ(path_within("out", "results.json"), "out/results.json");
  EXPECT_EQ(path_within("../out", "tables/figure4.csv"), "../out/tables/figure4.csv");
  const std::string with_zero("a\0b", 3);
  for (const std::string& name :
       {std::string(), std::string("/etc/passwd"), std::string("../a"), std::string("a/../../b"),
        std::string("a//b"), std::string("a/"), std::string("."), std::string("a/./b"),
        std::string(".unfinished/lock"), with_zero})
    EXPECT_THAT([&] { path_within("out", name); }, ThrowsMessage<Error>(HasSubstr("stays in the folder"))) << name;
}

TEST(PlaceWithin, follows_no_link_below_the_folder) {
  const TestFolder folder;
  const std::string set = folder / "set";
  std::filesystem::create_directories(set + "/real");
  std::filesystem::create_directory_symlink(folder.path(), set + "/link");
  std::filesystem::create_directory_symlink(folder / "none", set + "/real/dangling");
  std::filesystem::create_directory_symlink(set, folder / "alias");
  for (const char* name : {"a", "real/a", "missing/a", "link", "real/dangling"}) {
    EXPECT_EQ(place_within(set, name), set + "/" + name);
    EXPECT_EQ(place_within(folder / "alias", name), folder / "alias/" + name) << "the folder itself may be one";
  }
  for (const char* name : {"link/a", "link/set/a", "real/dangling/a"})
    EXPECT_THAT([&] { place_within(set, name); }, ThrowsMessage<Error>(HasSubstr("a link"))) << name;
  EXPECT_THROW(place_within(set, "../a"), Error);
}

}  // namespace
}  // namespace glovebench
