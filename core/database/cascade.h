#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

/// One stage of the look-up: keep the `keep` nearest entries by images of `size` px.
struct CascadeStage {
  int size = 64;
  int keep = 3;

  friend bool operator==(const CascadeStage&, const CascadeStage&) = default;
};
using Cascade = std::vector<CascadeStage>;

/// "16:500,64:3". "exact:3" is another spelling of "64:3": the nearest by the largest images with no stage before
/// that could lose them. Throws Error if malformed or impossible (unknown size, a stage that keeps more than the
/// one before it).
Cascade parse_cascade(std::string_view text);
std::string to_string(const Cascade& cascade);

}  // namespace glovebench
