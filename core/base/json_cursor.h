#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/enum_names.h"

namespace glovebench {

class JsonItems;
class JsonMembers;

/// Reads a JSON value strictly. Document and `where` must outlive the cursor.
/// Throws: Error(where, "frames[17].angles_deg[3]", found, expected) for missing or unknown keys, wrong kinds or
/// ranges.
class JsonCursor {
 public:
  JsonCursor(const nlohmann::json& value, const std::string& where, std::string path = "")
      : value_(&value), where_(&where), path_(std::move(path)) {}
  JsonCursor(const nlohmann::json& value, std::string&& where, std::string path = "") = delete;
  JsonCursor(nlohmann::json&& value, const std::string& where, std::string path = "") = delete;

  /// Requires `required`, allows `optional` keys.
  void expect_keys(std::initializer_list<std::string_view> required,
                   std::initializer_list<std::string_view> optional = {}) const {
    expect_keys({required.begin(), required.end()}, {optional.begin(), optional.end()});
  }
  void expect_keys(std::span<const std::string_view> required, std::span<const std::string_view> optional) const;
  void expect_format(std::string_view format, int64_t version) const;
  bool has(std::string_view key) const { return object().contains(key); }
  JsonCursor operator[](std::string_view key) const;
  JsonMembers members() const;

  JsonItems items() const;
  /// Requires at least one.
  JsonItems some_items() const;
  JsonItems items(size_t count) const;

  bool is_null() const { return value_->is_null(); }
  bool is_text() const { return value_->is_string(); }
  bool is_integer() const { return value_->is_number_integer(); }
  std::string text() const;
  void expect_text(std::string_view expected) const;
  /// Requires `is_name`.
  std::string name() const;
  template <Named Enum>
  Enum one_of() const {
    const auto value = is_text() ? from_name<Enum>(value_->get_ref<const std::string&>()) : std::nullopt;
    if (!value) fail(known_names<Enum>());
    return *value;
  }
  bool boolean() const;
  double number() const;
  double number(double min, double max) const;
  std::optional<double> number_or_null(double min, double max) const;
  int64_t integer(int64_t min, int64_t max) const;
  int count() const { return static_cast<int>(integer(0, std::numeric_limits<int>::max())); }
  uint64_t unsigned_integer() const;
  /// `most`: limit of each absolute value.
  Eigen::Vector3d vector3(std::optional<double> most = {}) const;

  const nlohmann::json& value() const { return *value_; }
  /// "FILE: frames[17].angles_deg[3]".
  std::string place() const;
  [[noreturn]] void fail(const std::string& expected) const;
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  const nlohmann::json& object() const;

  const nlohmann::json* value_;
  const std::string* where_;
  std::string path_;

  friend class JsonItems;
  friend class JsonMembers;
};

class JsonItems {
 public:
  explicit JsonItems(const JsonCursor& array) : array_(array) {}

  class Iterator {
   public:
    Iterator(const JsonItems& items, size_t index) : items_(&items), index_(index) {}
    JsonCursor operator*() const { return (*items_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const JsonItems* items_;
    size_t index_;
  };

  size_t size() const { return array_.value_->size(); }
  JsonCursor operator[](size_t index) const;
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  JsonCursor array_;
};

class JsonMembers {
 public:
  explicit JsonMembers(const JsonCursor& object) : object_(object) {}

  class Iterator {
   public:
    Iterator(const JsonCursor& object, const nlohmann::json::const_iterator& member)
        : object_(&object), member_(member) {}
    std::pair<std::string, JsonCursor> operator*() const { return {member_.key(), (*object_)[member_.key()]}; }
    Iterator& operator++() {
      ++member_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return member_ == other.member_; }

   private:
    const JsonCursor* object_;
    nlohmann::json::const_iterator member_;
  };

  size_t size() const { return object_.value_->size(); }
  std::pair<std::string, JsonCursor> front() const { return *begin(); }
  Iterator begin() const { return {object_, object_.value_->begin()}; }
  Iterator end() const { return {object_, object_.value_->end()}; }

 private:
  JsonCursor object_;
};

}  // namespace glovebench
