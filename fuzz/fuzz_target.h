#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/check.h"
#include "core/base/error.h"

// What libFuzzer calls, and in the normal build the replay of the corpora.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace glovebench::fuzz {

inline std::string_view as_text(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader: it may return, or refuse its input by an Error of one line. Anything else is a finding.
template <typename Reader>
int expect_value_or_error(const Reader& reader) {
  try {
    reader();
  } catch (const Error& e) {
    check(std::string_view(e.what()).find('\n') == std::string_view::npos, "an error is one line");
  }
  return 0;
}

}  // namespace glovebench::fuzz
