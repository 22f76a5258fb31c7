#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"

namespace glovebench::reports {

/// Larger results and estimates are refused before they take memory: 256 MB is the report of some million frames.
inline constexpr uint64_t kLargestFile = 256'000'000;
/// The same of what does not grow with the frames: times, ratios, noise floors.
inline constexpr uint64_t kLargestSmallFile = 16'000'000;

class JsonItems;
class JsonMembers;

/// A value in a JSON document and the way to it, for reading strictly: whatever is missing, superfluous or of
/// another kind throws Error(where, field, found, expected). Refers to the document and to `where`, which must
/// outlive it.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& value, const std::string& where, std::string field = "")
      : value_(value), where_(where), field_(std::move(field)) {}

  /// The value is an object with these keys and no others.
  void expect_keys(std::initializer_list<std::string_view> keys) const;
  JsonReader operator[](std::string_view key) const;
  /// Of an array.
  JsonItems items() const;
  /// Of an object.
  JsonMembers members() const;

  bool is_null() const { return value_.is_null(); }
  bool is_text() const { return value_.is_string(); }
  bool is_integer() const { return value_.is_number_integer(); }
  const nlohmann::json& object() const;
  std::string text() const;
  /// A text that names a value.
  template <Named Enum>
  Enum one_of() const {
    const auto value = is_text() ? from_name<Enum>(value_.get_ref<const std::string&>()) : std::nullopt;
    if (!value) fail(known_names<Enum>());
    return *value;
  }
  /// A text that is `expected`.
  void expect_text(std::string_view expected) const;
  bool boolean() const;
  double number() const;
  double number(double min, double max) const;
  std::optional<double> number_or_null() const;
  std::optional<double> number_or_null(double min, double max) const;
  int64_t integer(int64_t min, int64_t max) const;
  int count() const { return static_cast<int>(integer(0, std::numeric_limits<int>::max())); }
  uint64_t unsigned_integer() const;

  /// Throws Error: this value is not what was expected.
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  const nlohmann::json& value_;
  const std::string& where_;
  std::string field_;

  friend class JsonItems;
};

/// The values of an array, each made when it is looked at: a reader is larger than a value.
class JsonItems {
 public:
  explicit JsonItems(const JsonReader& array) : array_(array) {}

  class Iterator {
   public:
    Iterator(const JsonItems& items, size_t index) : items_(&items), index_(index) {}
    JsonReader operator*() const { return (*items_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const JsonItems* items_;
    size_t index_;
  };

  size_t size() const { return array_.value_.size(); }
  JsonReader operator[](size_t index) const;
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  JsonReader array_;
};

/// The names and values of an object, made like those of JsonItems.
class JsonMembers {
 public:
  explicit JsonMembers(const JsonReader& object) : object_(object) {}

  class Iterator {
   public:
    Iterator(const JsonReader& object, nlohmann::json::const_iterator member) : object_(&object), member_(member) {}
    std::pair<std::string, JsonReader> operator*() const { return {member_.key(), (*object_)[member_.key()]}; }
    Iterator& operator++() {
      ++member_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return member_ == other.member_; }

   private:
    const JsonReader* object_;
    nlohmann::json::const_iterator member_;
  };

  size_t size() const { return object_.object().size(); }
  std::pair<std::string, JsonReader> front() const { return *begin(); }
  Iterator begin() const { return {object_, object_.object().begin()}; }
  Iterator end() const { return {object_, object_.object().end()}; }

 private:
  JsonReader object_;
};

}  // namespace glovebench::reports
