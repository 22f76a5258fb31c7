#pragma once

#include <algorithm>
#include <cstring>

#include "core/base/image.h"

namespace glovebench {

/// Calls `visit` with the column of each pixel of a row that is not zero, from left to right. Where few are, it
/// takes little more than a look at eight at a time.
template <typename Visit>
void for_each_nonzero(const Image<uint8_t>& image, int v, const Visit& visit) {
  const uint8_t* const row = image.data() + static_cast<size_t>(v) * image.width();
  for (int u = 0; u < image.width();) {
    const int end = std::min(u + 8, image.width());
    uint64_t eight = 1;
    if (end == u + 8) std::memcpy(&eight, row + u, 8);
    if (eight == 0) {
      u = end;
      continue;
    }
    for (; u < end; ++u)
      if (row[u] != 0) visit(u);
  }
}

}  // namespace glovebench
