#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::eval {

/// A line of rgb.txt or depth.txt.
struct TumImage {
  int64_t timestamp_us = 0;
  std::string name;  ///< within the folder
};
/// Reads "SECONDS FILE" lines; '#' begins a comment.
/// Throws: Error.
std::vector<TumImage> parse_tum_list(std::string_view text, const std::string& where);

}  // namespace glovebench::eval
