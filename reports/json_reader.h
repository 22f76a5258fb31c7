#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::reports {

/// Larger files are refused before they take memory: 256 MB is the report of some million frames.
inline constexpr uint64_t kLargestFile = 256'000'000;

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
  std::vector<JsonReader> items() const;
  std::vector<std::pair<std::string, JsonReader>> members() const;

  bool is_null() const { return value_.is_null(); }
  bool is_text() const { return value_.is_string(); }
  bool is_integer() const { return value_.is_number_integer(); }
  const nlohmann::json& object() const;
  std::string text() const;
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
};

}  // namespace glovebench::reports
