#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/enum_names.h"
#include "core/base/name.h"

namespace glovebench::trajectories {

/// Trajectories and posture sets are no larger (bytes).
inline constexpr uint64_t kLargestFile = uint64_t{64} << 20;

/// A value of a JSON document that knows where it stands, so that every complaint names file and field
/// ("frames[17].angles_deg[3]"). All members throw Error. Refers to the document: must not outlive it.
class JsonField {
 public:
  JsonField(const nlohmann::json& value, std::string where) : JsonField(value, std::move(where), "") {}

  void expect_object() const;
  /// The value must be an object with all of `required` and nothing beyond `required` and `optional`.
  void expect_members(std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional = {}) const;
  bool has(std::string_view key) const { return value_->contains(key); }
  JsonField member(std::string_view key) const;

  /// Number of elements of the array, which must have at least one.
  size_t array_size() const;
  /// The same if each element is an object with these members and no others: for so many there can be room.
  size_t array_size(std::initializer_list<std::string_view> members) const;
  /// The value must be an array of exactly this many elements.
  void expect_array(size_t size) const;
  JsonField element(size_t index) const;

  double number(double min, double max) const;
  int64_t integer(int64_t min, int64_t max) const;
  std::string text() const;
  /// A text that names a value.
  template <Named Enum>
  Enum one_of() const {
    const auto value = value_->is_string() ? from_name<Enum>(value_->get_ref<const std::string&>()) : std::nullopt;
    if (!value) fail(known_names<Enum>());
    return *value;
  }
  /// A text that must equal `expected`.
  void expect_text(std::string_view expected) const;
  /// Of an object: its "format" and "version".
  void expect_format(std::string_view format, int64_t version) const;
  /// A name fit for a file or a table cell (core/base/name.h).
  std::string name() const;

  const nlohmann::json& value() const { return *value_; }
  [[noreturn]] void fail(const std::string& expected) const;
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  JsonField(const nlohmann::json& value, std::string where, std::string path)
      : value_(&value), where_(std::move(where)), path_(std::move(path)) {}
  void expect_array() const;

  const nlohmann::json* value_;
  std::string where_;
  std::string path_;
};

/// `value` with a fixed number of decimals; the same on every machine, never "-0.000".
std::string fixed(double value, int decimals);
/// The text as a JSON string, quoted and escaped.
std::string in_quotes(std::string_view text);

}  // namespace glovebench::trajectories
