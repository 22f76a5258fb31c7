#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

struct OpensslResult {
  bool is_success;
  std::string output;
  std::string reason;  ///< stderr's last line
};

/// Runs `openssl` in a folder. Pass private keys only by `input` (its stdin).
/// Throws: Error if the program cannot run.
OpensslResult run_openssl(const std::string& folder, std::vector<std::string> arguments,
                          std::string_view input = "");

}  // namespace glovebench
