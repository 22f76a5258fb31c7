#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace glovebench {

/// A reader, or a state machine, that is tried with any bytes. `run` may return or throw Error of one line; the
/// driver (eval/fuzz_main.cpp) counts everything else as a finding.
struct FuzzTarget {
  std::string name;  ///< of the folder ci/corpora/NAME; X of a file X_fuzz.cpp, whose function X_fuzz is `run`
  std::function<void(std::string_view bytes)> run;
};

/// Runs a reader that may throw Error of one line.
template <typename Reader>
void expect_value_or_error(const Reader& reader) {
  try {
    reader();
  } catch (const Error& e) {
    check(std::string_view(e.what()).find('\n') == std::string_view::npos, "an error is one line");
  }
}

/// Runs a state machine, which must not throw Error: that is a finding.
template <typename Run>
void without_error(const Run& run) {
  try {
    run();
  } catch (const Error& e) {
    throw std::logic_error(std::string("an error where none may be: ") + e.what());
  }
}

/// The input as values; zeros when it has ended.
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
