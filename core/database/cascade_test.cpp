#include "core/database/cascade.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace glovebench {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Cascade, is_parsed_and_written_back) {
  const Cascade papers = {{16, 500}, {64, 3}};
  EXPECT_EQ(parse_cascade("16:500,64:3"), papers);
  for (const char* text : {"8:1", "64:3", "8:2000,16:500,32:50,64:3", "64:3,64:3", "64:100000000"}) {
    EXPECT_EQ(to_string(parse_cascade(text)), text);
  }
}

TEST(Cascade, exact_means_the_largest_images_alone) {
  const Cascade largest = {{64, 3}};
  EXPECT_EQ(parse_cascade("exact:3"), largest);
  for (const char* text : {"exact", "exact:", "exact:x", "exact:3,64:1", "16:500,exact:3", "Exact:3"})
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("exact:KEEP"))) << text;
  EXPECT_THAT([] { parse_cascade("exact:0"); }, ThrowsMessage<Error>(HasSubstr("found keep 0")));
}

TEST(Cascade, refuses_what_is_malformed_or_impossible_and_says_why) {
  for (const char* text : {"", "64", "64:", ":3", "64:3,", ",64:3", "64:3,,64:2", "64:3;16:2", "64:three", "64:3.5",
                           " 64:3", "64:3 ", "64:+3", "64:3:2", "0x40:3", "64:99999999999999999999"}) {
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("such as 16:500,64:3"))) << text;
  }
  for (const char* text : {"12:5", "0:5", "-8:5", "128:3", "2147483647:1"}) {
    EXPECT_THAT([&] { parse_cascade(text); }, ThrowsMessage<Error>(HasSubstr("8, 16, 32 or 64"))) << text;
  }
  EXPECT_THAT([] { parse_cascade("64:0"); }, ThrowsMessage<Error>(HasSubstr("found keep 0")));
  EXPECT_THAT([] { parse_cascade("64:-3"); }, ThrowsMessage<Error>(HasSubstr("found keep -3")));
  EXPECT_THAT([] { parse_cascade("64:100000001"); }, ThrowsMessage<Error>(HasSubstr("at most 100000000")));
  EXPECT_THAT([] { parse_cascade("16:3,64:500"); }, ThrowsMessage<Error>(HasSubstr("at most the 3")));
}

}  // namespace
}  // namespace glovebench
