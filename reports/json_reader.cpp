#include "reports/json_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/excerpt.h"

namespace glovebench::reports {

using nlohmann::json;

void JsonReader::expect_keys(std::initializer_list<std::string_view> keys) const {
  for (const auto& member : object().items())
    if (std::ranges::find(keys, member.key()) == keys.end())
      throw Error(where_, field_.empty() ? "top level" : field_,
                  fmt::format("unknown key {}", excerpt(member.key())),
                  fmt::format("only {}", fmt::join(keys, ", ")));
  for (const std::string_view key : keys) (*this)[key];
}

JsonReader JsonReader::operator[](std::string_view key) const {
  const std::string field = field_.empty() ? printable(key) : fmt::format("{}.{}", field_, printable(key));
  const auto member = object().find(key);
  if (member == value_.end()) throw Error(where_, field, "nothing", "a value");
  return {*member, where_, field};
}

JsonItems JsonReader::items() const {
  if (!value_.is_array()) fail("an array");
  return JsonItems(*this);
}

JsonMembers JsonReader::members() const {
  object();
  return JsonMembers(*this);
}

JsonReader JsonItems::operator[](size_t index) const {
  return {array_.value_.at(index), array_.where_, fmt::format("{}[{}]", array_.field_, index)};
}

const json& JsonReader::object() const {
  if (!value_.is_object()) fail("an object");
  return value_;
}

std::string JsonReader::text() const {
  if (!value_.is_string()) fail("a text");
  return value_.get<std::string>();
}

void JsonReader::expect_text(std::string_view expected) const {
  if (text() != expected) fail(fmt::format("\"{}\"", expected));
}

bool JsonReader::boolean() const {
  if (!value_.is_boolean()) fail("true or false");
  return value_.get<bool>();
}

double JsonReader::number() const {
  if (!value_.is_number()) fail("a number");
  return value_.get<double>();
}

double JsonReader::number(double min, double max) const {
  const bool within = value_.is_number() && value_.get<double>() >= min && value_.get<double>() <= max;
  if (!within) fail(fmt::format("a number in {}..{}", min, max));
  return value_.get<double>();
}

std::optional<double> JsonReader::number_or_null(double min, double max) const {
  if (value_.is_null()) return std::nullopt;
  return number(min, max);
}

std::optional<double> JsonReader::number_or_null() const {
  if (value_.is_null()) return std::nullopt;
  if (!value_.is_number()) fail("a number or null");
  return value_.get<double>();
}

int64_t JsonReader::integer(int64_t min, int64_t max) const {
  const bool fits = value_.is_number_unsigned()
                        ? value_.get<uint64_t>() <= static_cast<uint64_t>(std::numeric_limits<int64_t>::max())
                        : value_.is_number_integer();
  if (!fits || value_.get<int64_t>() < min || value_.get<int64_t>() > max)
    fail(fmt::format("a whole number in {}..{}", min, max));
  return value_.get<int64_t>();
}

uint64_t JsonReader::unsigned_integer() const {
  if (!value_.is_number_unsigned()) fail("a whole number of 0 or more");
  return value_.get<uint64_t>();
}

void JsonReader::fail(const std::string& expected) const {
  throw Error(where_, field_.empty() ? "top level" : field_, excerpt(value_), expected);
}

}  // namespace glovebench::reports
