#include "core/base/parse_json.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench {
namespace {

using nlohmann::json;

std::string refusal(std::string_view text) {
  try {
    return parse_json(text, "x.json").dump();
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ParseJson, ReadsJson) {
  EXPECT_EQ(parse_json(R"( {"b": [1, {"b": 2}], "a": {"b": null}} )", "x.json"),
            (json{{"a", {{"b", nullptr}}}, {"b", {1, {{"b", 2}}}}}));
  EXPECT_EQ(parse_json("7", "x.json"), 7);
}

TEST(ParseJson, NamesThePlaceOfWhatIsNone) {
  for (const char* empty : {"", " \n\t\r\n"})
    EXPECT_EQ(refusal(empty), "x.json: content: found nothing, expected JSON");
  EXPECT_EQ(refusal("{\"a\": 1"), "x.json: column 8: found the end of the text, expected JSON");
  EXPECT_EQ(refusal("[1, ]"), "x.json: column 5: found invalid syntax, expected JSON");
  EXPECT_EQ(refusal("{\n  \"a\": 1,\n  \"b\": ?\n}"),
            "x.json: line 3, column 8: found invalid syntax, expected JSON");
  EXPECT_EQ(refusal("[1] 2"), "x.json: column 5: found invalid syntax, expected JSON");
  for (const char* text :
       {"[NaN]", "[Infinity]", "[1] // one", "['a']", "[01]", "[\"\xff\"]", "[\"\\ud800\"]", "\xef\xbb"})
    EXPECT_TRUE(refusal(text).ends_with("expected JSON")) << text << ": " << refusal(text);
}

TEST(ParseJson, EndsWithItsText) {
  EXPECT_EQ(refusal("[1, \n"), "x.json: column 5: found the end of the text, expected JSON")
      << "of one line, with its end";
  EXPECT_EQ(refusal({"[1]\0[2]", 7}), "x.json: column 4: found a zero byte, expected JSON");
}

TEST(ParseJson, RefusesNumbersThatNoDoubleHolds) {
  EXPECT_EQ(refusal("[1,\n 1e400]"),
            "x.json: line 2, column 6: found a number that no double can hold, expected a finite number");
}

TEST(ParseJson, RefusesAKeyTwiceInOneObject) {
  EXPECT_EQ(refusal(R"({"a": 1, "b": {"a": 1}, "a": 1})"),
            "x.json: a: found the key twice, expected each key once");
  EXPECT_EQ(refusal(R"([{"a": 1}, {"a\n": [[], {"c": 1, "\u0063": 2}]}])"),
            "x.json: [1].a?[1].c: found the key twice, expected each key once");
  EXPECT_EQ(refusal(R"({"": 1, "": 1})"), "x.json: \"\": found the key twice, expected each key once");
}

TEST(ParseJson, RefusesWhatIsNestedTooDeep) {
  const auto nested = [](size_t depth, const std::string& begin = "") {
    return std::string(begin).append(depth, '[').append(depth, ']');
  };
  EXPECT_EQ(refusal(nested(kDeepestNesting)), nested(kDeepestNesting));
  EXPECT_EQ(refusal(nested(1'000'000, "\n")), "x.json: nesting: found deeper nesting, expected 64 levels");
  const std::string in_text = R"(["\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["])";
  EXPECT_EQ(refusal(in_text), in_text) << "brackets in a text are no nesting";
}

TEST(ParseJson, RefusesValuesThatTakeFarMoreMemoryThanTheirText) {
  const auto array_of = [](const std::string& value, size_t count) {
    std::string text = "[";
    for (size_t i = 0; i < count; ++i) text += value + ",";
    text.back() = ']';
    return text;
  };
  EXPECT_EQ(parse_json(array_of("0", 100'000), "x.json").size(), 100'000U);
  EXPECT_EQ(parse_json(array_of("0.123456789", 1'000'000), "x.json").size(), 1'000'000U) << "not the count matters";
  for (const char* value : {"0", "[]", "{}", "\"\"", R"({"":{"":0}})"}) {
    const std::string error = refusal(array_of(value, 1'000'000));
    EXPECT_TRUE(error.ends_with("expected at most 12 bytes of memory for each byte of text"))
        << error.substr(0, 200);
    EXPECT_TRUE(error.starts_with("x.json: [")) << error.substr(0, 200);
  }
}

TEST(Excerpt, IsShortAndOnOneLine) {
  EXPECT_EQ(printable("a name"), "a name");
  EXPECT_EQ(printable("a\nb\x7f\xc3\xa9"), "a?b???");
  EXPECT_EQ(printable(std::string(61, 'x')), std::string(60, 'x').append("..."));
  EXPECT_EQ(excerpt(json("a\n\u00e9")), R"("a\n\u00e9")");
  EXPECT_EQ(quoted_excerpt("K\xc3\xb6ln"), R"("K\u00f6ln")");
  EXPECT_EQ(excerpt(1.5), "1.5");
  EXPECT_EQ(excerpt(nullptr), "null");
  EXPECT_EQ(excerpt(json("\xff")), R"("\ufffd")") << "no text that was read holds it, but one made of it may";
  EXPECT_EQ(excerpt(json(std::string(1000, 'x'))).size(), 65U);
  EXPECT_EQ(excerpt(json::array({1, 2})), "an array of 2");
  EXPECT_EQ(excerpt(json::object()), "an object");
}

}  // namespace
}  // namespace glovebench
