#include "core/base/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/excerpt.h"

namespace glovebench {
namespace {

using nlohmann::json;

/// Where byte number `byte`, counted from 1, lies; in a text of one line that needs no number.
std::string place_of(std::string_view text, size_t byte) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const std::string column = fmt::format("column {}", before.size() - line_begin + 1);
  if (text.find('\n') == std::string_view::npos) return column;
  return fmt::format("line {}, {}", std::ranges::count(before, '\n') + 1, column);
}

/// Follows the library through a text and throws Error for what is no JSON, and for a key that comes twice, of
/// which the library would keep the last: who wrote the file by hand deserves to hear of it.
class StrictText : public json::json_sax_t {
 public:
  StrictText(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  bool null() override { return value(); }
  bool boolean(bool /*value*/) override { return value(); }
  bool number_integer(json::number_integer_t /*value*/) override { return value(); }
  bool number_unsigned(json::number_unsigned_t /*value*/) override { return value(); }
  bool number_float(json::number_float_t /*value*/, const std::string& /*text*/) override { return value(); }
  bool string(std::string& /*value*/) override { return value(); }
  bool binary(json::binary_t& /*value*/) override { return value(); }
  bool start_object(size_t /*size*/) override { return begin(true); }
  bool start_array(size_t /*size*/) override { return begin(false); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(std::string& key) override {
    levels_.back().key = key;
    if (!levels_.back().keys.insert(key).second) throw Error(where_, path(), "the key twice", "each key once");
    return true;
  }
  bool parse_error(size_t byte, const std::string& /*token*/, const json::exception& error) override {
    constexpr int kNumberOverflow = 406;  // of the library's numbered errors
    if (error.id == kNumberOverflow)
      throw Error(where_, place_of(text_, byte), "a number that no double can hold", "a finite number");
    throw Error(where_, place_of(text_, byte), byte > text_.size() ? "the end" : "something else", "JSON");
  }

 private:
  struct Level {
    bool is_object = false;
    std::string key;
    std::set<std::string> keys;
    size_t items = 0;
  };

  bool value() {
    if (!levels_.empty()) ++levels_.back().items;
    return true;
  }
  bool begin(bool is_object) {
    value();
    if (levels_.size() == kDeepestNesting)
      throw Error(where_, "nesting", "deeper nesting", fmt::format("{} levels", kDeepestNesting));
    levels_.push_back({.is_object = is_object, .key = {}, .keys = {}});
    return true;
  }
  bool end() {
    levels_.pop_back();
    return true;
  }
  /// As in frames[17].position_mm.
  std::string path() const {
    std::string path;
    for (const Level& level : levels_) {
      if (!level.is_object) path += fmt::format("[{}]", level.items - 1);
      if (level.is_object && !path.empty()) path += '.';
      if (level.is_object) path += level.key.empty() ? "\"\"" : printable(level.key);
    }
    return path;
  }

  std::string_view text_;
  const std::string& where_;
  std::vector<Level> levels_;
};

}  // namespace

json parse_json(std::string_view text, const std::string& where) {
  // The library would take it for the end.
  if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
    throw Error(where, place_of(text, zero + 1), "a zero byte", "JSON");
  StrictText strict(text, where);
  json::sax_parse(text, &strict);
  return json::parse(text);
}

}  // namespace glovebench
