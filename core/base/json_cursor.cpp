#include "core/base/json_cursor.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench {

using nlohmann::json;

void JsonCursor::expect_keys(std::span<const std::string_view> required,
                             std::span<const std::string_view> optional) const {
  std::vector<std::string> known(required.begin(), required.end());
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& member : object().items())
    if (std::ranges::find(known, member.key()) == known.end())
      fail("unknown key " + excerpt(member.key()),
           fmt::format("only {}{}", fmt::join(known, ", "), did_you_mean(member.key(), known)));
  for (const std::string_view key : required) (*this)[key];
}

void JsonCursor::expect_format(std::string_view format, int64_t version) const {
  (*this)["format"].expect_text(format);
  (*this)["version"].integer(version, version);
}

JsonCursor JsonCursor::operator[](std::string_view key) const {
  const std::string path = path_.empty() ? printable(key) : fmt::format("{}.{}", path_, printable(key));
  const auto member = object().find(key);
  if (member == value_->end()) throw Error(*where_, path, "nothing", "a value");
  return {*member, *where_, path};
}

JsonMembers JsonCursor::members() const {
  object();
  return JsonMembers(*this);
}

JsonItems JsonCursor::items() const {
  if (!value_->is_array()) fail("an array");
  return JsonItems(*this);
}

JsonItems JsonCursor::some_items() const {
  if (items().size() == 0) fail("an empty array", "at least one element");
  return items();
}

JsonItems JsonCursor::items(size_t count) const {
  if (items().size() != count) fail(fmt::format("{} elements", value_->size()), fmt::format("{}", count));
  return items();
}

JsonCursor JsonItems::operator[](size_t index) const {
  return {array_.value_->at(index), *array_.where_, fmt::format("{}[{}]", array_.path_, index)};
}

const json& JsonCursor::object() const {
  if (!value_->is_object()) fail("an object");
  return *value_;
}

std::string JsonCursor::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get<std::string>();
}

void JsonCursor::expect_text(std::string_view expected) const {
  if (text() != expected) fail(quoted_excerpt(expected));
}

std::string JsonCursor::name() const {
  std::string name = text();
  if (!is_name(name)) fail(kNameExpected);
  return name;
}

bool JsonCursor::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

double JsonCursor::number() const {
  if (!value_->is_number()) fail("a number");
  const auto number = value_->get<double>();
  if (!std::isfinite(number)) fail("a number that is not finite", "a finite number");
  return number;
}

double JsonCursor::number(double min, double max) const {
  const bool within = value_->is_number() && value_->get<double>() >= min && value_->get<double>() <= max;
  if (!within) fail(fmt::format("a number in {}..{}", min, max));
  return value_->get<double>();
}

std::optional<double> JsonCursor::number_or_null(double min, double max) const {
  if (value_->is_null()) return std::nullopt;
  return number(min, max);
}

int64_t JsonCursor::integer(int64_t min, int64_t max) const {
  const bool fits = value_->is_number_unsigned()
                        ? value_->get<uint64_t>() <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max())
                        : value_->is_number_integer();
  if (!fits || value_->get<int64_t>() < min || value_->get<int64_t>() > max)
    fail(fmt::format("a whole number in {}..{}", min, max));
  return value_->get<int64_t>();
}

uint64_t JsonCursor::unsigned_integer() const {
  if (!value_->is_number_unsigned()) fail("a whole number of 0 or more");
  return value_->get<uint64_t>();
}

Eigen::Vector3d JsonCursor::vector3(std::optional<double> most) const {
  const JsonItems numbers = items(3);
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = most ? numbers[i].number(-*most, *most) : numbers[i].number();
  return vector;
}

std::string JsonCursor::place() const { return *where_ + ": " + (path_.empty() ? "top level" : path_); }

void JsonCursor::fail(const std::string& expected) const { fail(excerpt(*value_), expected); }

void JsonCursor::fail(const std::string& found, const std::string& expected) const {
  throw Error(*where_, path_.empty() ? "top level" : path_, found, expected);
}

}  // namespace glovebench
