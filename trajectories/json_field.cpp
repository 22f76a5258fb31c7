#include "trajectories/json_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/excerpt.h"

namespace glovebench::trajectories {

using nlohmann::json;

void JsonField::expect_object() const {
  if (!value_->is_object()) fail("an object");
}

void JsonField::expect_array() const {
  if (!value_->is_array()) fail("an array");
}

void JsonField::expect_members(std::initializer_list<std::string_view> required,
                               std::initializer_list<std::string_view> optional) const {
  expect_object();
  for (const std::string_view key : required) {
    if (!has(key)) throw Error(where_, path_.empty() ? "document" : path_, "no key " + in_quotes(key), "the key");
  }
  for (const auto& [key, unused] : value_->items()) {
    if (std::ranges::find(required, key) != required.end()) continue;
    if (std::ranges::find(optional, key) != optional.end()) continue;
    throw Error(where_, path_.empty() ? "document" : path_, "unknown key " + quoted_excerpt(key),
                fmt::format("{}", fmt::join(required, ", ")));
  }
}

JsonField JsonField::member(std::string_view key) const {
  expect_object();
  const auto found = value_->find(key);
  std::string path = path_.empty() ? printable(key) : fmt::format("{}.{}", path_, printable(key));
  if (found == value_->end()) throw Error(where_, path, "nothing", "a value");
  return {*found, where_, std::move(path)};
}

size_t JsonField::array_size() const {
  expect_array();
  if (value_->empty()) fail("an empty array", "at least one element");
  return value_->size();
}

size_t JsonField::array_size(std::initializer_list<std::string_view> members) const {
  const size_t size = array_size();
  for (size_t i = 0; i < size; ++i) element(i).expect_members(members);
  return size;
}

void JsonField::expect_array(size_t size) const {
  expect_array();
  if (value_->size() != size) fail(fmt::format("{} elements", value_->size()), fmt::format("{}", size));
}

JsonField JsonField::element(size_t index) const {
  expect_array();
  return {value_->at(index), where_, fmt::format("{}[{}]", path_, index)};
}

double JsonField::number(double min, double max) const {
  const std::string expected = fmt::format("a number from {} to {}", min, max);
  if (!value_->is_number()) fail(expected);
  const double number = value_->get<double>();
  if (!(number >= min && number <= max)) fail(expected);
  return number;
}

int64_t JsonField::integer(int64_t min, int64_t max) const {
  const std::string expected = fmt::format("an integer from {} to {}", min, max);
  if (!value_->is_number_integer()) fail(expected);
  // An unsigned value above the signed range would turn negative.
  if (value_->is_number_unsigned() && value_->get<uint64_t>() > static_cast<uint64_t>(INT64_MAX)) fail(expected);
  const auto integer = value_->get<int64_t>();
  if (integer < min || integer > max) fail(expected);
  return integer;
}

std::string JsonField::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get<std::string>();
}

void JsonField::expect_format(std::string_view format, int64_t version) const {
  member("format").expect_text(format);
  member("version").integer(version, version);
}

void JsonField::expect_text(std::string_view expected) const {
  if (text() != expected) fail(in_quotes(expected));
}

std::string JsonField::name() const {
  std::string name = text();
  if (!is_name(name)) fail(kNameExpected);
  return name;
}

void JsonField::fail(const std::string& expected) const {
  fail(excerpt(*value_), expected);
}

void JsonField::fail(const std::string& found, const std::string& expected) const {
  throw Error(where_, path_.empty() ? "document" : path_, found, expected);
}

std::string fixed(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  // Adding zero turns a negative zero into a positive one.
  return fmt::format("{:.{}f}", std::round(value * scale) / scale + 0.0, decimals);
}

std::string in_quotes(std::string_view text) {
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace glovebench::trajectories
