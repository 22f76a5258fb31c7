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

TEST(Split, keeps_empty_parts_and_what_is_beyond_the_last) {
  using Parts = std::vector<std::string_view>;
  EXPECT_EQ(split("", ','), Parts{""});
  EXPECT_EQ(split("a,,b,", ','), (Parts{"a", "", "b", ""}));
}

TEST(NumberIn, reads_the_whole_text_or_nothing) {
  EXPECT_EQ(number_in<int>("-12"), -12);
  EXPECT_EQ(number_in<double>("2.5e1"), 25);
  for (const char* text : {"", " 1", "1 ", "+1", "1.5", "one", "99999999999"})
    EXPECT_FALSE(number_in<int>(text)) << text;
  EXPECT_FALSE(number_in<unsigned>("-1"));
}

TEST(DidYouMean, names_the_nearest) {
  const std::vector<std::string> names = {"run", "record", "render", "track", "trajectories", "DB_open_power"};
  EXPECT_EQ(did_you_mean("rnu", names), "; did you mean run?") << "two letters swapped are one edit";
  EXPECT_EQ(did_you_mean("trak", names), "; did you mean track?");
  EXPECT_EQ(did_you_mean("trackk", names), "; did you mean track?");
  EXPECT_EQ(did_you_mean("trick", names), "; did you mean track?");
  EXPECT_EQ(did_you_mean("trajectory", names), "; did you mean trajectories?");
  EXPECT_EQ(did_you_mean("db_OPEN_pwoer", names), "; did you mean DB_open_power?");
  EXPECT_EQ(did_you_mean("rus", {"rust", "run", "rus"}), "; did you mean rus?");
  EXPECT_EQ(did_you_mean("Fingertip", {"tip_mm", "fingertip_mm", "fingertip_deg"}), "; did you mean fingertip_mm?")
      << "the shortest that begins with it";
  EXPECT_EQ(did_you_mean("Posture", {"posture_rms_unfiltered_deg", "posture_rms_deg", "position_error_mm"}),
            "; did you mean posture_rms_deg?");
}

TEST(DidYouMean, guesses_nothing_far_or_ambiguous) {
  EXPECT_EQ(did_you_mean("", {"run"}), "");
  EXPECT_EQ(did_you_mean("track", {}), "");
  EXPECT_EQ(did_you_mean("tr", {"track"}), "");
  EXPECT_EQ(did_you_mean("posture", {"posture_a_mean", "posture_b_mean"}), "") << "equally short";
  EXPECT_EQ(did_you_mean("rxx", {"run"}), "") << "2 of 3 characters";
  EXPECT_EQ(did_you_mean("Tr9", {"Tr1", "Tr2", "Tr3"}), "") << "all equally near";
  EXPECT_EQ(did_you_mean("Tr9", {"Tr1", "Tr2", "Tr9b"}), "");
  EXPECT_EQ(did_you_mean("tra", {"track_all_frames"}), "") << "three characters begin too many names";
  EXPECT_EQ(did_you_mean(std::string(1 << 20, 'x'), {"run"}), "") << "compared with nothing of another length";
}

TEST(OneOf, lists_all_names) {
  EXPECT_EQ(one_of({"horn", "robust"}, "best"), "one of horn, robust");
  EXPECT_EQ(one_of({"horn", "robust"}, "horm"), "one of horn, robust; did you mean horn?");
}

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
