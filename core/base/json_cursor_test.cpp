#include "core/base/json_cursor.h"

#include <gmock/gmock.h>

#include "core/test_error.h"

namespace glovebench {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kWhere = "file.json";

enum class Fruit { apple, pear };
constexpr auto names_of(Fruit) { return std::to_array<std::string_view>({"apple", "pear"}); }

TEST(JsonCursor, ReadsValuesAndKnowsTheWayToThem) {
  const json document = {
      {"frames", {{{"angle_deg", 3}}, {{"angle_deg", "x"}}}}, {"fruit", "pear"}, {"none", nullptr}};
  const JsonCursor root(document, kWhere);
  EXPECT_EQ(root["frames"].items()[0]["angle_deg"].number(0, 5), 3);
  EXPECT_EQ(root["fruit"].one_of<Fruit>(), Fruit::pear);
  EXPECT_EQ(root["none"].number_or_null(0, 1), std::nullopt);
  EXPECT_TRUE(root.has("none"));
  EXPECT_FALSE(root.has("nothing"));
  EXPECT_EQ(thrown_by([&] { root["frames"].items()[1]["angle_deg"].number(); }),
            "file.json: frames[1].angle_deg: found \"x\", expected a number");
  EXPECT_EQ(thrown_by([&] { root["fruit"].fail("a vegetable"); }),
            "file.json: fruit: found \"pear\", expected a vegetable");
  EXPECT_EQ(thrown_by([&] { root["other"]; }), "file.json: other: found nothing, expected a value");
  EXPECT_EQ(thrown_by([&] { root.text(); }), "file.json: top level: found an object, expected a text");
}

TEST(JsonCursor, RefusesKeysThatAreMissingOrUnknown) {
  const json document = {{"a", 1}, {"b", 2}};
  const JsonCursor root(document, kWhere);
  root.expect_keys({"a", "b"});
  root.expect_keys({"a"}, {"b", "c"});
  EXPECT_EQ(thrown_by([&] { root.expect_keys({"a"}, {"c"}); }),
            "file.json: top level: found unknown key \"b\", expected only a, c");
  EXPECT_EQ(thrown_by([&] { root.expect_keys({"a", "b", "c"}); }), "file.json: c: found nothing, expected a value");
  EXPECT_THAT(thrown_by([&] { root["a"].expect_keys({}); }), HasSubstr("a: found 1, expected an object"));
  EXPECT_THAT(thrown_by([&] { root["a"].members(); }), HasSubstr("an object"));
}

TEST(JsonCursor, RefusesOtherKindsAndRanges) {
  const json document = {{"half", 0.5},
                         {"huge", 18'446'744'073'709'551'615u},
                         {"empty", json::array()},
                         {"nan", std::nan("")},
                         {"text", "a\nb"},
                         {"three", {1, 2, 3}}};
  const JsonCursor root(document, kWhere);
  EXPECT_THAT(thrown_by([&] { root["half"].integer(0, 1); }), HasSubstr("expected a whole number in 0..1"));
  EXPECT_THAT(thrown_by([&] { root["huge"].integer(INT64_MIN, INT64_MAX); }),
              HasSubstr("huge: found 18446744073709551615"));
  EXPECT_EQ(root["huge"].unsigned_integer(), 18'446'744'073'709'551'615u);
  EXPECT_THAT(thrown_by([&] { root["half"].number(1, 2); }), HasSubstr("expected a number in 1..2"));
  EXPECT_THAT(thrown_by([&] { root["nan"].number(); }), HasSubstr("not finite"));
  EXPECT_THAT(thrown_by([&] { root["nan"].number(0, 1); }), HasSubstr("expected a number in 0..1"));
  EXPECT_THAT(thrown_by([&] { root["text"].name(); }), StartsWith("file.json: text: found "));
  EXPECT_THAT(thrown_by([&] { root["text"].one_of<Fruit>(); }), HasSubstr("expected apple or pear"));
  EXPECT_THAT(thrown_by([&] { root["half"].one_of<Fruit>(); }), HasSubstr("expected apple or pear"));
  EXPECT_THAT(thrown_by([&] { root["text"].boolean(); }), HasSubstr("true or false"));
  EXPECT_EQ(root["empty"].items().size(), 0U);
  EXPECT_THAT(thrown_by([&] { root["empty"].some_items(); }), HasSubstr("at least one element"));
  EXPECT_THAT(thrown_by([&] { root["three"].items(2); }), HasSubstr("found 3 elements, expected 2"));
  EXPECT_EQ(root["three"].vector3(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(thrown_by([&] { root["three"].vector3(2.5); }), HasSubstr("three[2]: found 3"));
}

}  // namespace
}  // namespace glovebench
