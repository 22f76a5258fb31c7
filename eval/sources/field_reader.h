#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace glovebench::eval {

/// Reads successive little-endian fields.
/// Throws: Error at the end of the bytes, from every function.
class FieldReader {
 public:
  static_assert(std::endian::native == std::endian::little);

  /// `where` and `field` are for messages and must live longer.
  FieldReader(std::string_view bytes, const std::string& where, const std::string& field)
      : bytes_(bytes), where_(where), field_(field) {}

  template <typename Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take(uint64_t size) {
    if (size > left()) fail("only " + std::to_string(left()) + " bytes left", std::to_string(size) + " bytes");
    position_ += size;
    return bytes_.substr(position_ - size, size);
  }
  /// After its length.
  std::string_view text() { return take(number<uint32_t>()); }
  /// Skips to a multiple of `size` from the beginning.
  void align(size_t size) { take((size - position_ % size) % size); }

  uint64_t left() const { return bytes_.size() - position_; }
  uint64_t position() const { return position_; }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw Error(where_, field_, found, expected);
  }

 private:
  std::string_view bytes_;
  uint64_t position_ = 0;
  const std::string& where_;
  const std::string& field_;
};

}  // namespace glovebench::eval
