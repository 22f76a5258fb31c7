#include "core/base/enum_names.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace glovebench {
namespace {

enum class Light { red, amber, green };
constexpr auto names_of(Light) { return std::to_array<std::string_view>({"red", "yellow-red", "green"}); }
enum class Nameless { one };
static_assert(Named<Light> && !Named<Nameless> && !Named<int>);

TEST(EnumNames, lead_to_their_values_and_back) {
  static_assert(to_string(Light::amber) == "yellow-red");
  static_assert(from_name<Light>("green") == Light::green);
  for (const Light light : all_values<Light>()) EXPECT_EQ(from_name<Light>(to_string(light)), light);
  EXPECT_EQ(kCountOf<Light>, 3);
  EXPECT_EQ(all_names<Light>(), (std::vector<std::string>{"red", "yellow-red", "green"}));
  EXPECT_EQ(known_names<Light>(), "red, yellow-red or green");
}

TEST(EnumNames, know_no_others) {
  for (const std::string_view name : {"", "Red", "red ", "blue"}) EXPECT_EQ(from_name<Light>(name), std::nullopt);
  EXPECT_THROW(to_string(static_cast<Light>(3)), std::out_of_range);
  EXPECT_THROW(to_string(static_cast<Light>(-1)), std::out_of_range);
}

}  // namespace
}  // namespace glovebench
