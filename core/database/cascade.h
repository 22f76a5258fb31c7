#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

/// Keeps the `keep` nearest entries by images of `size` px.
struct CascadeStage {
  int size = 64;
  int keep = 3;

  friend bool operator==(const CascadeStage&, const CascadeStage&) = default;
};
using Cascade = std::vector<CascadeStage>;

/// Reads "16:500,64:3"; "exact:3" means "64:3".
/// Throws: Error for a malformed or impossible stage.
Cascade parse_cascade(std::string_view text);
std::string to_string(const Cascade& cascade);

}  // namespace glovebench
