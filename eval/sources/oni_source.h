#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::eval {

/// Times of the images in a file of OpenNI2's recorder, in the file's order. The recorder begins both kinds at 0.
struct OniTimes {
  std::vector<int64_t> depth_us, color_us;
};
/// Checks the bounds of records, which OpenNI2 trusts.
/// Throws: Error, also beyond the limits (core/README.md).
OniTimes parse_oni_times(std::string_view file, const std::string& where);

}  // namespace glovebench::eval
