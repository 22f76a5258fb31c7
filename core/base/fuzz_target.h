#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace glovebench {

/// Runs on any bytes (eval/fuzz_main.cpp). May throw only Error, in one line.
struct FuzzTarget {
  std::string name;  ///< of NAME_fuzz.cpp and ci/corpora/NAME
  std::function<void(std::string_view bytes)> run;
};

/// For readers, which may throw Error.
template <typename Reader>
void expect_value_or_error(const Reader& reader) {
  try {
    reader();
  } catch (const Error& e) {
    check(std::string_view(e.what()).find('\n') == std::string_view::npos, "an error is one line");
  }
}

/// For state machines, which must not throw Error.
template <typename Run>
void without_error(const Run& run) {
  try {
    run();
  } catch (const Error& e) {
    throw std::logic_error(std::string("an error where none may be: ") + e.what());
  }
}

/// The input as values, then zeros.
class FuzzInput {
 public:
  explicit FuzzInput(std::string_view bytes) : left_(bytes) {}
  bool empty() const { return left_.empty(); }
  template <typename Value>
  Value next() {
    Value value{};
    const size_t size = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), size);
    left_.remove_prefix(size);
    return value;
  }

 private:
  std::string_view left_;
};

}  // namespace glovebench
