#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

/// What a call of the program `openssl` ended with.
struct OpensslResult {
  bool is_success;
  std::string output;
  std::string reason;  ///< the last line of what it said on standard error
};

/// Runs `openssl` in a folder, with `input` as its standard input: a private key goes that way ("/dev/stdin") and
/// is never on a disk. Throws Error where the program is missing or cannot be run.
OpensslResult run_openssl(const std::string& folder, std::vector<std::string> arguments,
                          std::string_view input = "");

}  // namespace glovebench
