#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench::eval {

/// Times of the images of a recording of OpenNI2's recorder, in the order of the file. The recorder
/// begins both kinds at 0.
struct OniTimes {
  std::vector<int64_t> depth_us, color_us;
};
/// Walks the records of a file and checks their bounds, which OpenNI2 trusts.
/// Throws: Error if the file is damaged, cut off or beyond the limits (core/README.md).
OniTimes parse_oni_times(std::string_view file, const std::string& where);

}  // namespace glovebench::eval
