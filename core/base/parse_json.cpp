#include "core/base/parse_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace glovebench {
namespace {

using nlohmann::json;

/// The place of byte number `byte`, counted from 1. A text of one line needs no line number.
std::string place_of(std::string_view text, size_t byte) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const std::string_view before = text.substr(0, byte > 0 ? byte - 1 : 0);
  const size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const std::string column = fmt::format("column {}", before.size() - line_begin + 1);
  if (text.find('\n') == std::string_view::npos) return column;
  return fmt::format("line {}, {}", std::ranges::count(before, '\n') + 1, column);
}

/// Heap memory of the parts of a document, with the heap's overhead.
constexpr uint64_t kArrayBytes = 32, kObjectBytes = 64, kMemberBytes = 96, kTextBytes = 48;
/// To destroy a document the library keeps a list of values, which doubles when it is full.
constexpr uint64_t kWaitingBytes = 3 * sizeof(json);

uint64_t text_bytes(const std::string& text) {
  constexpr size_t kWithin = 15;  // longer texts lie on the heap
  return text.size() > kWithin ? text.size() + 24 : 0;
}

/// Builds a document.
/// Throws: Error if the text is no JSON, takes too much memory, or repeats a key (the library would keep the last
/// one).
class StrictDocument : public json::json_sax_t {
 public:
  StrictDocument(std::string_view text, const std::string& where, uint64_t bytes_per_byte)
      : text_(text), where_(where), bytes_per_byte_(bytes_per_byte) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(json::number_integer_t value) override { return add(value); }
  bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
  bool number_float(json::number_float_t value, const std::string& /*text*/) override { return add(value); }
  bool string(std::string& value) override {
    charge(kTextBytes + text_bytes(value));
    return add(value);
  }
  bool binary(json::binary_t& /*value*/) override { return false; }  // not in a text
  bool start_object(size_t /*size*/) override { return begin(json::object(), kObjectBytes); }
  bool start_array(size_t /*size*/) override { return begin(json::array(), kArrayBytes); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(std::string& key) override {
    Level& level = levels_.back();
    charge(kMemberBytes + text_bytes(key));
    const auto [member, is_new] = level.container->get_ref<json::object_t&>().try_emplace(key);
    level.key = &member->first;
    level.member = &member->second;
    if (!is_new) throw Error(where_, path(), "the key twice", "each key once");
    return true;
  }
  bool parse_error(size_t byte, const std::string& /*token*/, const json::exception& error) override {
    constexpr int kNumberOverflow = 406;  // of the library's numbered errors
    if (error.id == kNumberOverflow)
      throw Error(where_, place_of(text_, byte), "a number that no double can hold", "a finite number");
    throw Error(where_, place_of(text_, byte), byte > text_.size() ? "the end of the text" : "invalid syntax",
                "JSON");
  }

  json take() { return std::move(document_); }

 private:
  /// An array or object that is not closed yet.
  struct Level {
    json* container = nullptr;
    const std::string* key = nullptr;  ///< of an object's last member
    json* member = nullptr;            ///< that member's value
  };

  bool add(json value) {
    put(std::move(value));
    return true;
  }
  json& put(json value) {
    if (levels_.empty()) return document_ = std::move(value);
    if (++waiting_ > most_waiting_) {
      charge(kWaitingBytes);
      most_waiting_ = waiting_;
    }
    if (levels_.back().member) return *levels_.back().member = std::move(value);
    auto& items = levels_.back().container->get_ref<json::array_t&>();
    if (items.size() == items.capacity()) grow(items);
    return items.emplace_back(std::move(value));
  }
  void grow(json::array_t& items) {
    const uint64_t before = items.capacity() * sizeof(json), after = std::max<uint64_t>(2 * before, sizeof(json));
    charge(after);  // both arrays exist while the values move
    items.reserve(after / sizeof(json));
    bytes_ -= before;
  }
  bool begin(json container, uint64_t bytes) {
    if (levels_.size() == kDeepestNesting)
      throw Error(where_, "nesting", "deeper nesting", fmt::format("{} levels", kDeepestNesting));
    charge(bytes);
    levels_.push_back({.container = &put(std::move(container)), .key = nullptr, .member = nullptr});
    return true;
  }
  bool end() {
    waiting_ -= levels_.back().container->size();
    levels_.pop_back();
    return true;
  }
  void charge(uint64_t bytes) {
    bytes_ += bytes;
    if (bytes_ > kJsonBytes + bytes_per_byte_ * text_.size())
      throw Error(where_, path(), fmt::format("too many small values for a text of {} bytes", text_.size()),
                  fmt::format("at most {} bytes of memory for each byte of text", bytes_per_byte_));
  }
  /// As in frames[17].position_mm.
  std::string path() const {
    std::string path;
    for (const Level& level : levels_) {
      if (level.container->is_array()) {
        path += fmt::format("[{}]", std::max<size_t>(level.container->size(), 1) - 1);
      } else if (level.key) {
        if (!path.empty()) path += '.';
        path += level.key->empty() ? "\"\"" : printable(*level.key);
      }
    }
    return path.empty() ? "top level" : path;
  }

  std::string_view text_;
  const std::string& where_;
  uint64_t bytes_per_byte_;
  json document_;
  std::vector<Level> levels_;
  uint64_t bytes_ = 0;
  uint64_t waiting_ = 0, most_waiting_ = 0;  ///< values that may be listed when the document is destroyed
};

}  // namespace

json parse_json(std::string_view text, const std::string& where) {
  // The library would take a zero byte for the end.
  if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
    throw Error(where, place_of(text, zero + 1), "a zero byte", "JSON");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) throw Error(where, "content", "nothing", "JSON");
  StrictDocument document(text, where, kJsonBytesPerByte);
  json::sax_parse(text, &document);
  return document.take();
}

json parse_cbor(std::string_view bytes, const std::string& where) {
  StrictDocument document(bytes, where, kCborBytesPerByte);
  if (!json::sax_parse(bytes, &document, json::input_format_t::cbor))
    throw Error(where, "content", "bytes without a meaning", "arrays, objects, texts and numbers");
  return document.take();
}

}  // namespace glovebench
